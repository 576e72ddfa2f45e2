"""Fold barrier: keeps two neighbouring elements of a node from closing onto each other.

For every opening gamma between elements that are adjacent round a node (gamma_0 at rest; two
openings at a node inside a wall):

    E_f = K (gamma_0 / 2)^2 b(gamma / gamma_f)   for gamma < gamma_f = min(20 degrees, gamma_0 / 2),
          0                                      else

K: bending stiffness of the adjacent halves of both elements in series, N m. To close the opening
they would take an energy of K gamma_0^2 / 2: the barrier is of that order, and zero at rest. The 20
degrees are chosen so that the barrier acts only where walls have nearly closed.

For the vector v of an element from the node, of length r: d arg(v) = (-v_y, v_x) / r^2 =: q, and
d2 arg(v) = [[-2 q_x q_y, q_x^2 - q_y^2], [., 2 q_x q_y]].
"""

import math
from typing import NamedTuple

import numpy as np

from kernels.arrays import triple
from kernels.compile.jit import jit
from kernels.geometry.angle import LARGEST, arctangent
from kernels.laws.barrier import barrier
from kernels.linear.condensed.block_matrix import add_block

LIMIT = math.radians(20.0)


class Fold(NamedTuple):
    """Openings: nodes (f, 3); the angle is anticlockwise from element 1-0 to element 1-2.

    limit (f,): gamma_f in rad. stiffness (f,): K (gamma_0 / 2)^2 in J.
    """

    nodes: np.ndarray
    limit: np.ndarray
    stiffness: np.ndarray


@jit
def _cross_dot(x, a, b, c):
    """Return (cross, dot) of arm b-a with arm b-c."""
    ax, ay = x[2 * a] - x[2 * b], x[2 * a + 1] - x[2 * b + 1]
    cx, cy = x[2 * c] - x[2 * b], x[2 * c + 1] - x[2 * b + 1]
    return ax * cy - ay * cx, ax * cx + ay * cy


@jit
def opening(x, fold, k):
    """Return min(gamma, 45 degrees) in rad; every limit is below 45 degrees.

    A negative cross product is an opening of more than 180 degrees: collision detection
    (`ccd.first_fold`) lets no element pass through the other.
    """
    a, b, c = triple(fold.nodes, k)
    cross, dot = _cross_dot(x, a, b, c)
    if cross < 0.0 or dot <= cross:
        return 0.25 * math.pi
    return arctangent(cross / dot) if cross < LARGEST * dot else math.atan2(cross, dot)


@jit
def _bearing_slope(x, b, c):
    """Return d arg(c - b) / dc in 1/m, x and y; the derivative in b is its negative."""
    vx, vy = x[2 * c] - x[2 * b], x[2 * c + 1] - x[2 * b + 1]
    r2 = vx * vx + vy * vy
    return -vy / r2, vx / r2


@jit
def evaluate(x, fold, g):
    """Return E_f in J and the least `opening` in rad (pi without any); add dE_f/dx to ``g``."""
    total, least = 0.0, math.pi
    for k in range(fold.limit.size):
        opened = opening(x, fold, k)
        least = min(least, opened)
        if opened < fold.limit[k]:
            value, slope, _ = barrier(opened / fold.limit[k])
            total += fold.stiffness[k] * value
            moment = fold.stiffness[k] / fold.limit[k] * slope
            a, b, c = triple(fold.nodes, k)
            px, py = _bearing_slope(x, b, a)
            qx, qy = _bearing_slope(x, b, c)
            g[2 * a] -= moment * px
            g[2 * a + 1] -= moment * py
            g[2 * c] += moment * qx
            g[2 * c + 1] += moment * qy
            g[2 * b] += moment * (px - qx)
            g[2 * b + 1] += moment * (py - qy)
    return total, least


@jit
def _outer(matrix, i, j, weight, px, py, qx, qy):
    """Add weight p q^T to the block of nodes ``i`` and ``j``."""
    i, j = 2 * i, 2 * j
    add_block(matrix, i, j, weight * px * qx, weight * px * qy, weight * py * qx, weight * py * qy)


@jit
def _curl(matrix, b, c, moment, qx, qy):
    """Add moment * d2 arg(c - b), whose entries are products of q = (qx, qy), `_bearing_slope`."""
    xx, xy = -2.0 * moment * qx * qy, moment * (qx * qx - qy * qy)
    add_block(matrix, 2 * c, 2 * c, xx, xy, xy, -xx)
    add_block(matrix, 2 * b, 2 * b, xx, xy, xy, -xx)
    add_block(matrix, 2 * c, 2 * b, -xx, -xy, -xy, xx)


@jit
def hessian(x, fold, matrix):
    """Add d2E_f/dx2."""
    for k in range(fold.limit.size):
        opened = opening(x, fold, k)
        if opened < fold.limit[k]:
            _, slope, curvature = barrier(opened / fold.limit[k])
            scale = fold.stiffness[k] / fold.limit[k]
            rigidity = scale / fold.limit[k] * curvature
            a, b, c = triple(fold.nodes, k)
            px, py = _bearing_slope(x, b, a)
            qx, qy = _bearing_slope(x, b, c)
            rx, ry = px - qx, py - qy
            _outer(matrix, a, a, rigidity, px, py, px, py)
            _outer(matrix, b, b, rigidity, rx, ry, rx, ry)
            _outer(matrix, c, c, rigidity, qx, qy, qx, qy)
            _outer(matrix, a, b, -rigidity, px, py, rx, ry)
            _outer(matrix, c, b, rigidity, qx, qy, rx, ry)
            _outer(matrix, a, c, -rigidity, px, py, qx, qy)
            _curl(matrix, b, c, scale * slope, qx, qy)
            _curl(matrix, b, a, -scale * slope, px, py)
