"""Linear springs between two nodes: E = sum 1/2 k (d - l0)^2, d the distance of the nodes."""

from typing import NamedTuple

import numpy as np

from kernels.arrays import pair
from kernels.compile.jit import jit
from kernels.geometry.distance import direction, push_point, push_point_stiffen


class Spring(NamedTuple):
    """nodes (s, 2), stiffness (s,) in N/m, l0 (s,) rest length in m."""

    nodes: np.ndarray
    stiffness: np.ndarray
    l0: np.ndarray


@jit
def evaluate(x, spring, g):
    """Return E in J, infinite where two nodes coincide; add dE/dx to ``g``."""
    total = 0.0
    for k in range(spring.l0.size):
        a, b = pair(spring.nodes, k)
        _, _, d = direction(x, a, b)
        if d == 0.0:
            return np.inf
        stretched = d - spring.l0[k]
        total += 0.5 * spring.stiffness[k] * stretched * stretched
        push_point(g, x, b, a, spring.stiffness[k] * stretched)
    return total


@jit
def hessian(x, spring, matrix):
    """Add d2E/dx2."""
    for k in range(spring.l0.size):
        a, b = pair(spring.nodes, k)
        _, _, d = direction(x, a, b)
        force = spring.stiffness[k] * (d - spring.l0[k])
        push_point_stiffen(matrix, x, b, a, spring.stiffness[k], force)
