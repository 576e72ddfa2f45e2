"""Closest points of a point and a triangle, of a point and an edge, and of two edges.

Points are tuples of three numbers. Regions of a triangle as in C. Ericson, Real-Time Collision
Detection, 2005, sections 5.1.5 and 5.1.9.
"""

from kernels.compile.jit import jit_exact
from kernels.geometry.space.vectors import inner, minus, plus

FACE = 6  # feature of a triangle a, b, c: 0 .. 2: corners, 3 .. 5: sides ab, bc, ca, 6: inside
NEARLY_PARALLEL = 1e-8  # squared sine between two edges below which their ends are tried too
PARALLEL = 1e-18  # squared sine below which only the ends are tried


@jit_exact
def on_triangle(p, a, b, c):
    """Return (feature, v, w): the closest point a + v (b - a) + w (c - a) and the feature that it
    lies on.
    """
    ab, ac, ap = minus(b, a), minus(c, a), minus(p, a)
    d1, d2 = inner(ab, ap), inner(ac, ap)
    if d1 <= 0.0 and d2 <= 0.0:
        return 0, 0.0, 0.0
    bp = minus(p, b)
    d3, d4 = inner(ab, bp), inner(ac, bp)
    if d3 >= 0.0 and d4 <= d3:
        return 1, 1.0, 0.0
    of_c = d1 * d4 - d3 * d2
    if of_c <= 0.0 and d1 >= 0.0 and d3 <= 0.0:
        return 3, d1 / (d1 - d3), 0.0
    cp = minus(p, c)
    d5, d6 = inner(ab, cp), inner(ac, cp)
    if d6 >= 0.0 and d5 <= d6:
        return 2, 0.0, 1.0
    of_b = d5 * d2 - d1 * d6
    if of_b <= 0.0 and d2 >= 0.0 and d6 <= 0.0:
        return 5, 0.0, d2 / (d2 - d6)
    of_a = d3 * d6 - d5 * d4
    if of_a <= 0.0 and d4 >= d3 and d5 >= d6:
        w = (d4 - d3) / ((d4 - d3) + (d5 - d6))
        return 4, 1.0 - w, w
    total = of_a + of_b + of_c
    return FACE, of_b / total, of_c / total


@jit_exact
def on_edge(p, a, b):
    """Return s in [0, 1], the closest point a + s (b - a) of an edge."""
    ab = minus(b, a)
    along, l2 = inner(ab, minus(p, a)), inner(ab, ab)
    if along <= 0.0:
        return 0.0
    return 1.0 if along >= l2 else along / l2


@jit_exact
def _clamped(value):
    """Return the number in [0, 1] that is closest to ``value``."""
    return min(max(value, 0.0), 1.0)


@jit_exact
def _squared_between(a, b, c, d, s, t):
    """Return the squared distance of the points s and t of two edges, m^2."""
    gap = minus(plus(a, s, minus(b, a)), plus(c, t, minus(d, c)))
    return inner(gap, gap)


@jit_exact
def _at_ends(a, b, c, d, s, t):
    """Return the closest of the points ``s``, ``t`` and the ends of two edges."""
    best = _squared_between(a, b, c, d, s, t)
    for i in range(4):
        if i < 2:
            one, two = float(i), on_edge(b if i == 1 else a, c, d)
        else:
            one, two = on_edge(d if i == 3 else c, a, b), float(i - 2)
        d2 = _squared_between(a, b, c, d, one, two)
        if d2 < best:
            best, s, t = d2, one, two
    return s, t


@jit_exact
def on_edges(a, b, c, d):
    """Return (s, t) in [0, 1]: the closest points a + s (b - a) and c + t (d - c) of two edges.

    Of nearly parallel edges the closest points are uncertain, their distance is not.
    """
    u, v, w = minus(b, a), minus(d, c), minus(a, c)
    uu, vv, uv = inner(u, u), inner(v, v), inner(u, v)
    uw, vw = inner(u, w), inner(v, w)
    turn = uu * vv - uv * uv
    s, t = _of_lines(uu, vv, uv, uw, vw, turn)
    if turn < NEARLY_PARALLEL * uu * vv:
        return _at_ends(a, b, c, d, s, t)
    return s, t


@jit_exact
def _of_lines(uu, vv, uv, uw, vw, turn):
    """Return (s, t) of `on_edges` from the products of the edges u, v and w = a - c.

    turn: squared size of u x v, m^4.
    """
    s = _clamped((uv * vw - uw * vv) / turn) if turn > PARALLEL * uu * vv else 0.0
    t = (uv * s + vw) / vv
    if t < 0.0:
        return _clamped(-uw / uu), 0.0
    if t > 1.0:
        return _clamped((uv - uw) / uu), 1.0
    return s, t


@jit_exact
def squared_to_triangle(p, a, b, c):
    """Return the squared distance of a point from a triangle, m^2."""
    _, v, w = on_triangle(p, a, b, c)
    gap = minus(plus(plus(a, v, minus(b, a)), w, minus(c, a)), p)
    return inner(gap, gap)


@jit_exact
def squared_to_edge(p, a, b):
    """Return the squared distance of a point from an edge, m^2."""
    gap = minus(plus(a, on_edge(p, a, b), minus(b, a)), p)
    return inner(gap, gap)


@jit_exact
def squared_between_edges(a, b, c, d):
    """Return the squared distance of two edges, m^2."""
    s, t = on_edges(a, b, c, d)
    return _squared_between(a, b, c, d, s, t)
