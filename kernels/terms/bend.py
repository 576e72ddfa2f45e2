"""Bending of the elements against the rotations of their ends.

With the turns a_1 and a_2 of `elements`,

    E_b = 1/2 (k_11 kappa_1^2 + 2 k_12 kappa_1 kappa_2 + k_22 kappa_2^2),   kappa_i = a_i (`ANGLE`)

A *cubic* element, whose deflection from the chord is a cubic, has k_11 = k_22 = 4 Y I / h and
k_12 = 2 Y I / h: its curvature is linear along the element,

    h kappa(s) = (4 - 6 s) a_1 + (2 - 6 s) a_2,   s = 0 .. 1.

A *classical* element is the rod of discrete hinges, a trapezoidal rule: k_11 = k_22 = 2 Y I / h and
k_12 = 0. Eliminating phi of a node inside a wall leaves a hinge of Y I / h between its elements.
The measure `TANGENT` of such a rod is kappa = c tan(a / c): c = 2 at joints and c = 1 inside walls,
where two elements share the turn of a hinge.

With a measured curve (``section``) E_b is a sum over two points of each element, the Gauss points
of a cubic and the ends of a classical element: E_b = sum_p w_p U(e_p), e_p = c (b_p1 kappa_1 + b_p2
kappa_2) the strain at the surface of the wall; U(e) = e^2 / 2 for a linear curve.
"""

import math
from typing import NamedTuple

import numpy as np

from kernels.compile.jit import jit

ANGLE, TANGENT = 0, 1
POINTS = 2  # material points of an element


class Bend(NamedTuple):
    """stiffness (3, m): k_11, k_12, k_22 in N m. side (2, m): c of the measure `TANGENT`.

    section: law of U' over the surface strain. points (2, 2): b. surface (m,): c, dimensionless;
    weight (2, m): w in J, empty where bending is linear.
    """

    measure: int
    stiffness: np.ndarray
    side: np.ndarray
    section: object
    points: np.ndarray
    surface: np.ndarray
    weight: np.ndarray


@jit
def curvature(bend, k, end, turn):
    """Return kappa and its first two derivatives in the ``turn`` at an end of element ``k``.

    kappa is infinite from where its tangent would change sign.
    """
    if bend.measure == ANGLE:
        return turn, 1.0, 0.0
    side = bend.side[end, k]
    if abs(turn) >= 0.5 * math.pi * side:
        return math.inf, 1.0, 0.0
    t = math.tan(turn / side)
    return side * t, 1.0 + t * t, 2.0 * t * (1.0 + t * t) / side


@jit
def _linear(bend, k, one, two):
    """Return E_b of element ``k`` with its derivatives in kappa_1, kappa_2: 1, 2, 11, 12, 22."""
    k11, k12, k22 = bend.stiffness[0, k], bend.stiffness[1, k], bend.stiffness[2, k]
    first, second = k11 * one + k12 * two, k12 * one + k22 * two
    return 0.5 * (first * one + second * two), first, second, k11, k12, k22


@jit
def surface_strain(bend, k, p, one, two):
    """Return e_p of element ``k`` and its derivatives in kappa_1 and kappa_2."""
    b1, b2 = bend.surface[k] * bend.points[p, 0], bend.surface[k] * bend.points[p, 1]
    return b1 * one + b2 * two, b1, b2


@jit
def _through_section(bend, memory, first_point, k, one, two, projected):
    """Return the same as `_linear` through the curve of the section."""
    total, f1, f2, f11, f12, f22 = 0.0, 0.0, 0.0, 0.0, 0.0, 0.0
    for p in range(POINTS):
        strain, b1, b2 = surface_strain(bend, k, p, one, two)
        point = first_point + POINTS * k + p
        value, slope, second = bend.section.respond(strain, memory, point)
        weight = bend.weight[p, k]
        if projected:
            second = max(second, 0.0)
        total += weight * value
        f1 += weight * slope * b1
        f2 += weight * slope * b2
        f11 += weight * second * b1 * b1
        f12 += weight * second * b1 * b2
        f22 += weight * second * b2 * b2
    return total, f1, f2, f11, f12, f22


@jit
def evaluate(bend, memory, shape, resultants, projected):
    """Return E_b in J; add its derivatives in the turns of ``shape`` to ``resultants``. Where E_b
    is infinite, these are incomplete.

    The points of the section are numbered after the elements. projected: without the second
    derivatives of kappa, and with no falling moment, which makes every element semi-definite.
    """
    force, rigidity, total = resultants.force, resultants.rigidity, 0.0
    curved, m = bend.weight.size > 0, shape.length.size
    for k in range(m):
        one, d1, s1 = curvature(bend, k, 0, shape.turn[0, k])
        two, d2, s2 = curvature(bend, k, 1, shape.turn[1, k])
        if math.isinf(one) or math.isinf(two):
            return math.inf
        if curved:
            value, f1, f2, f11, f12, f22 = _through_section(bend, memory, m, k, one, two, projected)
        else:
            value, f1, f2, f11, f12, f22 = _linear(bend, k, one, two)
        if projected:
            s1, s2 = 0.0, 0.0
        total += value
        force[1, k] += f1 * d1
        force[2, k] += f2 * d2
        rigidity[3, k] += f11 * d1 * d1 + f1 * s1
        rigidity[4, k] += f12 * d1 * d2
        rigidity[5, k] += f22 * d2 * d2 + f2 * s2
    return total


@jit
def commit(bend, memory, shape):
    """Commit the curvatures of ``shape`` to the section.

    Return (released, dissipated) in J: E_b less the stored energy, and the dissipation of the step.
    """
    released, dissipated, m = 0.0, 0.0, shape.length.size
    for k in range(bend.weight.shape[1]):
        one = curvature(bend, k, 0, shape.turn[0, k])[0]
        two = curvature(bend, k, 1, shape.turn[1, k])[0]
        for p in range(POINTS):
            strain = surface_strain(bend, k, p, one, two)[0]
            point, weight = m + POINTS * k + p, bend.weight[p, k]
            potential = bend.section.respond(strain, memory, point)[0]
            stored, lost = bend.section.commit(strain, memory, point)
            released += weight * (potential - stored)
            dissipated += weight * lost
    return released, dissipated
