"""Transverse shear with the assumed field of MITC4 (K.-J. Bathe and E. Dvorkin, 1985).

At the middle of each edge g = x,a . d - rest, along the edge: x,a is the difference of its nodes
over its length, d the mean of their directors. Between two opposite edges g is linear. With the
strain A of the mid-surface in the middle of the element, and the means of g_s^2, g_z^2 and g_s g_z,

    E = t h_s h_z / 2 * (A22 P + A11 Q - 2 A12 R) / det A^2
    P = k_s <g_s^2>,   Q = k_z <g_z^2>,   R = (k_s k_z)^(1/2) <g_s g_z>

which is kappa G t |g|^2 / 2 where the mid-surface is not strained. E depends on A as in an
incompressible neo-Hookean wall, whose fibres across are longer by (det A)^(-1/2): with C13 = g_s
(det A)^(-1/2) and so on, det C = 1 gives C33 = (1 + C_a3 adj(A)_ab C_b3) / det A.

The stiffness k is kappa G, kappa = 5/6, and softer where an element is long:

    1 / k_s = 1 / (kappa G) + beta t h_s^2 / D,   D = G t^3 / 3

Without shear, the deflection of a bilinear element follows the trapezoidal rule of its directors,
which is too stiff. With beta = 1/12 (residual bending flexibility, R. MacNeal, 1978) a strip bent
along a cylinder is exact, but a plate bent both ways is too soft. `BETA` makes the errors of
buckled and of pressed square plates, with hinged and with clamped edges, small together.

Coordinates q (24,) of an element: of corner a, q[6 a] .. q[6 a + 2] its position, q[6 a + 3] ..
q[6 a + 5] its director. Its shear is a function of seven numbers: g of the edges, A11, A22, A12.
"""

import math

from kernels.compile.jit import jit

KAPPA = 5.0 / 6.0
BETA = 1.0 / 40.0
EDGES = ((0, 1), (3, 2), (0, 3), (1, 2))  # two along s, two along z, in their directions
NUMBERS = 7


@jit
def stiffnesses(modulus, thickness, size, area):
    """Return t h_s h_z k of both directions in N; modulus: kappa G in Pa.

    area: h_s h_z of a rectangle, m^2; of any quad, the integral of det A at rest. With that, E does
    not depend on the coordinates: g . adj(A) g / det A^2 has the factor 1 / det A at rest.
    """
    whole, by_t = modulus * thickness * area, 1.0 / (thickness * thickness)
    share = 3.0 * KAPPA * BETA * by_t
    return whole / (1.0 + share * size[0] ** 2), whole / (1.0 + share * size[1] ** 2)


@jit
def strain(q, edge, length):
    """Return x,a . d in the middle of an edge; edge: its two corners."""
    i, k, total = 6 * edge[0], 6 * edge[1], 0.0
    for c in range(3):
        total += (q[k + c] - q[i + c]) * (q[i + 3 + c] + q[k + 3 + c])
    return 0.5 / length * total


@jit
def strains(q, size, rest):
    """Return g of the four edges."""
    return (
        strain(q, EDGES[0], size[0]) - rest[0],
        strain(q, EDGES[1], size[0]) - rest[1],
        strain(q, EDGES[2], size[1]) - rest[2],
        strain(q, EDGES[3], size[1]) - rest[3],
    )


@jit
def _sides(q, size, c):
    """Return component ``c`` of x,s and x,z in the middle of the element."""
    one, two = q[12 + c] - q[c], q[6 + c] - q[18 + c]
    return 0.5 * (one + two) / size[0], 0.5 * (one - two) / size[1]


@jit
def surface(q, size):
    """Return A11, A22, A12 in the middle of the element."""
    a11, a22, a12 = 0.0, 0.0, 0.0
    for c in range(3):
        s, z = _sides(q, size, c)
        a11 += s * s
        a22 += z * z
        a12 += s * z
    return a11, a22, a12


@jit
def _means(g, k):
    """Return (P, Q, R), and their slopes in g: of P in g0, g1; of Q in g2, g3; of R in g0 or g1,
    and in g2 or g3. The stiffnesses k include the factor t h_s h_z.
    """
    one, two, both = k[0] / 3.0, k[1] / 3.0, 0.25 * math.sqrt(k[0] * k[1])
    s, z = g[0] + g[1], g[2] + g[3]
    return (
        (one * (s * s - g[0] * g[1]), two * (z * z - g[2] * g[3]), both * s * z),
        (
            one * (s + g[0]),
            one * (s + g[1]),
            two * (z + g[2]),
            two * (z + g[3]),
            both * z,
            both * s,
        ),
    )


@jit
def _energy(g, a, k):
    """Return E and its slopes in the seven numbers; E is infinite without area."""
    det = a[0] * a[1] - a[2] * a[2]
    if not (det > 0.0 and a[0] > 0.0):
        return math.inf, (0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0)
    (p, q, r), (p0, p1, q2, q3, rs, rz) = _means(g, k)
    by, n = 1.0 / det, p * a[1] + q * a[0] - 2.0 * r * a[2]
    half = 0.5 * by * by
    fall = 2.0 * half * by * n  # -dE/ddet
    return (
        half * n,
        (
            half * (p0 * a[1] - 2.0 * rs * a[2]),
            half * (p1 * a[1] - 2.0 * rs * a[2]),
            half * (q2 * a[0] - 2.0 * rz * a[2]),
            half * (q3 * a[0] - 2.0 * rz * a[2]),
            half * q - fall * a[1],
            half * p - fall * a[0],
            2.0 * (fall * a[2] - half * r),
        ),
    )


@jit
def energy(g, a, k):
    """Return E at the shears ``g`` of the edges and the strain ``a`` of the mid-surface."""
    return _energy(g, a, k)[0]


@jit
def _second_energy(g, a, k, second):
    """Fill ``second`` (7, 7) with the second derivatives of E."""
    (p, q, r), (p0, p1, q2, q3, rs, rz) = _means(g, k)
    by, n = 1.0 / (a[0] * a[1] - a[2] * a[2]), p * a[1] + q * a[0] - 2.0 * r * a[2]
    half = 0.5 * by * by
    in_s, in_z = half * k[0] / 3.0 * a[1], half * k[1] / 3.0 * a[0]
    mixed = -0.5 * half * math.sqrt(k[0] * k[1]) * a[2]
    for i in range(2):
        for c in range(2):
            second[i, c] = 2.0 * in_s if i == c else in_s
            second[2 + i, 2 + c] = 2.0 * in_z if i == c else in_z
            second[i, 2 + c] = mixed
            second[2 + c, i] = mixed
    area = (a[1], a[0], -2.0 * a[2])  # slopes of det A
    own = (q, p, -2.0 * r)  # and of n
    slopes = ((0.0, p0, rs), (0.0, p1, rs), (q2, 0.0, rz), (q3, 0.0, rz))  # of Q, P, R in g
    for i in range(4):
        in_n = slopes[i][0] * a[0] + slopes[i][1] * a[1] - 2.0 * slopes[i][2] * a[2]
        for c in range(3):
            one = (-2.0 if c == 2 else 1.0) * slopes[i][c]
            second[i, 4 + c] = half * (one - 2.0 * by * area[c] * in_n)
            second[4 + c, i] = second[i, 4 + c]
    for i in range(3):
        for c in range(3):
            second[4 + i, 4 + c] = (
                half
                * by
                * (6.0 * n * by * area[i] * area[c] - 2.0 * (own[i] * area[c] + area[i] * own[c]))
            )
    fall = 2.0 * half * by * n
    second[4, 5] -= fall
    second[5, 4] -= fall
    second[6, 6] += 2.0 * fall


@jit
def _add_slope(q, edge, factor, g):
    """Add ``factor`` d(x,a . d)/dq x length to ``g`` (24,)."""
    i, k, half = 6 * edge[0], 6 * edge[1], 0.5 * factor
    for c in range(3):
        along, mean = half * (q[k + c] - q[i + c]), half * (q[i + 3 + c] + q[k + 3 + c])
        g[i + c] -= mean
        g[k + c] += mean
        g[i + 3 + c] += along
        g[k + 3 + c] += along


@jit
def _add_surface_slope(q, size, s11, s22, s12, g):
    """Add the slope in q of s11 A11 + s22 A22 + s12 A12 to ``g`` (24,)."""
    for c in range(3):
        s, z = _sides(q, size, c)
        in_s, in_z = (2.0 * s11 * s + s12 * z) / size[0], (2.0 * s22 * z + s12 * s) / size[1]
        one, two = 0.5 * (in_s + in_z), 0.5 * (in_s - in_z)
        g[c] -= one
        g[12 + c] += one
        g[6 + c] += two
        g[18 + c] -= two


@jit
def evaluate(q, size, rest, stiffness, slope):
    """Return E in J, infinite where the element has no area left; add its gradient to ``slope``
    (24,). stiffness: see `stiffnesses`.
    """
    value, s = _energy(strains(q, size, rest), surface(q, size), stiffness)
    if math.isinf(value):
        return math.inf
    _add_slope(q, EDGES[0], s[0] / size[0], slope)
    _add_slope(q, EDGES[1], s[1] / size[0], slope)
    _add_slope(q, EDGES[2], s[2] / size[1], slope)
    _add_slope(q, EDGES[3], s[3] / size[1], slope)
    _add_surface_slope(q, size, s[4], s[5], s[6], slope)
    return value


@jit
def _add_curvature(edge, factor, second):
    """Add ``factor`` d2(x,a . d)/dq2 x length."""
    i, k, half = 6 * edge[0], 6 * edge[1], 0.5 * factor
    for c in range(3):
        for one, sign in ((i, -half), (k, half)):
            for other in (i, k):
                second[one + c, other + 3 + c] += sign
                second[other + 3 + c, one + c] += sign


@jit
def _add_surface_curvature(size, s11, s22, s12, second):
    """Add the second derivatives in q of s11 A11 + s22 A22 + s12 A12."""
    along, up = (-0.5, 0.5, 0.5, -0.5), (-0.5, -0.5, 0.5, 0.5)
    for a in range(4):
        for b in range(4):
            total = 2.0 * s11 * along[a] * along[b] / (size[0] * size[0])
            total += 2.0 * s22 * up[a] * up[b] / (size[1] * size[1])
            total += s12 * (along[a] * up[b] + up[a] * along[b]) / (size[0] * size[1])
            for c in range(3):
                second[6 * a + c, 6 * b + c] += total


@jit
def hessian(q, size, rest, stiffness, rows, pushed, inner, second):
    """Add the Hessian to ``second`` (24, 24), where E is finite; rows, pushed (7, 24) and inner
    (7, 7) are scratch.
    """
    g, a = strains(q, size, rest), surface(q, size)
    _, s = _energy(g, a, stiffness)
    _second_energy(g, a, stiffness, inner)
    rows[:] = 0.0
    for e in range(4):
        length = size[e // 2]
        _add_slope(q, EDGES[e], 1.0 / length, rows[e])
        _add_curvature(EDGES[e], s[e] / length, second)
    _add_surface_slope(q, size, 1.0, 0.0, 0.0, rows[4])
    _add_surface_slope(q, size, 0.0, 1.0, 0.0, rows[5])
    _add_surface_slope(q, size, 0.0, 0.0, 1.0, rows[6])
    _add_surface_curvature(size, s[4], s[5], s[6], second)
    for i in range(NUMBERS):
        for c in range(24):
            total = 0.0
            for m in range(NUMBERS):
                total += inner[i, m] * rows[m, c]
            pushed[i, c] = total
    for i in range(24):
        for c in range(24):
            total = 0.0
            for m in range(NUMBERS):
                total += rows[m, i] * pushed[m, c]
            second[i, c] += total
