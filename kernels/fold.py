"""Fold barrier: two neighbouring arms of a node never close onto one another.

For every opening g between arms that are adjacent round a node (rest opening g0):

    E_f = K (g0 / 2)^2 b(g / g_f)   for g < g_f = min(20 degrees, g0 / 2),   else 0
"""

import math
from typing import NamedTuple

import numpy as np

from kernels import angle
from kernels.barrier import barrier
from kernels.jit import jit
from kernels.rows import triple


class Fold(NamedTuple):
    """Openings: nodes (f, 3), counted anticlockwise from arm 1-0 to arm 1-2.

    limit (f,): g_f in rad. stiffness (f,): K (g0 / 2)^2 in N m.
    """

    nodes: np.ndarray
    limit: np.ndarray
    stiffness: np.ndarray


@jit
def opening(x, fold, k):
    """Return the opening g where it is between 0 and 90 degrees, else a value beyond any limit."""
    a, b, c = triple(fold.nodes, k)
    cross, dot = angle.between(x, a, b, c)
    if cross < 0.0 or dot <= 0.0:
        return math.pi
    return math.atan2(cross, dot)


@jit
def energy(x, fold):
    """Return E_f in J."""
    total = 0.0
    for k in range(fold.limit.size):
        g = opening(x, fold, k)
        if g < fold.limit[k]:
            value, _, _ = barrier(g / fold.limit[k])
            total += fold.stiffness[k] * value
    return total


@jit
def gradient(x, fold, g):
    """Add dE_f/dx to ``g``."""
    for k in range(fold.limit.size):
        opened = opening(x, fold, k)
        if opened < fold.limit[k]:
            _, slope, _ = barrier(opened / fold.limit[k])
            a, b, c = triple(fold.nodes, k)
            angle.twist(g, x, a, b, c, fold.stiffness[k] / fold.limit[k] * slope)


@jit
def hessian(x, fold, matrix, projected):
    """Add d2E_f/dx2; ``projected`` drops the curvature of the angle."""
    for k in range(fold.limit.size):
        opened = opening(x, fold, k)
        if opened < fold.limit[k]:
            _, slope, curvature = barrier(opened / fold.limit[k])
            a, b, c = triple(fold.nodes, k)
            scale = fold.stiffness[k] / fold.limit[k]
            moment = 0.0 if projected else scale * slope
            angle.twist_stiffen(matrix, x, a, b, c, scale / fold.limit[k] * curvature, moment)
