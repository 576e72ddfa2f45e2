"""Additive conservative advancement: a share of a move during which two things stay apart.

Points move on straight lines, x + s dx. A distance changes by at most l per unit of s, where l is
the sum of the longest moves of the two things, less their common motion. From s = 0,

    s += (1 - KEPT) d(s) / l

until the distance is less than KEPT times the distance at the start (M. Li, D. M. Kaufman, C. Jiang
2021, Codimensional incremental potential contact, section 5, without an offset). The last s before
that is returned: up to it the distance is positive whatever the motion.
"""

import math

from kernels.compile.jit import jit_exact
from kernels.geometry.space.closest import squared_between_edges, squared_to_triangle
from kernels.geometry.space.vectors import inner, minus, plus

KEPT = 0.1  # share of the distance that is kept
MOST_ROUNDS = 1000  # the share reached after so many steps is admissible too


@jit_exact
def _longest(a, b):
    """Return the larger of two squared lengths."""
    return max(inner(a, a), inner(b, b))


@jit_exact
def _relative(da, db, dc, dd):
    """Return four moves less their mean."""
    mean = (
        0.25 * (da[0] + db[0] + dc[0] + dd[0]),
        0.25 * (da[1] + db[1] + dc[1] + dd[1]),
        0.25 * (da[2] + db[2] + dc[2] + dd[2]),
    )
    return minus(da, mean), minus(db, mean), minus(dc, mean), minus(dd, mean)


@jit_exact
def _squared(two_edges, points, moves, s):
    """Return the squared distance at ``s``: point-triangle, or of ``two_edges``."""
    a, b = plus(points[0], s, moves[0]), plus(points[1], s, moves[1])
    c, d = plus(points[2], s, moves[2]), plus(points[3], s, moves[3])
    return squared_between_edges(a, b, c, d) if two_edges else squared_to_triangle(a, b, c, d)


@jit_exact
def _advanced(two_edges, points, moves, speed, most):
    """Return an admissible share up to ``most``. speed: l of the module's docstring, m."""
    distance = math.sqrt(_squared(two_edges, points, moves, 0.0))
    if (1.0 - KEPT) * distance >= speed * most:
        return most
    least, s, share = KEPT * distance, 0.0, (1.0 - KEPT) * distance / speed
    for _ in range(MOST_ROUNDS):
        if s + share >= most:
            return most
        distance = math.sqrt(_squared(two_edges, points, moves, s + share))
        if distance < least:
            return s if s > 0.0 else share
        s += share
        share = (1.0 - KEPT) * distance / speed
    return s


@jit_exact
def point_triangle(points, moves, most):
    """Return a share of the ``moves``, at most ``most``, up to which a point and a triangle stay
    apart.

    points, moves: four vectors each, of the point and of the corners of the triangle.
    """
    p, a, b, c = _relative(moves[0], moves[1], moves[2], moves[3])
    speed = math.sqrt(inner(p, p)) + math.sqrt(max(_longest(a, b), inner(c, c)))
    return _advanced(False, points, (p, a, b, c), speed, most)


@jit_exact
def edge_edge(points, moves, most):
    """Return a share of the ``moves``, at most ``most``, up to which two edges stay apart.

    points, moves: four vectors each, two of each edge.
    """
    a, b, c, d = _relative(moves[0], moves[1], moves[2], moves[3])
    speed = math.sqrt(_longest(a, b)) + math.sqrt(_longest(c, d))
    return _advanced(True, points, (a, b, c, d), speed, most)
