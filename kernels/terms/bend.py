"""Bending of the elements against the rotations of their ends.

With the turns a_1 and a_2 of `elements`,

    E_b = 1/2 (k_11 chi_1^2 + 2 k_12 chi_1 chi_2 + k_22 chi_2^2),   chi_i = a_i (`ANGLE`), rad

A *cubic* element, whose deflection from the chord is a cubic, has k_11 = k_22 = 4 Y I / l0 and
k_12 = 2 Y I / l0 (with shear: sweep/scene/beams.py). Its curvature in 1/m is linear along it,

    l0 kappa(s) = (4 - 6 s) a_1 + (2 - 6 s) a_2,   s = 0 .. 1.

A *classical* element is the rod of discrete hinges, a trapezoidal rule: k_11 = k_22 = 2 Y I / l0
and k_12 = 0. Eliminating phi of a node inside a wall leaves a hinge of Y I / l0 between its
elements. The measure `TANGENT` of such a rod is chi = c tan(a / c): c = 2 at joints and c = 1
inside walls, where two elements share the turn of a hinge.

With a measured curve (``section``) an element has two sections, at the Gauss points of a cubic or
at the ends of a classical element:

    E_b = V [w(e, theta_1) + w(e, theta_2)] + 1/2 k_s (a_1 + a_2)^2,
    theta_i = s_0 (a_2 - a_1) +- s_1 (a_1 + a_2)

w: potential of one section, J/m^3. e: strain of `stretch`. theta: bending kappa z of its outer
fibre (`section`), up to a sign, which is immaterial as fibres are in pairs. Hence s_0 = z / l0 and,
without shear, s_1 = 3^(1/2) s_0 in a cubic, s_0 in a classical element (sweep/scene/bending.py).
theta_1 belongs to the section nearer end 2. V: volume that each fibre represents, m^3. k_s:
stiffness of the element in shear, N m.

Where the material relaxes, linear bending and shear relax alike: each is made of springs whose law,
`hinge`, has unit stiffness. Linear bending is the sum of two springs,

    k_11 (chi_1 + k_12 / k_11 chi_2)^2 / 2 + (k_22 - k_12^2 / k_11) chi_2^2 / 2.
"""

import math
from typing import NamedTuple

import numpy as np

from kernels.compile.jit import jit, jit_exact
from kernels.terms.section import LEAST
from kernels.terms.stretch import strain

ANGLE, TANGENT = 0, 1


class Bend(NamedTuple):
    """stiffness (3, m): k_11, k_12, k_22 in N m. side (2, m): c of the measure `TANGENT`.

    section: law of both sections. hinge: law of linear springs, of unit stiffness. spread (2, m):
    s_0, s_1, numbers. volume (m,): V in m^3, zero where an element bends linearly. shear (m,): k_s
    in N m. The last three are empty where all bending is linear.
    """

    measure: int
    stiffness: np.ndarray
    side: np.ndarray
    section: object
    hinge: object
    spread: np.ndarray
    volume: np.ndarray
    shear: np.ndarray


@jit
def points(bend):
    """Return the number of material points of an element: the points of its section and one for its
    shear, or two springs of linear bending.
    """
    return bend.section.points() + 1


@jit
def is_bent(bend, k):
    """Return whether element ``k`` bends through its section."""
    return bend.volume.size > 0 and bend.volume[k] > 0.0


@jit
def measured(bend, k, end, turn):
    """Return chi and its first two derivatives in the ``turn`` at an end of element ``k``.

    chi is infinite from the pole of its tangent on, |a| >= c pi / 2.
    """
    if bend.measure == ANGLE:
        return turn, 1.0, 0.0
    side = bend.side[end, k]
    if abs(turn) >= 0.5 * math.pi * side:
        return math.inf, 1.0, 0.0
    t = math.tan(turn / side)
    return side * t, 1.0 + t * t, 2.0 * t * (1.0 + t * t) / side


@jit
def _spring(bend, strain, memory, point):
    """Return potential, force and tangent of a spring of unit stiffness."""
    if bend.hinge.state_size() == 0:
        return 0.5 * strain * strain, strain, 1.0
    return bend.hinge.respond(strain, memory, point)


@jit
def _springs(bend, k):
    """Return k_11, k_12 / k_11 and k_22 - k_12^2 / k_11."""
    k11, k12 = bend.stiffness[0, k], bend.stiffness[1, k]
    ratio = k12 / k11 if k11 > 0.0 else 0.0
    return k11, ratio, bend.stiffness[2, k] - ratio * k12


@jit
def _moments(bend, k, one, two, memory, point):
    """Return E_b of linear bending, its slopes in both chi, and its second derivatives."""
    if bend.hinge.state_size() == 0:
        k11, k12, k22 = bend.stiffness[0, k], bend.stiffness[1, k], bend.stiffness[2, k]
        first, second = k11 * one + k12 * two, k12 * one + k22 * two
        return 0.5 * (first * one + second * two), first, second, k11, k12, k22
    stiff, ratio, rest = _springs(bend, k)
    v1, s1, t1 = bend.hinge.respond(one + ratio * two, memory, point)
    v2, s2, t2 = bend.hinge.respond(two, memory, point + 1)
    first, k11 = stiff * s1, stiff * t1
    second, k12, k22 = ratio * first + rest * s2, ratio * k11, ratio * ratio * k11 + rest * t2
    return stiff * v1 + rest * v2, first, second, k11, k12, k22


@jit
def _linear(bend, memory, point, k, shape, resultants, projected):
    """Return E_b of element ``k`` of linear bending; add its derivatives."""
    one, d1, s1 = measured(bend, k, 0, shape.turn[0, k])
    two, d2, s2 = measured(bend, k, 1, shape.turn[1, k])
    if math.isinf(one) or math.isinf(two):
        return math.inf
    if projected:
        s1, s2 = 0.0, 0.0
    energy, first, second, k11, k12, k22 = _moments(bend, k, one, two, memory, point)
    force, rigidity = resultants.force, resultants.rigidity
    force[1, k] += first * d1
    force[2, k] += second * d2
    _stiffen(rigidity, k, k11 * d1 * d1 + first * s1, k12 * d1 * d2, k22 * d2 * d2 + second * s2)
    return energy


@jit
def _stiffen(rigidity, k, one, mixed, two):
    """Add second derivatives in a_1 and a_2 of element ``k``."""
    rigidity[3, k] += one
    rigidity[4, k] += mixed
    rigidity[5, k] += two


@jit
def bending(bend, shape, k):
    """Return theta_1 and theta_2 of element ``k``."""
    across = bend.spread[0, k] * (shape.turn[1, k] - shape.turn[0, k])
    along = bend.spread[1, k] * (shape.turn[0, k] + shape.turn[1, k])
    return across + along, across - along


@jit
def _through_section(bend, stretch, memory, point, k, shape, resultants, projected):
    """Return E_b of element ``k`` through the law of its section; add its derivatives."""
    force, rigidity, volume = resultants.force, resultants.rigidity, bend.volume[k]
    e, e1, e2 = strain(stretch, shape, k)
    if e <= LEAST - 1.0:
        return math.inf
    one, two = bending(bend, shape, k)
    value, (by_e, m1, m2), (ee, et1, et2, tt1, _, tt2) = bend.section.respond(
        (e, one, two), memory, point
    )
    s0, s1 = bend.spread[0, k], bend.spread[1, k]
    p, q = s1 - s0, s1 + s0  # of theta_1 in a_1 and a_2; of theta_2: -q, -p
    both, by_length = shape.turn[0, k] + shape.turn[1, k], volume / stretch.l0[k]
    work, push, rigid = _spring(bend, both, memory, point + bend.section.points())
    push, rigid = bend.shear[k] * push, bend.shear[k] * rigid
    force[0, k] += by_length * by_e
    force[1, k] += volume * (by_e * e1 + m1 * p - m2 * q) + push
    force[2, k] += volume * (by_e * e2 + m1 * q - m2 * p) + push
    if projected:
        by_e, ee, et1, et2, tt1, tt2 = 0.0, 0.0, 0.0, 0.0, max(tt1, 0.0), max(tt2, 0.0)
    c1, c2 = et1 * p - et2 * q, et1 * q - et2 * p  # second derivatives in e and a_1, a_2
    same, mixed = 2.0 * by_e * stretch.arc[0, k], by_e * stretch.arc[1, k]
    rigidity[0, k] += by_length / stretch.l0[k] * ee
    rigidity[1, k] += by_length * (ee * e1 + c1)
    rigidity[2, k] += by_length * (ee * e2 + c2)
    rigidity[3, k] += rigid + volume * (
        (ee * e1 + 2.0 * c1) * e1 + tt1 * p * p + tt2 * q * q + same
    )
    rigidity[4, k] += rigid + volume * (
        ee * e1 * e2 + c1 * e2 + c2 * e1 + (tt1 + tt2) * p * q + mixed
    )
    rigidity[5, k] += rigid + volume * (
        (ee * e2 + 2.0 * c2) * e2 + tt1 * q * q + tt2 * p * p + same
    )
    return volume * value + bend.shear[k] * work


@jit
def evaluate(bend, stretch, memory, shape, resultants, projected):
    """Return E_b in J; add its derivatives to ``resultants``, which are incomplete if E_b is
    infinite.

    Material points are numbered after the points of stretching. projected: without the second
    derivatives of chi and of e, and with no falling moment, which makes every element
    semi-definite.
    """
    if bend.section.curve.is_elastic:
        return _evaluate(_elastic(bend), stretch, (), shape, resultants, projected)
    return _evaluate(bend, stretch, memory, shape, resultants, projected)


@jit
def _elastic(bend):
    """Return the data of bending with the elastic laws alone, which are compiled without memory."""
    section, hinge = bend.section.elastic(), bend.hinge.elastic()
    return Bend(
        bend.measure, bend.stiffness, bend.side, section, hinge, bend.spread, bend.volume,
        bend.shear,
    )  # fmt: skip


@jit
def _evaluate(bend, stretch, memory, shape, resultants, projected):
    """Return E_b as `evaluate` does. Laws with and without memory are compiled separately."""
    total, point, each = 0.0, shape.length.size, points(bend)
    for k in range(shape.length.size):
        if is_bent(bend, k):
            total += _through_section(bend, stretch, memory, point, k, shape, resultants, projected)
        else:
            total += _linear(bend, memory, point, k, shape, resultants, projected)
        point += each
        if math.isinf(total):
            return math.inf
    return total


@jit_exact
def begin(bend, memory):
    """Set the data of all material points of bending for the present step."""
    point, each = bend.stiffness.shape[1], points(bend)
    for k in range(bend.stiffness.shape[1]):
        if is_bent(bend, k):
            bend.section.begin(memory, point)
            bend.hinge.begin(memory, point + bend.section.points())
        else:
            bend.hinge.begin(memory, point)
            bend.hinge.begin(memory, point + 1)
        point += each


@jit_exact
def _commit_section(bend, stretch, memory, point, k, shape):
    """Commit the strains of element ``k`` to its section; return the results of `commit`."""
    at = (strain(stretch, shape, k)[0], *bending(bend, shape, k))
    released, dissipated = bend.section.commit(at, memory, point)
    both = shape.turn[0, k] + shape.turn[1, k]
    release, dissipation = bend.hinge.commit(both, memory, point + bend.section.points())
    volume, shear = bend.volume[k], bend.shear[k]
    return volume * released + shear * release, volume * dissipated + shear * dissipation


@jit_exact
def _commit_linear(bend, memory, point, k, shape):
    """Commit the turns of element ``k``; return the results of `commit`."""
    stiff, ratio, rest = _springs(bend, k)
    one, two = (
        measured(bend, k, 0, shape.turn[0, k])[0],
        measured(bend, k, 1, shape.turn[1, k])[0],
    )
    release1, dissipation1 = bend.hinge.commit(one + ratio * two, memory, point)
    release2, dissipation2 = bend.hinge.commit(two, memory, point + 1)
    return stiff * release1 + rest * release2, stiff * dissipation1 + rest * dissipation2


@jit_exact
def commit(bend, stretch, memory, shape):
    """Commit the strains of ``shape`` to the laws of bending.

    Return (released, dissipated) in J: E_b less the stored energy, and the dissipation of the step.
    """
    released, dissipated, point, each = 0.0, 0.0, shape.length.size, points(bend)
    for k in range(shape.length.size):
        if is_bent(bend, k):
            release, dissipation = _commit_section(bend, stretch, memory, point, k, shape)
        else:
            release, dissipation = _commit_linear(bend, memory, point, k, shape)
        released += release
        dissipated += dissipation
        point += each
    return released, dissipated
