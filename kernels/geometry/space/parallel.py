"""Smooth factor that removes the contact of two edges as they become parallel.

The distance of two parallel edges has no second derivative. With c = |(b - a) x (d - c)|^2 and e =
SINE2 times the product of their squared lengths at rest,

    m = (2 - c / e) c / e   for c < e,   1 beyond     (Li et al. 2020, Incremental Potential
                                                       Contact, eq. 24)
"""

from kernels.compile.jit import jit
from kernels.geometry.space.vectors import cross, inner, minus, times

SINE2 = 1e-3  # squared sine below which the factor is less than one


@jit
def factor(points, scale):
    """Return m and its first two derivatives in c. scale: e, m^4."""
    normal = cross(minus(points[1], points[0]), minus(points[3], points[2]))
    share = inner(normal, normal) / scale
    if share >= 1.0:
        return 1.0, 0.0, 0.0
    return (2.0 - share) * share, (2.0 - 2.0 * share) / scale, -2.0 / (scale * scale)


@jit
def slopes(points):
    """Return dc/du and dc/dv of the edges u = b - a and v = d - c, m^3."""
    u, v = minus(points[1], points[0]), minus(points[3], points[2])
    normal = times(2.0, cross(u, v))  # products with this small vector: nothing cancels
    return cross(v, normal), cross(normal, u)


@jit
def _second(u, v, i, j, k, m):
    """Return d2c of component ``k`` of edge ``i`` and ``m`` of edge ``j``, 0: u, 1: v."""
    same = 1.0 if k == m else 0.0
    if i == j:
        other = v if i == 0 else u
        return 2.0 * (inner(other, other) * same - other[k] * other[m])
    one, two = (u, v) if i == 0 else (v, u)
    return 2.0 * (2.0 * one[k] * two[m] - two[k] * one[m] - inner(u, v) * same)


@jit
def add(points, force, curvature, q, n, mixed, K):
    """Add curvature (grad c)(grad c)^T + force d2 c + mixed [(grad c)(q n)^T + (q n)(grad c)^T] to
    ``K`` (12, 12). q, n: of the distance (`derivatives`).
    """
    u, v = minus(points[1], points[0]), minus(points[3], points[2])
    by_u, by_v = slopes(points)
    for i in range(4):
        one = by_u if i < 2 else by_v
        sign = -1.0 if i % 2 == 0 else 1.0
        for j in range(4):
            two = by_u if j < 2 else by_v
            other = -1.0 if j % 2 == 0 else 1.0
            for k in range(3):
                for m in range(3):
                    K[3 * i + k, 3 * j + m] += (
                        sign * other * curvature * one[k] * two[m]
                        + sign * other * force * _second(u, v, i // 2, j // 2, k, m)
                        + mixed * (sign * one[k] * q[j] * n[m] + other * q[i] * n[k] * two[m])
                    )
