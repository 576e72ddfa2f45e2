"""A sheet of incompressible material in plane stress: energy over its strain c.

With the stretches l1, l2 of the sheet, whose squares are the eigenvalues m of c, and the stretch 1
/ (l1 l2) of its thickness,

    W(c) = w(l1) + w(l2) + w(1 / (l1 l2))

(K. Valanis and R. Landel, 1967). In logarithms of stretches, x = ln l, and with h = l w'(l), the
principal stress up to a pressure,

    W = H(x1) + H(x2) + H(-x1 - x2),   H' = h

`separable` finds h from a nominal stress curve; as a C1 cubic with its exact integral it is a curve
of `elastic`. It is continued by tangents: where a stretch goes to 0, W rises to infinity as ln^2.
The counterpart of a linear wall is neo-Hookean, W = mu / 2 (tr c + 1 / det c - 3), mu = Y / 3.

Derivatives are in (c11, c22, c12), c12 counted once. With f(m) = H(ln(m) / 2), mean p, deviator
(u, v) = ((c11 - c22) / 2, c12) and its size r, m = p +- r,

    F(p, r) = f(p + r) + f(p - r),   q = F_r / r = 2 (f'(m1) - f'(m2)) / (m1 - m2)

and the second derivatives in (u, v) are F_rr n n + q t t, n = (u, v) / r, t normal to n. Where r is
small, q is twice the mean of f'' at both m; n is arbitrary where r = 0, as F_rr = q there. Strains
are given as c - 1, so that small ones lose no digits.
"""

import math
from typing import NamedTuple

import numpy as np

from kernels.compile.jit import jit
from kernels.laws import separable

EQUAL = 1e-5  # r / p below which the slope of a chord is the mean of the slopes at its ends


@jit
def _slopes(curve, x, m):
    """Return f, f' and f'' at m = exp(2 x)."""
    value, stress, tangent = curve.respond(x)
    return value, 0.5 * stress / m, (0.5 * tangent - stress) / (2.0 * m * m)


@jit
def _neo_hookean(mu, a, b, v):
    """Return W, its slopes in c11, c22, c12, and the upper triangle of its second derivatives."""
    p, q = 1.0 + a, 1.0 + b
    k = a + b + a * b - v * v
    det = 1.0 + k
    if not (det > 0.0 and p > 0.0):
        return math.inf, (0.0, 0.0, 0.0), (0.0, 0.0, 0.0, 0.0, 0.0, 0.0)
    by = 1.0 / det
    half, cube = 0.5 * mu, mu * by * by * by
    square = half * by * by
    return (
        half * ((a + b) * k - a * b + v * v) * by,
        (square * (k * (2.0 + k) - b), square * (k * (2.0 + k) - a), mu * v * by * by),
        (
            cube * q * q,
            cube * p * q - square,
            -2.0 * cube * q * v,
            cube * p * p,
            -2.0 * cube * p * v,
            4.0 * cube * v * v + 2.0 * square,
        ),
    )


@jit
def _measured(curve, a, b, v):
    """Return energy, slopes and second derivatives of a sheet with a measured curve."""
    k = a + b + a * b - v * v
    det = 1.0 + k
    mean, u = 0.5 * (a + b), 0.5 * (a - b)
    r = math.sqrt(u * u + v * v)
    m1 = 1.0 + mean + r
    if not (det > 0.0 and m1 > 0.0):
        return math.inf, (0.0, 0.0, 0.0), (0.0, 0.0, 0.0, 0.0, 0.0, 0.0)
    m2 = det / m1
    x1 = 0.5 * math.log1p(mean + r)
    x3 = -0.5 * math.log1p(k)
    w1, d1, dd1 = _slopes(curve, x1, m1)
    w2, d2, dd2 = _slopes(curve, -x1 - x3, m2)
    w3, stress, tangent = curve.respond(x3)
    g, gg = -0.5 * stress / det, (0.25 * tangent + 0.5 * stress) / (det * det)
    pp, pr, q = dd1 + dd2, dd1 - dd2, dd1 + dd2
    if r > EQUAL * (1.0 + mean):
        q = (d1 - d2) / r
    nu, nv = (u / r, v / r) if r > 0.0 else (1.0, 0.0)
    uu, uv, vv = pp * nu * nu + q * nv * nv, (pp - q) * nu * nv, pp * nv * nv + q * nu * nu
    pu, pv = pr * nu, pr * nv
    half, j1, j2, j3 = 0.5 * (d1 + d2), 1.0 + b, 1.0 + a, -2.0 * v
    return (
        w1 + w2 + w3,
        (half + 0.5 * q * u + g * j1, half - 0.5 * q * u + g * j2, q * v + g * j3),
        (
            0.25 * (pp + 2.0 * pu + uu) + gg * j1 * j1,
            0.25 * (pp - uu) + gg * j1 * j2 + g,
            0.5 * (pv + uv) + gg * j1 * j3,
            0.25 * (pp - 2.0 * pu + uu) + gg * j2 * j2,
            0.5 * (pv - uv) + gg * j2 * j3,
            vv + gg * j3 * j3 - 2.0 * g,
        ),
    )


@jit
def respond(law, a, b, v):
    """Return W (J/m^3), its slopes in c11, c22, c12, and 11, 12, 13, 22, 23, 33 of the second
    derivatives (Pa), at a = c11 - 1, b = c22 - 1, v = c12. W is infinite where c is not positive.
    """
    if law.is_neo_hookean:
        return _neo_hookean(law.shear_modulus, a, b, v)
    return _measured(law.curve, a, b, v)


@jit
def of_stretch(law, x):
    """Return H, h and its slope at the logarithm ``x`` of one stretch, J/m^3 and Pa."""
    if law.is_neo_hookean:
        square = law.shear_modulus * math.exp(2.0 * x)
        return 0.5 * law.shear_modulus * math.expm1(2.0 * x), square, 2.0 * square
    return law.curve.respond(x)


class Sheet(NamedTuple):
    """curve: `separable.OctaveCurve` of h over x. shear_modulus: mu = Y / 3 at rest, Pa."""

    curve: object
    shear_modulus: float
    is_neo_hookean: bool

    respond = respond
    of_stretch = of_stretch


def neo_hookean(modulus):
    """Return the sheet of a linear material; modulus: Y in Pa."""
    flat = separable.OctaveCurve(np.array([-1.0, 1.0]), np.zeros((1, 4)), np.zeros(2), 0.0)
    return Sheet(flat, modulus / 3.0, True)


def measured(nominal, least, modulus):
    """Return the sheet of a nominal stress curve.

    nominal, least: see `separable.continued`. modulus: Y at rest, the slope of ``nominal`` at 0, in
    Pa.
    """
    x, value, slope = separable.rising(nominal, least)
    rows, energy = separable.cubics(x, value, slope)
    return Sheet(separable.OctaveCurve(x, rows, energy, modulus), modulus / 3.0, False)
