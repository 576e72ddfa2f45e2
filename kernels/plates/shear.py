"""Transverse shear with the assumed field of MITC4 (K.-J. Bathe and E. Dvorkin, 1985).

At the middle of each edge g = x,a . d - rest, along the edge: x,a is the difference of its nodes
over its length, d the mean of their directors. Between two opposite edges g is linear, so that

    E = t h_s h_z / 6 * sum of k (g0^2 + g0 g1 + g1^2) over both directions

exactly. The stiffness k is kappa G, kappa = 5/6, and softer where an element is long:

    1 / k_s = 1 / (kappa G) + beta t h_s^2 / D,   D = G t^3 / 3

Without shear, the deflection of a bilinear element follows the trapezoidal rule of its directors,
which is too stiff. With beta = 1/12 (residual bending flexibility, R. MacNeal, 1978) a strip bent
along a cylinder is exact, but a plate bent both ways is too soft. `BETA` makes the errors of
buckled and of pressed square plates, with hinged and with clamped edges, small together.
Coordinates q (24,) of an element: of corner a, q[6 a] .. q[6 a + 2] its
position, q[6 a + 3] .. q[6 a + 5] its director.
"""

from kernels.compile.jit import jit

KAPPA = 5.0 / 6.0
BETA = 1.0 / 40.0
EDGES = ((0, 1), (3, 2), (0, 3), (1, 2))  # two along s, two along z, in the direction of these


@jit
def stiffnesses(modulus, thickness, size):
    """Return t h_s h_z k of both directions in N; modulus: kappa G in Pa."""
    whole, by_t = modulus * thickness * size[0] * size[1], 1.0 / (thickness * thickness)
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
def _strains(q, size, rest):
    """Return g of the four edges."""
    return (
        strain(q, EDGES[0], size[0]) - rest[0],
        strain(q, EDGES[1], size[0]) - rest[1],
        strain(q, EDGES[2], size[1]) - rest[2],
        strain(q, EDGES[3], size[1]) - rest[3],
    )


@jit
def _stresses(g, stiffness):
    """Return dE/dg of the four edges."""
    k, m = stiffness[0] / 6.0, stiffness[1] / 6.0
    return (
        k * (2.0 * g[0] + g[1]), k * (2.0 * g[1] + g[0]),
        m * (2.0 * g[2] + g[3]), m * (2.0 * g[3] + g[2]),
    )  # fmt: skip


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
def evaluate(q, size, rest, stiffness, slope):
    """Return E in J; add its gradient to ``slope`` (24,). stiffness: see `stiffnesses`."""
    g = _strains(q, size, rest)
    s = _stresses(g, stiffness)
    _add_slope(q, EDGES[0], s[0] / size[0], slope)
    _add_slope(q, EDGES[1], s[1] / size[0], slope)
    _add_slope(q, EDGES[2], s[2] / size[1], slope)
    _add_slope(q, EDGES[3], s[3] / size[1], slope)
    return 0.5 * (s[0] * g[0] + s[1] * g[1] + s[2] * g[2] + s[3] * g[3])


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
def _add_pair(first, other, rows, stiffness, second):
    """Add the products of the slopes ``rows`` (4, 24) of two edges by (2 1; 1 2) stiffness / 6."""
    k = stiffness / 6.0
    for i in range(24):
        a = k * (2.0 * rows[first, i] + rows[other, i])
        b = k * (rows[first, i] + 2.0 * rows[other, i])
        for c in range(24):
            second[i, c] += a * rows[first, c] + b * rows[other, c]


@jit
def hessian(q, size, rest, stiffness, rows, second):
    """Add the Hessian to ``second`` (24, 24); return the four dE/dg. rows (4, 24): scratch."""
    s = _stresses(_strains(q, size, rest), stiffness)
    rows[:] = 0.0
    for e in range(4):
        length = size[e // 2]
        _add_slope(q, EDGES[e], 1.0 / length, rows[e])
        _add_curvature(EDGES[e], s[e] / length, second)
    _add_pair(0, 1, rows, stiffness[0], second)
    _add_pair(2, 3, rows, stiffness[1], second)
    return s
