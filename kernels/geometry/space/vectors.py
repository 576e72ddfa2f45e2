"""Vectors in space as tuples of three numbers."""

import math

from kernels.compile.jit import jit_exact

SIZE = 6  # coordinates of a node; the first three are its position


@jit_exact
def point(x, i):
    """Return the three coordinates of node ``i`` in ``x`` (n,)."""
    return x[SIZE * i], x[SIZE * i + 1], x[SIZE * i + 2]


@jit_exact
def row(points, i):
    """Return row ``i`` of ``points`` (n, 3)."""
    return points[i, 0], points[i, 1], points[i, 2]


@jit_exact
def minus(a, b):
    """Return a - b."""
    return a[0] - b[0], a[1] - b[1], a[2] - b[2]


@jit_exact
def plus(a, factor, b):
    """Return a + factor b."""
    return a[0] + factor * b[0], a[1] + factor * b[1], a[2] + factor * b[2]


@jit_exact
def times(factor, a):
    """Return factor a."""
    return factor * a[0], factor * a[1], factor * a[2]


@jit_exact
def inner(a, b):
    """Return the inner product of two vectors."""
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


@jit_exact
def cross(a, b):
    """Return the cross product of two vectors."""
    return a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]


@jit_exact
def length(a):
    """Return the length of a vector."""
    return math.sqrt(inner(a, a))


@jit_exact
def combined(q, a, b, c, d):
    """Return the sum of four vectors with weights ``q`` that add up to zero.

    Only differences of the vectors are used, so that no digits are lost far from the origin.
    """
    u, v, w = minus(b, a), minus(c, a), minus(d, a)
    return (
        q[1] * u[0] + q[2] * v[0] + q[3] * w[0],
        q[1] * u[1] + q[2] * v[1] + q[3] * w[1],
        q[1] * u[2] + q[2] * v[2] + q[3] * w[2],
    )
