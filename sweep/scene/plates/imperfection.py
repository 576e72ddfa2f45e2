"""The stress-free bow of upright walls, zero along joints and at both ends.

Without a seed all walls bow in the shape in which equal walls of an even network buckle: half a
wave across a wall, and k half waves up the height H, which come nearest to squares of the mean
wall,

    bow = sign a sin(pi s / l) sin(k pi z / H),    k = H / mean l, rounded, at least 1

with a of `lattice.imperfection` wall thicknesses and the sign of `design.upright_plan.turns`. With
a seed every wall is drawn independently, with standard normal numbers g from numpy's default
generator,

    bow = a sin(pi s / l) sum_j g_j sin(j pi z / H) / (2 k)^(1/2),    j = 1 .. 2 k.
"""

import numpy as np

from sweep.array_types import Floats
from sweep.config.kinds.specimen import Specimen
from sweep.design.upright_plan import Plan


def half_waves(plan: Plan, height: float) -> int:
    """Number of half waves k up the height (m) in which the mean wall buckles."""
    mean = float(np.average(plan.span, weights=plan.length))
    return max(round(height / mean), 1)


def amplitudes(plan: Plan, lattice: Specimen) -> Floats:
    """Amplitudes (w, j) in m, to the right of each wall, for one to j half waves up the height."""
    waves = half_waves(plan, lattice.depth)
    size = lattice.imperfection * plan.thickness[:, None]
    if lattice.imperfection_seed is None:
        return np.asarray(size * plan.sign[:, None] * np.eye(waves)[-1])
    drawn = np.random.default_rng(lattice.imperfection_seed)
    numbers = drawn.standard_normal((len(plan.walls), 2 * waves))
    return np.asarray(size * numbers / np.sqrt(2.0 * waves))


def bow(amplitude: Floats, across: Floats, up: Floats) -> Floats:
    """Bow (k,) in m at places ``across`` and ``up`` (k,), as shares of wall and height.

    amplitude (k, j): of the wall of each place.
    """
    waves = 1.0 + np.arange(amplitude.shape[1])
    along = np.sin(np.pi * np.outer(up, waves))
    return np.asarray(np.sin(np.pi * across) * np.sum(amplitude * along, axis=1))
