"""Bending at rigid joints: E_b = sum 1/2 K kappa^2.

Inside a wall a *hinge* resists the angle between its two elements. At a joint every *arm* resists
its own turn against the joint's rotation phi, an unknown of its own. A wall of a single element
adds k12 kappa_1 kappa_2 between its two ends (a *coupling*), which makes it an exact beam.
Measures: kappa = delta (``angle``) or 2 tan(delta / 2) (``tangent``), delta the turn from rest.
"""

import math
from typing import NamedTuple

import numpy as np

from kernels import angle
from kernels.jit import jit
from kernels.rows import pair, triple
from kernels.sparse import add, add_block

ANGLE, TANGENT = 0, 1


class Bend(NamedTuple):
    """Hinges and arms; stiffness in N m, rest angles as (cos, sin).

    hinges (h, 3): nodes before, at and after. arms (k, 3): node at the joint, node at the other
    end of the element, coordinate of the joint's rotation. couplings (q, 2): the two arms of a
    single-element wall.
    """

    measure: int
    hinges: np.ndarray
    hinge_rest: np.ndarray
    hinge_stiffness: np.ndarray
    arms: np.ndarray
    arm_rest: np.ndarray
    arm_stiffness: np.ndarray
    couplings: np.ndarray
    coupling_stiffness: np.ndarray


@jit
def curvature(measure, delta):
    """Return kappa and its first two derivatives in the turn ``delta``."""
    if measure == ANGLE:
        return delta, 1.0, 0.0
    t = math.tan(0.5 * delta)
    return 2.0 * t, 1.0 + t * t, t * (1.0 + t * t)


@jit
def hinge_turn(x, bend, k):
    """Return the turn of hinge ``k`` from rest."""
    a, b, c = triple(bend.hinges, k)
    cross, dot = angle.between(x, a, b, c)
    return angle.turned(cross, dot, bend.hinge_rest[k, 0], bend.hinge_rest[k, 1])


@jit
def arm_turn(x, bend, k):
    """Return the turn of arm ``k`` from its rest direction, relative to its joint."""
    b, c, rotation = triple(bend.arms, k)
    return angle.arm_turned(x, b, c, x[rotation], bend.arm_rest[k, 0], bend.arm_rest[k, 1])


@jit
def energy(x, bend):
    """Return E_b in J."""
    total = 0.0
    for k in range(bend.hinge_stiffness.size):
        kappa, _, _ = curvature(bend.measure, hinge_turn(x, bend, k))
        total += 0.5 * bend.hinge_stiffness[k] * kappa * kappa
    for k in range(bend.arm_stiffness.size):
        kappa, _, _ = curvature(bend.measure, arm_turn(x, bend, k))
        total += 0.5 * bend.arm_stiffness[k] * kappa * kappa
    for k in range(bend.coupling_stiffness.size):
        kappa1, _, _ = curvature(bend.measure, arm_turn(x, bend, bend.couplings[k, 0]))
        kappa2, _, _ = curvature(bend.measure, arm_turn(x, bend, bend.couplings[k, 1]))
        total += bend.coupling_stiffness[k] * kappa1 * kappa2
    return total


@jit
def gradient(x, bend, g):
    """Add dE_b/dx to ``g``; entries of rotations are moments, N m."""
    for k in range(bend.hinge_stiffness.size):
        a, b, c = triple(bend.hinges, k)
        kappa, d1, _ = curvature(bend.measure, hinge_turn(x, bend, k))
        angle.twist(g, x, a, b, c, bend.hinge_stiffness[k] * kappa * d1)
    for k in range(bend.arm_stiffness.size):
        b, c, rotation = triple(bend.arms, k)
        kappa, d1, _ = curvature(bend.measure, arm_turn(x, bend, k))
        angle.arm_twist(g, x, b, c, rotation, bend.arm_stiffness[k] * kappa * d1)
    for k in range(bend.coupling_stiffness.size):
        one, two = pair(bend.couplings, k)
        kappa1, d1, _ = curvature(bend.measure, arm_turn(x, bend, one))
        kappa2, d2, _ = curvature(bend.measure, arm_turn(x, bend, two))
        k12 = bend.coupling_stiffness[k]
        angle.arm_twist(g, x, *triple(bend.arms, one), k12 * kappa2 * d1)
        angle.arm_twist(g, x, *triple(bend.arms, two), k12 * kappa1 * d2)


@jit
def _stiffness(measure, weight, delta, projected):
    """Return d2 and d of weight/2 kappa^2 in the turn; ``projected`` drops what may be negative."""
    kappa, d1, d2 = curvature(measure, delta)
    if projected:
        return weight * d1 * d1, 0.0
    return weight * (d1 * d1 + kappa * d2), weight * kappa * d1


@jit
def hessian(x, bend, matrix, projected):
    """Add d2E_b/dx2; ``projected`` keeps what is positive semi-definite in every element."""
    for k in range(bend.hinge_stiffness.size):
        a, b, c = triple(bend.hinges, k)
        stiffness, moment = _stiffness(
            bend.measure, bend.hinge_stiffness[k], hinge_turn(x, bend, k), projected
        )
        angle.twist_stiffen(matrix, x, a, b, c, stiffness, moment)
    for k in range(bend.arm_stiffness.size):
        b, c, rotation = triple(bend.arms, k)
        stiffness, moment = _stiffness(
            bend.measure, bend.arm_stiffness[k], arm_turn(x, bend, k), projected
        )
        angle.arm_stiffen(matrix, x, b, c, rotation, stiffness, moment)
    for k in range(bend.coupling_stiffness.size):
        _couple(x, bend, k, matrix, projected)


@jit
def _couple(x, bend, k, matrix, projected):
    """Add the Hessian of k12 kappa1 kappa2. With k12 = k1/2 = k2/2 the sum stays semi-definite."""
    one, two = pair(bend.couplings, k)
    kappa1, d1, e1 = curvature(bend.measure, arm_turn(x, bend, one))
    kappa2, d2, e2 = curvature(bend.measure, arm_turn(x, bend, two))
    k12 = bend.coupling_stiffness[k]
    if not projected:
        angle.arm_stiffen(matrix, x, *triple(bend.arms, one), k12 * kappa2 * e1, k12 * kappa2 * d1)
        angle.arm_stiffen(matrix, x, *triple(bend.arms, two), k12 * kappa1 * e2, k12 * kappa1 * d2)
    cross(x, matrix, triple(bend.arms, one), triple(bend.arms, two), k12 * d1 * d2)


@jit
def cross(x, matrix, one, two, weight):
    """Add weight (p q^T + q p^T) for the turns of the two arms p, q of one element.

    Both arms lie along the element i-j and so have the same slope s: p = q = s (e_j - e_i) but
    for the rotations, -1 at the own joint's.
    """
    i, j, first = one
    _, _, second = two
    sx, sy = angle.slope(x, i, j)
    xx, xy, yy = 2.0 * weight * sx * sx, 2.0 * weight * sx * sy, 2.0 * weight * sy * sy
    add_block(matrix, 2 * i, 2 * i, xx, xy, xy, yy)
    add_block(matrix, 2 * j, 2 * j, xx, xy, xy, yy)
    add_block(matrix, 2 * i, 2 * j, -xx, -xy, -xy, -yy)
    for rotation in (first, second):
        add(matrix, rotation, 2 * i, weight * sx)
        add(matrix, rotation, 2 * i + 1, weight * sy)
        add(matrix, rotation, 2 * j, -weight * sx)
        add(matrix, rotation, 2 * j + 1, -weight * sy)
    add(matrix, first, second, weight)
