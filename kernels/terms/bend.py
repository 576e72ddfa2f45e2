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

With a measured curve (``section``) the curvature counts at two points of an element, the Gauss
points of a cubic or the ends of a classical element:

    theta = s_0 (a_2 - a_1) +- s_1 (a_1 + a_2),
    E_b = V w(e, theta_1, theta_2) + 1/2 k_s (a_1 + a_2)^2

with the law w of `section` over the strain e of `stretch` and the bending theta of a fibre at both,
V the volume that each of its fibres stands for, and the stiffness k_s of the element in shear.
"""

import math
from typing import NamedTuple

import numpy as np

from kernels.compile.jit import jit
from kernels.terms.section import LEAST
from kernels.terms.stretch import strain

ANGLE, TANGENT = 0, 1


class Bend(NamedTuple):
    """stiffness (3, m): k_11, k_12, k_22 in N m. side (2, m): c of the measure `TANGENT`.

    section: law over e, theta_1, theta_2; an element is one material point. spread (2, m): s_0,
    s_1. volume (m,): V in m^3, zero where an element bends linearly. shear (m,): k_s in N m. The
    three are empty where all bending is linear.
    """

    measure: int
    stiffness: np.ndarray
    side: np.ndarray
    section: object
    spread: np.ndarray
    volume: np.ndarray
    shear: np.ndarray


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
def _linear(bend, k, shape, resultants, projected):
    """Return E_b of element ``k`` of linear bending; add its derivatives."""
    one, d1, s1 = curvature(bend, k, 0, shape.turn[0, k])
    two, d2, s2 = curvature(bend, k, 1, shape.turn[1, k])
    if math.isinf(one) or math.isinf(two):
        return math.inf
    if projected:
        s1, s2 = 0.0, 0.0
    force, rigidity = resultants.force, resultants.rigidity
    k11, k12, k22 = bend.stiffness[0, k], bend.stiffness[1, k], bend.stiffness[2, k]
    first, second = k11 * one + k12 * two, k12 * one + k22 * two
    force[1, k] += first * d1
    force[2, k] += second * d2
    rigidity[3, k] += k11 * d1 * d1 + first * s1
    rigidity[4, k] += k12 * d1 * d2
    rigidity[5, k] += k22 * d2 * d2 + second * s2
    return 0.5 * (first * one + second * two)


@jit
def bending(bend, shape, k):
    """Return theta_1 and theta_2 of element ``k``."""
    across = bend.spread[0, k] * (shape.turn[1, k] - shape.turn[0, k])
    along = bend.spread[1, k] * (shape.turn[0, k] + shape.turn[1, k])
    return across + along, across - along


@jit
def _through_section(bend, stretch, memory, k, shape, resultants, projected):
    """Return E_b of element ``k`` through the law of its section; add its derivatives."""
    force, rigidity, volume = resultants.force, resultants.rigidity, bend.volume[k]
    e, e1, e2 = strain(stretch, shape, k)
    if e <= LEAST - 1.0:
        return math.inf
    one, two = bending(bend, shape, k)
    value, (by_e, m1, m2), (ee, et1, et2, tt1, _, tt2) = bend.section.respond(
        (e, one, two), memory, bend.volume.size + k
    )
    s0, s1 = bend.spread[0, k], bend.spread[1, k]
    p, q = s1 - s0, s1 + s0  # of theta_1 in a_1 and a_2; of theta_2: -q, -p
    both = shape.turn[0, k] + shape.turn[1, k]
    sheared, by_length = bend.shear[k], volume / stretch.l0[k]
    force[0, k] += by_length * by_e
    force[1, k] += volume * (by_e * e1 + m1 * p - m2 * q) + sheared * both
    force[2, k] += volume * (by_e * e2 + m1 * q - m2 * p) + sheared * both
    if projected:
        by_e, ee, et1, et2, tt1, tt2 = 0.0, 0.0, 0.0, 0.0, max(tt1, 0.0), max(tt2, 0.0)
    c1, c2 = et1 * p - et2 * q, et1 * q - et2 * p  # second derivatives in e and a_1, a_2
    same, mixed = 2.0 * by_e * stretch.arc[0, k], by_e * stretch.arc[1, k]
    rigidity[0, k] += by_length / stretch.l0[k] * ee
    rigidity[1, k] += by_length * (ee * e1 + c1)
    rigidity[2, k] += by_length * (ee * e2 + c2)
    rigidity[3, k] += sheared + volume * (
        (ee * e1 + 2.0 * c1) * e1 + tt1 * p * p + tt2 * q * q + same
    )
    rigidity[4, k] += sheared + volume * (
        ee * e1 * e2 + c1 * e2 + c2 * e1 + (tt1 + tt2) * p * q + mixed
    )
    rigidity[5, k] += sheared + volume * (
        (ee * e2 + 2.0 * c2) * e2 + tt1 * q * q + tt2 * p * p + same
    )
    return volume * value + 0.5 * sheared * both * both


@jit
def evaluate(bend, stretch, memory, shape, resultants, projected):
    """Return E_b in J; add its derivatives to ``resultants``. Where E_b is infinite, these are
    incomplete.

    The points of the section are numbered after those of stretching. projected: without the second
    derivatives of kappa and of e, and with no falling moment, which makes every element
    semi-definite.
    """
    total, curved = 0.0, bend.volume.size > 0
    for k in range(shape.length.size):
        if curved and bend.volume[k] > 0.0:
            total += _through_section(bend, stretch, memory, k, shape, resultants, projected)
        else:
            total += _linear(bend, k, shape, resultants, projected)
        if math.isinf(total):
            return math.inf
    return total


@jit
def commit(bend, stretch, memory, shape):
    """Commit the strains of ``shape`` to the section.

    Return (released, dissipated) in J: E_b less the stored energy, and the dissipation of the step.
    """
    released, dissipated = 0.0, 0.0
    for k in range(bend.volume.size):
        volume = bend.volume[k]
        if volume == 0.0:
            continue
        at, point = (strain(stretch, shape, k)[0], *bending(bend, shape, k)), bend.volume.size + k
        potential = bend.section.respond(at, memory, point)[0]
        stored, lost = bend.section.commit(at, memory, point)
        released += volume * (potential - stored)
        dissipated += volume * lost
    return released, dissipated
