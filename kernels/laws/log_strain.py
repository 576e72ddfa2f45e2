"""Logarithmic strain L = ln(c) / 2 of a sheet, and the derivatives of its product with a stress.

With the mean p and the deviator (u, v) = ((c11 - c22) / 2, c12) of c, y = (u^2 + v^2) / p^2 and
det c = p^2 (1 - y),

    L = ln(det c) / 4 + theta / 2 (u, v),   theta = g(y) / p,   g(y) = artanh(y^(1/2)) / y^(1/2)

where a pair stands for the matrix (u, v; v, -u). g is smooth where both stretches are equal: it is
1 + y / 3 + y^2 / 5 + .., and 2 y g' = 1 / (1 - y) - g. From that

    dtheta/dp = -1 / det c,   dtheta/d(u^2 + v^2) = g' / p^3

A product s : L counts s12 twice. Derivatives are in (c11, c22, c12), c12 counted once. Strains are
given as c - 1, so that small ones lose no digits.
"""

import math

from kernels.compile.jit import jit

SMALL = 0.01  # y below which g' and g'' are sums of `TERMS` powers
TERMS = 12


@jit
def _slopes(y):
    """Return g, g' and g''."""
    if y < SMALL:
        value, first, second = 0.0, 0.0, 0.0
        for n in range(TERMS, -1, -1):
            second = second * y + 2.0 * first
            first = first * y + value
            value = value * y + 1.0 / (2.0 * n + 1.0)
        return value, first, second
    root, by = math.sqrt(y), 1.0 / (1.0 - y)
    value = math.atanh(root) / root
    first = (by - value) / (2.0 * y)
    return value, first, (by * by - 3.0 * first) / (2.0 * y)


@jit
def strain(a, b, v):
    """Return L11, L22 and L12 at a = c11 - 1, b = c22 - 1, v = c12, where c is positive."""
    u, p = 0.5 * (a - b), 1.0 + 0.5 * (a + b)
    mean = 0.25 * math.log1p(a + b + a * b - v * v)
    half = 0.5 * _slopes((u * u + v * v) / (p * p))[0] / p
    return mean + half * u, mean - half * u, half * v


@jit
def respond(s, a, b, v):
    """Return s : L, its slopes in c11, c22, c12, and 11, 12, 13, 22, 23, 33 of the second
    derivatives, where c is positive; s: s11, s22, s12.
    """
    u, p, k = 0.5 * (a - b), 1.0 + 0.5 * (a + b), a + b + a * b - v * v
    by = 1.0 / (1.0 + k)
    value, first, second = _slopes((u * u + v * v) / (p * p))
    theta, rise, bend = value / p, first / p**3, second / p**5  # by u^2 + v^2
    half, in_u, in_v = 0.5 * (s[0] + s[1]), 0.5 * (s[0] - s[1]), s[2]
    d = in_u * u + in_v * v
    wp, wu, wv = p * by, -u * by, -v * by  # half the slopes of ln(det c)
    dp = half * wp - by * d
    du = half * wu + 2.0 * u * rise * d + theta * in_u
    dv = half * wv + 2.0 * v * rise * d + theta * in_v
    pp = half * (by - 2.0 * wp * wp) + 2.0 * p * by * by * d
    pu = -2.0 * half * wp * wu - by * (2.0 * u * by * d + in_u)
    pv = -2.0 * half * wp * wv - by * (2.0 * v * by * d + in_v)
    uu = 2.0 * rise * d - half * (by + 2.0 * wu * wu) + 4.0 * u * (u * bend * d + rise * in_u)
    vv = 2.0 * rise * d - half * (by + 2.0 * wv * wv) + 4.0 * v * (v * bend * d + rise * in_v)
    uv = 4.0 * u * v * bend * d - 2.0 * half * wu * wv + 2.0 * rise * (u * in_v + v * in_u)
    return (
        0.5 * half * math.log1p(k) + theta * d,
        (0.5 * (dp + du), 0.5 * (dp - du), dv),
        (
            0.25 * (pp + 2.0 * pu + uu),
            0.25 * (pp - uu),
            0.5 * (pv + uv),
            0.25 * (pp - 2.0 * pu + uu),
            0.5 * (pv - uv),
            vv,
        ),
    )
