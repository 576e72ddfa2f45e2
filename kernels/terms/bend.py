"""Bending at rigid joints: E_b = sum 1/2 K kappa^2.

Inside a wall a *hinge* resists the angle between its two elements. At a joint every *arm*, the
first element of a wall, resists its turn against the rotation phi of the joint, which is an
unknown. A wall of a single element adds k12 kappa_1 kappa_2 between its two ends, which makes it an
exact beam. Measures: kappa = delta (``angle``) or 2 tan(delta / 2) (``tangent``), delta the turn
from rest. With a measured curve (``section``) 1/2 kappa^2 becomes U(s) / c^2, s = c kappa the
strain at the surface of the wall; U(s) = 1/2 s^2 for a linear curve. The fold barrier keeps the
linear K: for a hinge of opening g = pi - |angle| it is K (g0 / 2)^2 b(g / g_f).
"""

import math
from typing import NamedTuple

import numpy as np

from kernels.compile.jit import jit
from kernels.terms import elements
from kernels.terms.barrier import barrier

ANGLE, TANGENT = 0, 1
FOLD_LIMIT = math.radians(20.0)
NEAR_ENOUGH = 0.5  # rad


class Bend(NamedTuple):
    """Hinges and arms; stiffness in N m.

    hinges (h,): first of its two elements. hinge_angle (h,): angle between them at rest, rad.
    arm_rest (2 w, 2): bearing of each arm at rest (cos, sin). coupling (w,): k12. section: law of
    U' over the surface strain s. hinge_surface (h,), arm_surface (2 w,): surface strain per unit of
    kappa; empty where bending is linear.
    """

    measure: int
    hinges: np.ndarray
    hinge_angle: np.ndarray
    hinge_stiffness: np.ndarray
    arm_rest: np.ndarray
    arm_stiffness: np.ndarray
    coupling: np.ndarray
    section: object
    hinge_surface: np.ndarray
    arm_surface: np.ndarray


@jit
def curvature(measure, delta):
    """Return kappa and its first two derivatives in the turn ``delta``."""
    if measure == ANGLE:
        return delta, 1.0, 0.0
    t = math.tan(0.5 * delta)
    return 2.0 * t, 1.0 + t * t, t * (1.0 + t * t)


@jit
def between(cos_a, sin_a, cos_b, sin_b):
    """Return the angle from direction a to direction b, in (-pi, pi]."""
    return math.atan2(cos_a * sin_b - sin_a * cos_b, cos_a * cos_b + sin_a * sin_b)


@jit
def renew_frame(x, walls, bend, frame):
    """Update ``frame`` (2 w, 3): rest bearing of every arm rotated with its joint (cos, sin), and
    phi.

    The turn of an arm is measured from its frame, so that it never wraps. A frame within
    `NEAR_ENOUGH` of the present phi is kept.
    """
    for a in range(frame.shape[0]):
        phi = x[walls.rotation[a]]
        if abs(phi - frame[a, 2]) < NEAR_ENOUGH:
            continue
        co, si = math.cos(phi), math.sin(phi)
        frame[a, 0] = co * bend.arm_rest[a, 0] - si * bend.arm_rest[a, 1]
        frame[a, 1] = si * bend.arm_rest[a, 0] + co * bend.arm_rest[a, 1]
        frame[a, 2] = phi


@jit
def turns(x, walls, bend, frame, shape):
    """Fill the turns of hinges and arms from rest; return the least opening of a hinge, rad."""
    t, widest = shape.t, 0.0
    for h in range(bend.hinges.size):
        k = bend.hinges[h]
        angle = between(t[0, k], t[1, k], t[0, k + 1], t[1, k + 1])
        shape.hinge_turn[k] = angle - bend.hinge_angle[h]
        widest = max(widest, abs(angle))
    for a in range(frame.shape[0]):
        k = walls.arm_element[a]
        delta = between(frame[a, 0], frame[a, 1], t[0, k], t[1, k])
        shape.arm_turn[a] = delta - (x[walls.rotation[a]] - frame[a, 2])
    return math.pi - widest


@jit
def _folding(stiffness, angle, rest):
    """Return energy, moment and rigidity of the fold barrier of a hinge at ``angle``."""
    side = 1.0 if angle > 0.0 else -1.0
    opened, opened_rest = math.pi - side * angle, math.pi - side * rest
    limit = min(FOLD_LIMIT, 0.5 * opened_rest)
    if opened >= limit:
        return 0.0, 0.0, 0.0
    scale = stiffness * (0.5 * opened_rest) ** 2
    value, slope, second = barrier(opened / limit)
    return scale * value, -side * scale / limit * slope, scale / limit**2 * second


@jit
def response(section, c, kappa, memory, point):
    """Return energy, moment and rigidity over the stiffness; surface strain c kappa."""
    energy, moment, rigidity = section.respond(c * kappa, memory, point)
    return energy / (c * c), moment / c, rigidity


@jit
def _hinges(bend, memory, first, shape, stiffness, projected):
    total, curved = 0.0, bend.hinge_surface.size > 0
    for h in range(bend.hinges.size):
        k, weight = bend.hinges[h], bend.hinge_stiffness[h]
        delta = shape.hinge_turn[k]
        kappa, d1, d2 = curvature(bend.measure, delta)
        rest = bend.hinge_angle[h]
        folding, moment, rigidity = _folding(weight, rest + delta, rest)
        value, slope, second = 0.5 * kappa * kappa, kappa, 1.0
        if curved:
            value, slope, second = response(
                bend.section, bend.hinge_surface[h], kappa, memory, first + h
            )
            if projected:
                second = max(second, 0.0)
        total += weight * value + folding
        moment += weight * slope * d1
        rigidity += weight * second * d1 * d1
        if not projected:
            rigidity += weight * slope * d2
        elements.turn_hinge(shape, stiffness, k, moment, rigidity, 0.0 if projected else moment)
    return total


@jit
def _arms(walls, bend, memory, first, shape, stiffness, projected):
    """Add both arms of every wall; with k12 = k1 / 2 = k2 / 2 the projection is semi-definite."""
    total, curved = 0.0, bend.arm_surface.size > 0
    for w in range(bend.coupling.size):
        k12 = bend.coupling[w]
        one, e1, s1 = curvature(bend.measure, shape.arm_turn[2 * w])
        two, e2, s2 = curvature(bend.measure, shape.arm_turn[2 * w + 1])
        total += k12 * one * two
        for a, kappa, d1, d2, other in ((2 * w, one, e1, s1, two), (2 * w + 1, two, e2, s2, one)):
            weight = bend.arm_stiffness[a]
            value, slope, second = 0.5 * kappa * kappa, kappa, 1.0
            if curved:
                value, slope, second = response(
                    bend.section, bend.arm_surface[a], kappa, memory, first + a
                )
                if projected:
                    second = max(second, 0.0)
            total += weight * value
            force = weight * slope + k12 * other
            rigidity = weight * second * d1 * d1 + (0.0 if projected else force * d2)
            bent = 0.0 if projected else force * d1
            elements.turn_arm(shape, stiffness, walls, a, force * d1, rigidity, bent)
        if k12 > 0.0:
            elements.couple_arms(shape, stiffness, walls, w, k12 * e1 * e2)
    return total


@jit
def evaluate(walls, bend, memory, shape, stiffness, projected):
    """Return E_b in J, folds of hinges included; add its derivatives in the turns of ``shape``.

    Hinges and arms are material points of the section, numbered after the elements. projected: the
    Hessian of every hinge and wall is projected to be positive semi-definite.
    """
    first = walls.edges.shape[0]
    total = _hinges(bend, memory, first, shape, stiffness, projected)
    first += bend.hinges.size
    return total + _arms(walls, bend, memory, first, shape, stiffness, projected)


@jit
def commit(walls, bend, memory, shape):
    """Commit the curvatures of ``shape`` to the section.

    Return (released, dissipated) in J: E_b less the stored energy, and the dissipation of the step.
    """
    released, dissipated, first = 0.0, 0.0, walls.edges.shape[0]
    for h in range(bend.hinge_surface.size):
        c = bend.hinge_surface[h]
        strain = c * curvature(bend.measure, shape.hinge_turn[bend.hinges[h]])[0]
        weight = bend.hinge_stiffness[h] / (c * c)
        potential = bend.section.respond(strain, memory, first + h)[0]
        stored, lost = bend.section.commit(strain, memory, first + h)
        released += weight * (potential - stored)
        dissipated += weight * lost
    first += bend.hinges.size
    for a in range(bend.arm_surface.size):
        c = bend.arm_surface[a]
        strain = c * curvature(bend.measure, shape.arm_turn[a])[0]
        weight = bend.arm_stiffness[a] / (c * c)
        potential = bend.section.respond(strain, memory, first + a)[0]
        stored, lost = bend.section.commit(strain, memory, first + a)
        released += weight * (potential - stored)
        dissipated += weight * lost
    return released, dissipated
