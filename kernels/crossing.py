"""Which elements pass through one another in stored shapes, as far as rounding lets one tell."""

from kernels.jit import jit_exact
from kernels.rows import zero

APART, UNSURE, ACROSS = -1, 0, 1
SURE = 1e-12  # of the products that make up a cross product: below, its sign is not trusted


@jit_exact
def _side(ends, a, b, end, s):
    """Return the sign of the side of element ``a`` that an end of ``b`` is on; 0 if not sure."""
    ux, uy = ends[0, a, 1, s] - ends[0, a, 0, s], ends[1, a, 1, s] - ends[1, a, 0, s]
    wx, wy = ends[0, b, end, s] - ends[0, a, 0, s], ends[1, b, end, s] - ends[1, a, 0, s]
    one, two = ux * wy, uy * wx
    if abs(one - two) <= SURE * (abs(one) + abs(two)):
        return 0
    return 1 if one > two else -1


@jit_exact
def _meeting(ends, a, b, s):
    """Return whether two elements lie across each other, or one of them on one side."""
    one = _side(ends, a, b, 0, s) * _side(ends, a, b, 1, s)
    two = _side(ends, b, a, 0, s) * _side(ends, b, a, 1, s)
    if one > 0 or two > 0:
        return APART
    return ACROSS if one < 0 and two < 0 else UNSURE


@jit_exact
def _overlap(low, high, a, b, s):
    return (
        low[0, a, s] <= high[0, b, s]
        and low[0, b, s] <= high[0, a, s]
        and low[1, a, s] <= high[1, b, s]
        and low[1, b, s] <= high[1, a, s]
    )


@jit_exact
def _share(edges, a, b):
    i, j = edges[a, 0], edges[a, 1]
    return i == edges[b, 0] or i == edges[b, 1] or j == edges[b, 0] or j == edges[b, 1]


@jit_exact
def count(ends, low, high, swept, order, edges, crossed, unsure):
    """Count pairs of elements without a common node that lie across each other, by shape, in
    ``crossed`` (f,); write those that need a closer look and the shape into ``unsure`` (k, 3).

    Return how many of them there are, which may be more than fit. ends (2, m, 2, f): x and y of
    both ends of each element in each shape. low, high (2, m, f): corners of its box there. swept
    (2, 2, m): those of the box of all its shapes, which ``order`` (m,) sorts by their left sides.
    edges (m, 2).
    """
    n = 0
    zero(crossed)
    for i in range(order.size):
        a = order[i]
        for j in range(i + 1, order.size):
            b = order[j]
            if swept[0, 0, b] > swept[1, 0, a]:
                break
            if swept[0, 1, b] > swept[1, 1, a] or swept[0, 1, a] > swept[1, 1, b]:
                continue
            if _share(edges, a, b):
                continue
            for s in range(crossed.size):
                if not _overlap(low, high, a, b, s):
                    continue
                meeting = _meeting(ends, a, b, s)
                if meeting == ACROSS:
                    crossed[s] += 1
                elif meeting == UNSURE:
                    if n < unsure.shape[0]:
                        unsure[n, 0], unsure[n, 1], unsure[n, 2] = a, b, s
                    n += 1
    return n
