"""The law of a bent section: energy over the strain e of the centre line and the bending of fibres.

A wall of curvature kappa (per rest length) becomes thinner where its fibres are stretched and
thicker where they are compressed. A fibre at a distance z from the centre line at rest is at a
distance y when the wall is bent. With its stretch a, and lambda = 1 + e of the centre line,

    dy/dz = a^(-nu'),   a = lambda + kappa y.

Hence, with m = 1 + nu', a^m = q = lambda^m + m kappa z; for m = 2, a sheet that keeps its volume,
this is the exact bending of a block (Rivlin 1949). Below `CRUSHED`, where measured curves end, a is
continued to second order in q.

Fibres are at Gauss points through the thickness, in pairs at +-z and one in the middle, which
belongs to stretching. The potential of a section is summed over its pairs, by their part of the
volume,

    w(e, theta) = sum of v (W(a(theta p) - 1) + W(a(-theta p) - 1) - 2 W(e)) - R(theta) + S(theta),
    R = 2/3 (1 - nu'^2) Y' theta^4 / (1 + c theta^2).

theta = kappa z is the bending of the outer of three fibres, z = (3/20)^(1/2) t. A pair is p times
as far out and has v times its weight; with three fibres p = v = 1. R is the energy of the radial
stress Y' kappa^2 (t^2/4 - z^2) / 2 that keeps fibres on their bent line, (1 - nu'^2) Y' t^5 kappa^4
/ 240 per length and depth. With a curve, Y' theta / (1 + c theta^2)^(1/2) approximates the stress
of fibres in R: c follows from the curve (`sweep.scene.material`).

S stops bending where the faces of a wall meet. A wall bent onto itself turns by 2 / t per length
(`contact_near_joints`), which is theta = `TOUCHING`. Beyond it,

    S = Y' (|theta| - TOUCHING)^3 / (3 TOUCHING)

whose tangent reaches the tangent 2 Y' of linear bending at twice this curvature. The moment of
fibres alone has a maximum near there, as in a bent block whose material softens; without a stop a
wall would fold in one element, however short. R and S stay elastic where fibres relax.
"""

import math
from typing import NamedTuple

import numpy as np

from kernels.compile.jit import jit, jit_exact
from kernels.compile.simd import LANES, lane, load, spread
from kernels.laws.power import power

LEAST = 0.05  # stretch of the centre line below which bending takes infinite energy: second
# derivatives grow without bound at 0, and the barrier below `elastic.GUARD` keeps walls longer
TOUCHING = 2.0 * math.sqrt(3.0 / 20.0)  # theta of kappa t = 2
CRUSHED = 0.3  # stretch of a fibre below which a is continued


@jit
def powers(law, centre_q, theta, first):
    """Return q and q^(1 / m) of four fibres, those from number ``first`` on."""
    q = spread(centre_q) + spread(law.m * theta) * load(law.place, first)
    return q, power(q, 1.0 / law.m)


@jit
def fibre(law, q, root):
    """Return the stretch a of a fibre and its two derivatives in q; root: q^(1 / m)."""
    if q < law.crushed:
        beyond, slope = q - law.crushed, CRUSHED / (law.m * law.crushed)
        second = slope * (1.0 / law.m - 1.0) / law.crushed
        return CRUSHED + beyond * (slope + 0.5 * beyond * second), slope + beyond * second, second
    by = 1.0 / q
    slope = root * by / law.m
    return root, slope, slope * (1.0 / law.m - 1.0) * by


@jit
def radial(bound, theta):
    """Return theta^4 / (1 + c theta^2) and its two derivatives; bound: c."""
    q = theta * theta
    by = 1.0 / (1.0 + bound * q)
    in_q = q * (2.0 + bound * q) * by * by
    return q * q * by, 2.0 * theta * in_q, 2.0 * in_q + 8.0 * q * by * by * by


@jit
def stop(theta):
    """Return S / Y' and its two derivatives."""
    beyond = abs(theta) - TOUCHING
    if beyond <= 0.0:
        return 0.0, 0.0, 0.0
    slope = beyond * beyond / TOUCHING
    return beyond * slope / 3.0, math.copysign(slope, theta), 2.0 * beyond / TOUCHING


@jit
def turned(law, theta):
    """Return the `bent` sums of a section without fibres: S - R and its derivatives, J/m^3."""
    value, slope, second = radial(law.bound, theta)
    touching, push, stiff = stop(theta)
    return (
        law.stop * touching - law.radial * value,
        law.stop * push - law.radial * slope,
        0.0,
        law.stop * stiff - law.radial * second,
        0.0,
        0.0,
    )


@jit
def middle(m, stretched):
    """Return q of the middle fibre, lambda^m, and its two derivatives in e."""
    q, by = stretched**m, 1.0 / stretched
    slope = m * q * by
    return q, slope, (m - 1.0) * slope * by


@jit
def bent(law, sums, first, powered, memory, point):
    """Add four fibres, those from number ``first`` on, to ``sums``: w without its terms W(e), its
    slopes in theta and q, and its second derivatives in theta theta, q theta and q q.

    powered: from `powers`. point: material point of the first of them.
    """
    w, by_theta, by_q, tt, qt, qq = sums
    for k in range(min(LANES, law.weight.size - first)):
        out, weight = law.m * law.place[first + k], law.weight[first + k]
        a, a_q, a_qq = fibre(law, lane(powered[0], k), lane(powered[1], k))
        value, slope, second = law.curve.respond(a - 1.0, memory, point + k)
        second = weight * (second * a_q * a_q + slope * a_qq)
        slope *= weight * a_q
        w += weight * value
        by_q += slope
        by_theta += out * slope
        qq += second
        qt += out * second
        tt += out * out * second
    return w, by_theta, by_q, tt, qt, qq


@jit
def respond(law, strain, memory, point):
    """Return the sum of w over both sections of an element (J/m^3), its slopes in e, theta_1,
    theta_2 and the upper triangle of its second derivatives, row by row (Pa).

    point: first fibre of the first section; the fibres of the second follow, then the middle.
    """
    e, one, two = strain
    fibres = law.weight.size
    value, slope, second = law.curve.respond(e, memory, point + 2 * fibres)
    centre_q, q_e, q_ee = middle(law.m, 1.0 + e)
    sums1, sums2 = turned(law, one), turned(law, two)
    for k in range(0, fibres, LANES):
        powers1, powers2 = powers(law, centre_q, one, k), powers(law, centre_q, two, k)
        sums1 = bent(law, sums1, k, powers1, memory, point + k)
        sums2 = bent(law, sums2, k, powers2, memory, point + fibres + k)
    w1, t1, q1, tt1, qt1, qq1 = sums1
    w2, t2, q2, tt2, qt2, qq2 = sums2
    by_q, qq = q1 + q2, qq1 + qq2
    return (
        w1 + w2 - law.middle * value,
        (q_e * by_q - law.middle * slope, t1, t2),
        (q_e * q_e * qq + q_ee * by_q - law.middle * second, q_e * qt1, q_e * qt2, tt1, 0.0, tt2),
    )


@jit
def elastic(law):
    """Return the section with the elastic law of fibres alone, which is compiled without memory."""
    return BentSection(
        law.curve.elastic(), law.place, law.weight, law.middle, law.m, law.crushed,
        law.radial, law.bound, law.stop,
    )  # fmt: skip


@jit
def points(law):
    """Return the number of material points of an element."""
    return 2 * law.weight.size + 1


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
    e, last = strain[0], point + 2 * law.weight.size
    released, dissipated = law.curve.commit(e, memory, last)
    released, dissipated = -law.middle * released, -law.middle * dissipated
    centre_q = (1.0 + e) ** law.m
    for section in range(2):
        theta = strain[2] if section == 1 else strain[1]
        for first in range(0, law.weight.size, LANES):
            q, root = powers(law, centre_q, theta, first)
            for k in range(min(LANES, law.weight.size - first)):
                a, weight = fibre(law, lane(q, k), lane(root, k))[0], law.weight[first + k]
                release, dissipation = law.curve.commit(a - 1.0, memory, point)
                released += weight * release
                dissipated += weight * dissipation
                point += 1
    return released, dissipated


class BentSection(NamedTuple):
    """curve: law of a fibre. place: +-p of the fibres of a section except the middle one, and zeros
    up to a multiple of `LANES`; weight (f,): their v. middle: sum of v over both sections. m:
    1 + nu'. crushed: q of a fibre whose stretch is `CRUSHED`. radial: 2/3 (1 - nu'^2) Y', Pa.
    bound: c. stop: Y', Pa; 0: without S.
    """

    curve: object
    place: np.ndarray
    weight: np.ndarray
    middle: float
    m: float
    crushed: float
    radial: float
    bound: float
    stop: float

    elastic = elastic
    points = points
    begin = begin
    respond = respond
    commit = commit
