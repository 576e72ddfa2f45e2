"""The law of a bent section: energy over the strain e of the centre line and the bending of fibres.

A wall of curvature kappa (per rest length) becomes thinner where its fibres are stretched and
thicker where they are compressed. A fibre at z from the centre line at rest is at y with
dy/dz = a^(-nu'), and its stretch is a = lambda + kappa y, lambda = 1 + e. Hence, with m = 1 + nu',

    a = (lambda^m + m kappa z)^(1/m)
      = lambda (1 + u + (1 - m)/2 u^2 + (1 - m)(1 - 2 m)/6 u^3 + ..),   u = kappa z lambda^(-m).

Three Gauss points through the thickness are at z and weigh 5, 8 and 5 of 18; the one in the middle
belongs to stretching. The potential is that of the outer two, over their part of the volume,

    w(e, theta) = W(a(theta) - 1) + W(a(-theta) - 1) - 2 W(e) - r(theta),   theta = kappa z,
    r = 2/3 (1 - nu'^2) Y' theta^4 / (1 + 5/3 theta^2).

r is the energy of the radial stress Y' kappa^2 (t^2/4 - z^2) / 2 that keeps fibres on their bent
line, (1 - nu'^2) Y' t^5 kappa^4 / 240 per length and depth, here bounded for large bending.
"""

from typing import NamedTuple

from kernels.compile.jit import jit
from kernels.terms.elastic import commit, state_size

LEAST = 0.05  # stretch of the centre line below which the energy is infinite


@jit
def fibre(m, stretched, r, theta):
    """Return the stretch a and its derivatives in e, theta; ee, e theta, theta theta.

    m: of the module's formula. stretched: lambda. r: lambda^(-m).
    """
    u = theta * r
    c2, c3 = 0.5 * (1.0 - m), (1.0 - m) * (1.0 - 2.0 * m) / 6.0
    f = 1.0 + u * (1.0 + u * (c2 + u * c3))
    slope = 1.0 + u * (2.0 * c2 + u * 3.0 * c3)
    second = 2.0 * c2 + 6.0 * c3 * u
    mixed = (1.0 - m) * slope - m * u * second
    return (
        stretched * f, f - m * u * slope, stretched * r * slope,
        -m * u / stretched * mixed, r * mixed, stretched * r * r * second,
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
    """Return w + 2 W(e) of one point, its slopes in e and theta, and ee, e theta, theta theta."""
    value, slope, second = radial(theta)
    energy, by_e, by_theta = -law.radial * value, 0.0, -law.radial * slope
    ee, et, tt = 0.0, 0.0, -law.radial * second
    for side in (1.0, -1.0):
        a, a_e, a_t, a_ee, a_et, a_tt = fibre(law.m, stretched, r, side * theta)
        value, slope, second = law.curve.respond(a - 1.0, memory, point)
        energy += value
        by_e += slope * a_e
        by_theta += side * slope * a_t
        ee += second * a_e * a_e + slope * a_ee
        et += side * (second * a_e * a_t + slope * a_et)
        tt += second * a_t * a_t + slope * a_tt
    return energy, by_e, by_theta, ee, et, tt


@jit
def respond(law, strain, memory, point):
    """Return the sum of w over both points of an element (J/m^3), its slopes in e, theta_1, theta_2
    and the upper triangle of its second derivatives, row by row (Pa).
    """
    e, one, two = strain
    value, slope, second = law.curve.respond(e, memory, point)
    stretched, r = 1.0 + e, (1.0 + e) ** (-law.m)
    w1, e1, t1, ee1, et1, tt1 = bent(law, stretched, r, one, memory, point)
    w2, e2, t2, ee2, et2, tt2 = bent(law, stretched, r, two, memory, point)
    return (
        w1 + w2 - 4.0 * value,
        (e1 + e2 - 4.0 * slope, t1, t2),
        (ee1 + ee2 - 4.0 * second, et1, et2, tt1, 0.0, tt2),
    )


class BentSection(NamedTuple):
    """curve: elastic law of the fibres. m: 1 + nu'. radial: 2/3 (1 - nu'^2) Y', Pa. modulus: of the
    curve, Pa.
    """

    curve: object
    m: float
    radial: float
    modulus: float

    respond = respond
    state_size = state_size
    commit = commit
