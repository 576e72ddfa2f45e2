"""Derivatives of a distance with respect to the nodes of a point and a triangle, or of two edges.

The distance is d = |r|, r = sum_i q_i x_i over four nodes, where the shares q depend on the closest
points: (1, v + w - 1, -v, -w) of a node p and a triangle a, b, c; (1 - s, s, t - 1, -t) of two
edges. ``free`` says which parameters may change: 1 for the first one (v, s), plus 2 for the second
one. If the closest point of a triangle is on a side, the stencil is (p, a, b, b) with free = 1; if
it is a corner, (p, a, a, a) with free = 0.

With the unit vector n = r / d, an orthonormal basis u_k of the directions in which the closest
points move, and nodal weights rho_k with sum_i rho_ki x_i = u_k (at a move of r by u_k, q changes
by rho_k):

    grad d = q n
    d2 d = (q q^T) (I - n n^T - sum_k u_k u_k^T) / d
           - sum_k [(q u_k)(rho_k n)^T + (rho_k n)(q u_k)^T + d (rho_k n)(rho_k n)^T]

q n stands for the vector of blocks q_i n. In the plane this is `kernels.geometry.distance`.
"""

from kernels.compile.jit import jit
from kernels.geometry.space.vectors import combined, inner, length, times

# Derivatives of the shares q in the two parameters.
TRIANGLE = ((0.0, 1.0, -1.0, 0.0), (0.0, 1.0, 0.0, -1.0))
EDGES = ((-1.0, 1.0, 0.0, 0.0), (0.0, 0.0, 1.0, -1.0))
NOTHING = (0.0, 0.0, 0.0, 0.0)


@jit
def _scaled(factor, q):
    """Return factor q of four weights."""
    return factor * q[0], factor * q[1], factor * q[2], factor * q[3]


@jit
def _summed(one, q, two, other):
    """Return one q + two other of four weights."""
    return (
        one * q[0] + two * other[0],
        one * q[1] + two * other[1],
        one * q[2] + two * other[2],
        one * q[3] + two * other[3],
    )


@jit
def _along(rho, a, b, c, d):
    """Return the unit vector along sum rho_i x_i, and rho scaled so that this is the sum."""
    u = combined(rho, a, b, c, d)
    size = length(u)
    return times(1.0 / size, u), _scaled(1.0 / size, rho)


@jit
def tangents(points, slopes, free):
    """Return (u_1, rho_1, u_2, rho_2), zero for a parameter that is not ``free``.

    points: four nodes; slopes: `TRIANGLE` or `EDGES`.
    """
    a, b, c, d = points
    nowhere = (0.0, 0.0, 0.0)
    if free == 0:
        return nowhere, NOTHING, nowhere, NOTHING
    if free == 1:
        u, rho = _along(slopes[0], a, b, c, d)
        return u, rho, nowhere, NOTHING
    if free == 2:
        u, rho = _along(slopes[1], a, b, c, d)
        return u, rho, nowhere, NOTHING
    u, rho = _along(slopes[0], a, b, c, d)
    other = combined(slopes[1], a, b, c, d)
    v, sigma = _along(_summed(1.0, slopes[1], -inner(other, u), rho), a, b, c, d)
    return u, rho, v, sigma


@jit
def gap(q, points):
    """Return the unit vector n of sum q_i x_i, and its length d (m)."""
    r = combined(q, points[0], points[1], points[2], points[3])
    d = length(r)
    return times(1.0 / d, r), d


@jit
def _add(K, q, rho, a, b, factors):
    """Add c1 (q a)(q a)^T + c2 [(q a)(rho b)^T + (rho b)(q a)^T] + c3 (rho b)(rho b)^T to ``K``.

    factors: (c1, c2, c3). q a stands for the vector of blocks q_i a.
    """
    c1, c2, c3 = factors
    for i in range(4):
        pa, pb = c1 * q[i], c2 * q[i]
        ra, rb = c2 * rho[i], c3 * rho[i]
        for j in range(4):
            aa, ab = pa * q[j], pb * rho[j]
            ba, bb = ra * q[j], rb * rho[j]
            for k in range(3):
                left = aa * a[k] + ba * b[k]
                right = ab * a[k] + bb * b[k]
                for m in range(3):
                    K[3 * i + k, 3 * j + m] += left * a[m] + right * b[m]


@jit
def _add_across(K, q, u, v, n, factor):
    """Add factor (q q^T) (I - n n^T - u u^T - v v^T) to ``K``."""
    for k in range(3):
        for m in range(3):
            part = (1.0 if k == m else 0.0) - n[k] * n[m] - u[k] * u[m] - v[k] * v[m]
            for i in range(4):
                for j in range(4):
                    K[3 * i + k, 3 * j + m] += factor * part * q[i] * q[j]


@jit
def fill(points, slopes, q, free, stiffness, force, K):
    """Write stiffness (grad d)(grad d)^T + force d2 d to ``K`` (12, 12); return n.

    points: positions of the four nodes; slopes: `TRIANGLE` or `EDGES`; q, free: see the module.
    """
    n, d = gap(q, points)
    u, rho, v, sigma = tangents(points, slopes, free)
    for i in range(12):
        for j in range(12):
            K[i, j] = 0.0
    _add(K, q, NOTHING, n, n, (stiffness, 0.0, 0.0))
    _add_across(K, q, u, v, n, force / d)
    _add(K, q, rho, u, n, (0.0, -force, -force * d))
    _add(K, q, sigma, v, n, (0.0, -force, -force * d))
    return n
