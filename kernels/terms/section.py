"""The law of a bent section: energy over the strain e of the centre line and the bending of fibres.

A wall of curvature kappa (per rest length) becomes thinner where its fibres are stretched and
thicker where they are compressed. A fibre at a distance z from the centre line at rest is at a
distance y when the wall is bent. With its stretch a, and lambda = 1 + e of the centre line,

    dy/dz = a^(-nu'),   a = lambda + kappa y.

Hence, with m = 1 + nu', a = (lambda^m + m kappa z)^(1/m), which is taken to third order:

    a = lambda (1 + zeta + (1 - m)/2 zeta^2 + (1 - m)(1 - 2 m)/6 zeta^3),  zeta = kappa z / lambda^m

Fibres are at Gauss points through the thickness, in pairs at +-z and one in the middle, which
belongs to stretching. The potential of a section is that of its pairs, over their part of the
volume,

    w(e, theta) = sum of v (W(a(theta p) - 1) + W(a(-theta p) - 1) - 2 W(e)) - R(theta),
    R = 2/3 (1 - nu'^2) Y' theta^4 / (1 + 5/3 theta^2).

theta = kappa z is the bending of the outer of three fibres, z = (3/20)^(1/2) t. A pair is p times
as far out and has v times its weight; of three fibres p = v = 1. R is the energy of the radial
stress Y' kappa^2 (t^2/4 - z^2) / 2 that keeps fibres on their bent line, (1 - nu'^2) Y' t^5 kappa^4
/ 240 per length and depth, here bounded for large bending. It stays elastic where fibres relax.
"""

from typing import NamedTuple

import numpy as np

from kernels.compile.jit import jit, jit_exact
from kernels.laws.law import commit_point

LEAST = 0.05  # stretch of the centre line up to which bending takes infinite energy, as lambda^(-m)
# grows without bound there; the barrier below `elastic.GUARD` keeps walls longer


@jit
def fibre(m, stretched, r, theta):
    """Return the stretch a and its derivatives in e, theta; ee, e theta, theta theta.

    m: of the module's formula. stretched: lambda. r: lambda^(-m). theta: kappa z of this fibre.
    """
    zeta = theta * r
    c2, c3 = 0.5 * (1.0 - m), (1.0 - m) * (1.0 - 2.0 * m) / 6.0
    f = 1.0 + zeta * (1.0 + zeta * (c2 + zeta * c3))
    slope = 1.0 + zeta * (2.0 * c2 + zeta * 3.0 * c3)
    second = 2.0 * c2 + 6.0 * c3 * zeta
    mixed = (1.0 - m) * slope - m * zeta * second
    return (
        stretched * f, f - m * zeta * slope, stretched * r * slope,
        -m * zeta / stretched * mixed, r * mixed, stretched * r * r * second,
    )  # fmt: skip


@jit
def radial(theta):
    """Return theta^4 / (1 + 5/3 theta^2) and its two derivatives."""
    c, q = 5.0 / 3.0, theta * theta
    by = 1.0 / (1.0 + c * q)
    in_q = q * (2.0 + c * q) * by * by
    return q * q * by, 2.0 * theta * in_q, 2.0 * in_q + 8.0 * q * by * by * by


@jit
def bent(law, stretched, r, theta, memory, point):
    """Return the part of w that is of bent fibres: w without its terms W(e), J/m^3.

    Its value is followed by the first derivatives in e and theta, and the second ones in e e, e
    theta and theta theta. point: material point of the first fibre.
    """
    value, slope, second = radial(theta)
    energy, by_e, by_theta = -law.radial * value, 0.0, -law.radial * slope
    ee, et, tt = 0.0, 0.0, -law.radial * second
    for k in range(law.place.size):
        place, weight = law.place[k], law.weight[k]
        a, a_e, a_t, a_ee, a_et, a_tt = fibre(law.m, stretched, r, place * theta)
        value, slope, second = law.curve.respond(a - 1.0, memory, point + k)
        slope, second, a_t = weight * slope, weight * second, place * a_t
        energy += weight * value
        by_e += slope * a_e
        by_theta += slope * a_t
        ee += second * a_e * a_e + slope * a_ee
        et += second * a_e * a_t + slope * (place * a_et)
        tt += second * a_t * a_t + slope * (place * place * a_tt)
    return energy, by_e, by_theta, ee, et, tt


@jit
def respond(law, strain, memory, point):
    """Return the sum of w over both sections of an element (J/m^3), its slopes in e, theta_1,
    theta_2 and the upper triangle of its second derivatives, row by row (Pa).

    point: of the first fibre of the first section; those of the second follow, then the middle.
    """
    e, one, two = strain
    fibres = law.place.size
    value, slope, second = law.curve.respond(e, memory, point + 2 * fibres)
    stretched, r = 1.0 + e, (1.0 + e) ** (-law.m)
    w1, e1, t1, ee1, et1, tt1 = bent(law, stretched, r, one, memory, point)
    w2, e2, t2, ee2, et2, tt2 = bent(law, stretched, r, two, memory, point + fibres)
    return (
        w1 + w2 - law.middle * value,
        (e1 + e2 - law.middle * slope, t1, t2),
        (ee1 + ee2 - law.middle * second, et1, et2, tt1, 0.0, tt2),
    )


@jit
def elastic(law):
    """Return the section with the elastic law of fibres alone, which is compiled without memory."""
    return BentSection(law.curve.elastic(), law.place, law.weight, law.middle, law.m, law.radial)


@jit
def points(law):
    """Return the number of material points of an element."""
    return 2 * law.place.size + 1


@jit_exact
def begin(law, memory, point):
    """Set the data of all points of an element for the present step."""
    for k in range(law.points()):
        law.curve.begin(memory, point + k)


@jit_exact
def commit(law, strain, memory, point):
    """Accept ``strain`` at all points of an element.

    Return (released, dissipated), J/m^3: potential less stored energy, and the dissipation.
    """
    e, middle = strain[0], point + 2 * law.place.size
    released, dissipated = commit_point(law.curve, e, memory, middle)
    released, dissipated = -law.middle * released, -law.middle * dissipated
    r = (1.0 + e) ** (-law.m)
    for section in range(2):
        for k in range(law.place.size):
            theta = law.place[k] * (strain[2] if section == 1 else strain[1])
            a = fibre(law.m, 1.0 + e, r, theta)[0]
            release, dissipation = commit_point(law.curve, a - 1.0, memory, point)
            released += law.weight[k] * release
            dissipated += law.weight[k] * dissipation
            point += 1
    return released, dissipated


class BentSection(NamedTuple):
    """curve: law of a fibre. place, weight (f,): +-p and v of the fibres of a section but the
    middle. middle: sum of v over both sections. m: 1 + nu'. radial: 2/3 (1 - nu'^2) Y', Pa.
    """

    curve: object
    place: np.ndarray
    weight: np.ndarray
    middle: float
    m: float
    radial: float

    elastic = elastic
    points = points
    begin = begin
    respond = respond
    commit = commit
