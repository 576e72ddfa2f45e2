"""Walls that meet along lines, three half waves high: a square tube, X and Y joints.

Equal walls buckle like a chequerboard: all arms of a joint turn alike, so that k = 4 in each. A
joint with its arms up to their middle, where they are symmetric, stands for the infinite lattice.
"""

import numpy as np

from tests.studies.plates.model import Places, buckling_strain, coordinates
from tests.studies.plates.square import rigidity
from tests.support.shells import MODULUS, Structure, structure

TUBE, X_JOINT, Y_JOINT = "tube", "X", "Y"
WAVES = 3
X, Y, Z = range(3)


def build(kind: str, n: int, thickness: float) -> tuple[Structure, int]:
    """Walls of width 1 with n quads, and the number of their joints."""
    if kind == TUBE:
        plan = [(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)]
        return structure(plan, [(0, 1), (1, 2), (2, 3), (3, 0)], n, 3.0, 3 * n, thickness), 4
    arms = {X_JOINT: 4, Y_JOINT: 3}[kind]
    turn = 2 * np.pi * np.arange(arms) / arms
    plan = [(0.0, 0.0), *zip(0.5 * np.cos(turn), 0.5 * np.sin(turn), strict=True)]
    walls = [(0, k + 1) for k in range(arms)]
    return structure(plan, walls, n // 2, WAVES, WAVES * n, thickness), 1


def held(of: Structure, joints: int) -> Places:
    """Hinged lower and upper edges, middles of arms, and rotations about directors."""
    at, (_, _, z) = coordinates(of), of.points.T
    rows = np.arange(len(of.points)).reshape(-1, int(np.sum(z == 0.0)))
    corners = 4 if joints == 4 else rows.shape[1]
    ends = (z == 0.0) | (z == z.max())
    inside = np.abs(of.frames.reshape(-1, 3, 3) - np.eye(3)).max(axis=(1, 2)) > 1e-9
    found = [at[inside, 5], at[ends][:, [X, Y]].ravel(), at[z == 0.0, Z]]
    found += [at[ends & inside, 4], at[ends & ~inside, 5]]
    if joints == 1:
        found.append(middles(of, rows))
    assert corners >= 4
    return np.unique(np.concatenate(found))


def middles(of: Structure, rows: Places) -> Places:
    raise NotImplementedError
