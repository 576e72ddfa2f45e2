"""Energy of a layered wall per area of its rest shape, over the strain measures of a point.

The measures are A11, A22, A12, B11, B22, B12, D11, D22, D12 less their values at rest. With the
mid-surface x and the director field d, A = x,a . x,b, B = (x,a . d,b + x,b . d,a) / 2 and D = d,a .
d,b. The layer at zeta is stretched by

    c(zeta) = 1 + A + 2 z B + z^2 D,   z = zeta j,   j = det(1 + A)^(-1/2)

as an incompressible wall thickens by the factor j where its mid-surface shrinks. With the energy
W(c) of a sheet and its stress S = dW/dc and tangent T = dS/dc, three Gauss points give

    U = sum of v W(c),   v: part of the thickness

and with N_k = sum v z^k S, M_k = sum v z^k T, e = 2 (B + z D) = dc/dz and U_j = sum v zeta S . e

    dU/dA = N_0 + U_j dj/dA             dU/dB = 2 N_1           dU/dD = N_2
    d2U/dB2 = 4 M_2                     d2U/dB dD = 2 M_3       d2U/dD2 = M_4
    d2U/dA dB = 2 M_1 + dj/dA U_jB      d2U/dA dD = M_2 + dj/dA U_jD
    d2U/dA2 = M_0 + U_jA dj/dA + dj/dA U_jA + U_jj dj/dA dj/dA + U_j d2j/dA2
    U_jA = sum v zeta T e               U_jB = sum v zeta (2 S + 2 z T e)
    U_jD = sum v zeta (2 z S + z^2 T e) U_jj = sum v zeta^2 (e . T e + 2 S . D)

If the wall is curved at rest, by B0 and D0, a layer is stretched relative to its own rest shape
a(zeta) = 1 + 2 zeta B0 + zeta^2 D0. With the axes P of a(zeta) (`axes`) and its area,

    c = 1 + P (A + 2 (z (B0 + B) - zeta B0) + z^2 (D0 + D) - zeta^2 D0),   v: times (det a)^(1/2)

and then B + B0 and D + D0 stand for B and D in e and U_jj, and S P and P' T P for S and T.
"""

import math
from typing import NamedTuple

import numpy as np

from kernels.compile.jit import jit, jit_exact, jit_owning
from kernels.plates.element import axes

OUTER = math.sqrt(0.15)  # place of the outer of three Gauss points, as a share of the thickness
SHARES = (5.0 / 18.0, 8.0 / 18.0, 5.0 / 18.0)
MEASURES = 9
LAYERS = 3
REST = 14  # data of a curved point at rest: B0, D0, then axes and area of both outer layers


class Moments(NamedTuple):
    """Sums over the layers: stress (3, 3) N_0 .. N_2, tangent (5, 6) M_0 .. M_4 by upper triangle.

    by_j (9,): U_jA, U_jB, U_jD.
    """

    stress: np.ndarray
    tangent: np.ndarray
    by_j: np.ndarray


@jit_owning
def make_moments():
    """Return zero moments."""
    return Moments(np.zeros((3, 3)), np.zeros((5, 6)), np.zeros(MEASURES))


@jit
def thickening(m):
    """Return j, infinite where the mid-surface has no area left."""
    det = 1.0 + (m[0] + m[1] + m[0] * m[1] - m[2] * m[2])
    if not (det > 0.0 and m[0] > -1.0):
        return math.inf
    return 1.0 / math.sqrt(det)


@jit
def _slopes_of_thickening(m, j):
    """Return dj/dA for A11, A22, A12."""
    cube = -0.5 * j * j * j
    return cube * (1.0 + m[1]), cube * (1.0 + m[0]), -2.0 * cube * m[2]


@jit_exact
def set_rest(b, d, thickness, rest):
    """Fill ``rest`` (REST,) for the curvatures B0 = ``b`` and D0 = ``d`` (3,) in the axes of m."""
    for i in range(3):
        rest[i], rest[3 + i] = b[i], d[i]
    for side in range(2):
        zeta = (2.0 * side - 1.0) * OUTER * thickness
        a = (
            1.0 + zeta * (2.0 * b[0] + zeta * d[0]),
            1.0 + zeta * (2.0 * b[1] + zeta * d[1]),
            zeta * (2.0 * b[2] + zeta * d[2]),
        )
        for k, value in enumerate(axes.orthonormal(a[0], a[1], a[2])):
            rest[6 + 4 * side + k] = value


@jit
def _absolute(m, rest):
    """Return B and D, including their values at rest."""
    if rest.size == 0:
        return (m[3], m[4], m[5]), (m[6], m[7], m[8])
    return (
        (m[3] + rest[0], m[4] + rest[1], m[5] + rest[2]),
        (m[6] + rest[3], m[7] + rest[4], m[8] + rest[5]),
    )


@jit
def _layer(m, rest, zeta, j):
    """Return c - 1 of a layer in the axes of m, and dc/dz."""
    z = zeta * j
    b, d = _absolute(m, rest)
    c = (
        m[0] + z * (2.0 * m[3] + z * m[6]),
        m[1] + z * (2.0 * m[4] + z * m[7]),
        m[2] + z * (2.0 * m[5] + z * m[8]),
    )
    if rest.size > 0:
        once, twice = 2.0 * (z - zeta), z * z - zeta * zeta
        c = (
            c[0] + once * rest[0] + twice * rest[3],
            c[1] + once * rest[1] + twice * rest[4],
            c[2] + once * rest[2] + twice * rest[5],
        )
    return c, (2.0 * (b[0] + z * d[0]), 2.0 * (b[1] + z * d[1]), 2.0 * (b[2] + z * d[2]))


@jit
def _axes(rest, layer):
    """Return a, b, c of a layer's axes, and its area at rest."""
    if rest.size == 0 or layer == 1:
        return 1.0, 0.0, 1.0, 1.0
    at = 6 + 2 * layer
    return rest[at], rest[at + 1], rest[at + 2], rest[at + 3]


@jit
def _respond(law, rest, c, memory, first, layer):
    """Return W, S and T of a layer, per area of the mid-surface and in the axes of m."""
    if rest.size == 0 or layer == 1:
        return law.respond(c[0], c[1], c[2], memory, first + layer)
    p0, p1, p2, area = _axes(rest, layer)
    own = axes.turned(p0, p1, p2, c[0], c[1], c[2])
    value, s, t = law.respond(own[0], own[1], own[2], memory, first + layer)
    s = axes.pulled(p0, p1, p2, s[0], s[1], s[2])
    r0 = axes.pulled(p0, p1, p2, t[0], t[1], t[2])
    r1 = axes.pulled(p0, p1, p2, t[1], t[3], t[4])
    r2 = axes.pulled(p0, p1, p2, t[2], t[4], t[5])
    c0 = axes.pulled(p0, p1, p2, r0[0], r1[0], r2[0])
    c1 = axes.pulled(p0, p1, p2, r0[1], r1[1], r2[1])
    c2 = axes.pulled(p0, p1, p2, r0[2], r1[2], r2[2])
    return (
        area * value,
        (area * s[0], area * s[1], area * s[2]),
        (area * c0[0], area * c0[1], area * c0[2], area * c1[1], area * c1[2], area * c2[2]),
    )


@jit
def _times(t, e):
    """Return T e for the upper triangle of T."""
    return (
        t[0] * e[0] + t[1] * e[1] + t[2] * e[2],
        t[1] * e[0] + t[3] * e[1] + t[4] * e[2],
        t[2] * e[0] + t[4] * e[1] + t[5] * e[2],
    )


@jit
def resultants(law, m, rest, thickness, memory, point, slope):
    """Return U and the part of U due to the strain of the mid-surface alone, J/m^2.

    m (9,): measures. rest: empty, or as `set_rest` fills it. memory, point: of the first layer, see
    `laws.law`. slope (9,) receives dU/dm. U is infinite where a layer has no area left.
    """
    j = thickening(m)
    if math.isinf(j):
        return math.inf, math.inf
    middle, s, _ = law.respond(m[0], m[1], m[2], memory, point + 1)
    middle *= thickness
    total = SHARES[1] * middle
    v = SHARES[1] * thickness
    for i in range(3):
        slope[i], slope[3 + i], slope[6 + i] = v * s[i], 0.0, 0.0
    by_j, v = 0.0, SHARES[0] * thickness
    for side in range(-1, 2, 2):
        zeta = side * OUTER * thickness
        z = zeta * j
        c, e = _layer(m, rest, zeta, j)
        value, s, _ = _respond(law, rest, c, memory, point, 1 + side)
        total += v * value
        by_j += v * zeta * (s[0] * e[0] + s[1] * e[1] + s[2] * e[2])
        for i in range(3):
            slope[i] += v * s[i]
            slope[3 + i] += 2.0 * v * z * s[i]
            slope[6 + i] += v * z * z * s[i]
    dj = _slopes_of_thickening(m, j)
    for i in range(3):
        slope[i] += by_j * dj[i]
    return total, middle


@jit
def _sum_layers(law, m, rest, thickness, memory, point, j, moments):
    """Fill the moments; return U_j and U_jj."""
    stress, tangent, mixed = moments.stress, moments.tangent, moments.by_j
    stress[:] = 0.0
    tangent[:] = 0.0
    mixed[:] = 0.0
    first, second = 0.0, 0.0
    _, d = _absolute(m, rest)
    for layer in range(3):
        v, zeta = SHARES[layer] * thickness, (layer - 1.0) * OUTER * thickness
        z = zeta * j
        c, e = _layer(m, rest, zeta, j)
        _, s, t = _respond(law, rest, c, memory, point, layer)
        f = _times(t, e)
        lever = v * zeta
        power = v
        for k in range(5):
            for i in range(6):
                tangent[k, i] += power * t[i]
            power *= z
        for i in range(3):
            stress[0, i] += v * s[i]
            stress[1, i] += v * z * s[i]
            stress[2, i] += v * z * z * s[i]
            mixed[i] += lever * f[i]
            mixed[3 + i] += 2.0 * lever * (s[i] + z * f[i])
            mixed[6 + i] += lever * z * (2.0 * s[i] + z * f[i])
            first += lever * s[i] * e[i]
            second += lever * zeta * (e[i] * f[i] + 2.0 * s[i] * d[i])
    return first, second


@jit
def _place(block, row, column, factor, t):
    """Set a 3 x 3 block to ``factor`` times the symmetric matrix with the upper triangle ``t``
    (6,).
    """
    block[row, column] = factor * t[0]
    block[row, column + 1] = factor * t[1]
    block[row, column + 2] = factor * t[2]
    block[row + 1, column] = factor * t[1]
    block[row + 1, column + 1] = factor * t[3]
    block[row + 1, column + 2] = factor * t[4]
    block[row + 2, column] = factor * t[2]
    block[row + 2, column + 1] = factor * t[4]
    block[row + 2, column + 2] = factor * t[5]


@jit
def rigidity(law, m, rest, thickness, memory, point, moments, slope, second):
    """Fill ``slope`` (9,) with dU/dm and ``second`` (9, 9), symmetric, with d2U/dm2.

    Call it only where U is finite.
    """
    j = thickening(m)
    u_j, u_jj = _sum_layers(law, m, rest, thickness, memory, point, j, moments)
    dj = _slopes_of_thickening(m, j)
    n, t, mixed = moments.stress, moments.tangent, moments.by_j
    for i in range(3):
        slope[i] = n[0, i] + u_j * dj[i]
        slope[3 + i], slope[6 + i] = 2.0 * n[1, i], n[2, i]
    _place(second, 0, 0, 1.0, t[0])
    _place(second, 0, 3, 2.0, t[1])
    _place(second, 0, 6, 1.0, t[2])
    _place(second, 3, 3, 4.0, t[2])
    _place(second, 3, 6, 2.0, t[3])
    _place(second, 6, 6, 1.0, t[4])
    for i in range(3):
        for k in range(3):
            second[i, k] += mixed[i] * dj[k] + dj[i] * mixed[k]
            second[i, k] += (u_jj + 3.0 * u_j / j) * dj[i] * dj[k]
            second[i, 3 + k] += dj[i] * mixed[3 + k]
            second[i, 6 + k] += dj[i] * mixed[6 + k]
    curl = 0.5 * u_j * j * j * j  # of det in A11 A22 and A12 A12, d2j = 3 dj dj / j - j^3 / 2 d2det
    second[0, 1] -= curl
    second[1, 0] -= curl
    second[2, 2] += 2.0 * curl
    for i in range(3, 9):
        for k in range(3 if i < 6 else 6):
            second[i, k] = second[k, i]


@jit_exact
def commit(law, m, rest, thickness, memory, point):
    """Accept the measures ``m`` in all layers.

    Return potential less stored energy, its part due to the mid-surface, and the dissipation of the
    step, J/m^2.
    """
    released, of_middle, dissipated, j = 0.0, 0.0, 0.0, thickening(m)
    for layer in range(LAYERS):
        c, _ = _layer(m, rest, (layer - 1.0) * OUTER * thickness, j)
        p0, p1, p2, area = _axes(rest, layer)
        c, v = axes.turned(p0, p1, p2, c[0], c[1], c[2]), SHARES[layer] * thickness * area
        potential = law.respond(c[0], c[1], c[2], memory, point + layer)[0]
        stored, dissipation = law.commit(c[0], c[1], c[2], memory, point + layer)
        released += v * (potential - stored)
        dissipated += v * dissipation
        if layer == 1:
            of_middle = thickness * (potential - stored)
    return released, of_middle, dissipated
