"""Walls that meet along lines, three half waves high: a square tube, X and Y joints.

Equal walls buckle like a chequerboard: all arms of a joint turn alike, so that k = 4 in each. A
joint with its arms up to their middle, where they are symmetric, stands for the infinite lattice.
"""

import numpy as np

from tests.studies.plates.model import Places, buckling_strain, coordinates
from tests.studies.plates.square import rigidity
from tests.support.kernels.shells import MODULUS, Structure, structure

TUBE, X_JOINT, Y_JOINT = "tube", "X", "Y"
ARMS = {X_JOINT: 4, Y_JOINT: 3}
WAVES = 3
X, Y, Z, ABOUT_S, ABOUT_Z, ABOUT_N = range(6)


def build(kind: str, n: int, thickness: float) -> Structure:
    """Walls of width 1 with n quads."""
    if kind == TUBE:
        plan = [(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)]
        walls, pieces = [(0, 1), (1, 2), (2, 3), (3, 0)], n
    else:
        turn = 2 * np.pi * np.arange(ARMS[kind]) / ARMS[kind]
        plan = [(0.0, 0.0), *zip(0.5 * np.cos(turn), 0.5 * np.sin(turn), strict=True)]
        walls, pieces = [(0, k + 1) for k in range(ARMS[kind])], n // 2
    return structure(plan, walls, pieces, WAVES, WAVES * n, thickness)


def held(kind: str, of: Structure) -> Places:
    """Hinged lower and upper edges, middles of arms, and rotations about directors."""
    at, z = coordinates(of), of.points[:, 2]
    lower = z == 0.0
    columns = np.tile(np.arange(lower.sum()), len(z) // lower.sum())
    ends = lower | (z == z.max())
    joint = columns < (4 if kind == TUBE else 1)
    middle = (columns > 0) & (columns <= ARMS.get(kind, 0))
    return np.concatenate(
        [at[ends][:, [X, Y]].ravel(), at[lower, Z], at[~joint, ABOUT_N],
         at[(ends & ~joint) | middle, ABOUT_Z], at[ends & joint, ABOUT_N]]
    )  # fmt: skip


def factor(kind: str, n: int, thickness: float = 0.025) -> float:
    """Factor k of the walls."""
    of = build(kind, n, thickness)
    stress = MODULUS * buckling_strain(of, np.unique(held(kind, of)))[0]
    return stress * thickness / (np.pi**2 * rigidity(thickness))
