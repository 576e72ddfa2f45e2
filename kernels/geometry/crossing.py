"""Elements that cross each other in stored shapes, and pairs that round-off leaves undecided."""

from kernels.arrays import pair, zero
from kernels.compile.jit import jit_exact

APART, UNSURE, ACROSS = -1, 0, 1
SIGN_TOLERANCE = 1e-12  # share of the products in a cross product below which its sign is undecided


@jit_exact
def _side(at, a, p, s):
    """Return on which side of element ``a`` node ``p`` lies, as a sign; 0 if undecided."""
    i, j = a
    ux, uy = at[0, j, s] - at[0, i, s], at[1, j, s] - at[1, i, s]
    wx, wy = at[0, p, s] - at[0, i, s], at[1, p, s] - at[1, i, s]
    one, two = ux * wy, uy * wx
    if not abs(one - two) > SIGN_TOLERANCE * (abs(one) + abs(two)):  # NaN too
        return 0
    return 1 if one > two else -1


@jit_exact
def _relation(at, a, b, s):
    """Return whether two elements cross (ACROSS), do not (APART), or are undecided (UNSURE)."""
    one = _side(at, a, b[0], s) * _side(at, a, b[1], s)
    two = _side(at, b, a[0], s) * _side(at, b, a[1], s)
    if one > 0 or two > 0:
        return APART
    return ACROSS if one < 0 and two < 0 else UNSURE


@jit_exact
def _beyond(at, axis, a, b, s):
    """Return whether element ``b`` lies entirely beyond ``a`` along an axis."""
    end, begin = at[axis, a[0], s], at[axis, b[0], s]
    return max(end, at[axis, a[1], s]) < min(begin, at[axis, b[1], s])


@jit_exact
def _overlap(at, a, b, s):
    """Return whether the bounding boxes of two elements overlap."""
    for axis in range(2):
        if _beyond(at, axis, a, b, s) or _beyond(at, axis, b, a, s):
            return False
    return True


@jit_exact
def count(at, low, high, order, edges, crossed, unsure):
    """Count the crossing pairs of elements without a common node, by shape, in ``crossed`` (f,).

    Write undecided pairs and their shape to ``unsure`` (k, 3) as far as they fit; return their
    number. at (2, n, f): x and y of each node in each shape. low, high (m, 2): bounding box of each
    element over all shapes; order (m,): sorts the boxes by their left sides. edges (m, 2).
    """
    n = 0
    zero(crossed)
    for i in range(order.size):
        a = pair(edges, order[i])
        for j in range(i + 1, order.size):
            b = pair(edges, order[j])
            if low[order[j], 0] > high[order[i], 0]:
                break
            if low[order[j], 1] > high[order[i], 1] or low[order[i], 1] > high[order[j], 1]:
                continue
            if a[0] == b[0] or a[0] == b[1] or a[1] == b[0] or a[1] == b[1]:
                continue
            for s in range(crossed.size):
                if not _overlap(at, a, b, s):
                    continue
                relation = _relation(at, a, b, s)
                if relation == ACROSS:
                    crossed[s] += 1
                elif relation == UNSURE:
                    if n < unsure.shape[0]:
                        unsure[n, 0], unsure[n, 1], unsure[n, 2] = order[i], order[j], s
                    n += 1
    return n
