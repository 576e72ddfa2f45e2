"""Nested dissection of a graph of blocks by their positions.

A part of the graph is cut in two where a plane leaves the fewest unknowns on the cut: the blocks on
one side of the plane that have neighbours on the other are eliminated after both halves, which are
cut in the same way (George 1973, SIAM J. Numer. Anal. 10: Nested dissection of a regular finite
element mesh). All planes across the three axes are compared.
"""

import numpy as np

from kernels.compile.jit import jit_exact, jit_owning

SMALLEST = 8  # blocks; only a larger part is cut
LIGHTEST = 0.25  # least share of a part on each side of a cut
UNEQUAL = 4.0  # cost of a cut into unequal halves: times 1 + this times the difference squared
CROWDED = 10.0  # a block with more neighbours than this times sqrt(blocks) is eliminated last


@jit_owning
def neighbours(n, pairs):
    """Return (start (n + 1,), near): the neighbours of block i are near[start[i]:start[i + 1]].

    pairs (k, 2): of blocks, in any order, repeats allowed.
    """
    degree, mark = np.zeros(n + 1, np.int64), np.full(n, -1)
    for k in range(pairs.shape[0]):
        if pairs[k, 0] != pairs[k, 1]:
            degree[pairs[k, 0] + 1] += 1
            degree[pairs[k, 1] + 1] += 1
    for i in range(n):
        degree[i + 1] += degree[i]
    free, listed = degree.copy(), np.empty(degree[n], np.int64)
    for k in range(pairs.shape[0]):
        i, j = pairs[k, 0], pairs[k, 1]
        if i != j:
            listed[free[i]], listed[free[j]] = j, i
            free[i] += 1
            free[j] += 1
    start, near, count = np.zeros(n + 1, np.int64), np.empty(degree[n], np.int64), 0
    for i in range(n):
        for q in range(degree[i], degree[i + 1]):
            if mark[listed[q]] != i:
                mark[listed[q]] = i
                near[count] = listed[q]
                count += 1
        start[i + 1] = count
    return start, near[:count].copy()


@jit_exact
def _merge(key, nodes, other, low, middle, high):
    """Write the sorted nodes[low:middle] and nodes[middle:high] to other[low:high], sorted."""
    a, b = low, middle
    for at in range(low, high):
        if b >= high or (a < middle and key[nodes[a]] <= key[nodes[b]]):
            other[at] = nodes[a]
            a += 1
        else:
            other[at] = nodes[b]
            b += 1


@jit_exact
def _sort(key, nodes, other):
    """Sort ``nodes`` by their ``key``, in place; equals keep their order. other: scratch."""
    width, n = 1, nodes.size
    while width < n:
        for low in range(0, n, 2 * width):
            _merge(key, nodes, other, low, min(low + width, n), min(low + 2 * width, n))
        for i in range(n):
            nodes[i] = other[i]
        width *= 2


@jit_exact
def _cut_weights(start, near, weight, rank, sorted_nodes, before, after):
    """Fill before[m], after[m]: unknowns on either side of the cut before ``sorted_nodes``[m] in
    blocks with neighbours on the other side.

    rank (n,): place of each block in ``sorted_nodes``, -1 if it is not in this part.
    """
    n = sorted_nodes.size
    for m in range(n + 1):
        before[m] = after[m] = 0.0
    for r in range(n):
        v, low, high = sorted_nodes[r], r, r
        for q in range(start[v], start[v + 1]):
            other = rank[near[q]]
            if other >= 0:
                low, high = min(low, other), max(high, other)
        before[r + 1] += weight[v]  # on the cut for all m with r < m <= high
        before[min(high + 1, n)] -= weight[v]
        after[low + 1] += weight[v]  # for all m with low < m <= r
        after[min(r + 1, n)] -= weight[v]
    for m in range(n):
        before[m + 1] += before[m]
        after[m + 1] += after[m]


@jit_exact
def _best_cut(weight, sorted_nodes, before, after):
    """Return (cost, m, side) of the cheapest cut; side 0: its blocks are before ``m``."""
    n, whole, left = sorted_nodes.size, 0.0, 0.0
    for v in sorted_nodes:
        whole += weight[v]
    cost, best, side = np.inf, n // 2, 0
    for m in range(1, n):
        left += weight[sorted_nodes[m - 1]]
        if LIGHTEST * whole <= left <= (1.0 - LIGHTEST) * whole:
            tilt = (2.0 * left - whole) / whole
            for one in range(2):
                cut = (1.0 + UNEQUAL * tilt * tilt) * (before[m] if one == 0 else after[m])
                if cut < cost:
                    cost, best, side = cut, m, one
    return cost, best, side


@jit_exact
def _number(part, rank):
    """Fill ``rank`` with the place of each block in ``part``."""
    for r in range(part.size):
        rank[part[r]] = r


@jit_exact
def _is_on_cut(start, near, rank, v, m):
    """Return whether block ``v`` has a neighbour on the other side of the cut before rank m."""
    for q in range(start[v], start[v + 1]):
        other = rank[near[q]]
        if other >= 0 and (other < m) != (rank[v] < m):
            return True
    return False


@jit_exact
def _divide(start, near, rank, part, other, m, side):
    """Write to ``part`` the blocks before the cut, the blocks after it, and the blocks on it.

    Return the sizes of the first two.
    """
    n, left, right = part.size, 0, 0
    last = n
    for r in range(n):
        v, is_before = part[r], r < m
        if is_before == (side == 0) and _is_on_cut(start, near, rank, v, m):
            last -= 1
            other[last] = v
        elif is_before:
            other[left] = v
            left += 1
        else:
            other[left + right] = v
            right += 1
    for r in range(n):
        part[r] = other[r]
    return left, right


@jit_owning
def _crowded_last(start):
    """Return (order (n,), count): all blocks, starting with the ``count`` blocks that are not
    crowded.
    """
    n = start.size - 1
    order, most, count, last = np.empty(n, np.int64), CROWDED * np.sqrt(n) + 1.0, 0, n
    for i in range(n):
        if start[i + 1] - start[i] <= most:
            order[count] = i
            count += 1
        else:
            last -= 1
            order[last] = i
    return order, count


@jit_owning
def dissect(start, near, weight, points):
    """Return the order (n,) of elimination.

    start, near: the graph as `neighbours` returns it. weight (n,): unknowns of each block. points
    (n, 3): positions in m.
    """
    n = start.size - 1
    order, count = _crowded_last(start)
    rank, key, other = np.full(n, -1), np.empty(n), np.empty(n, np.int64)
    before, after, best = np.empty(n + 2), np.empty(n + 2), np.empty(n, np.int64)
    parts, waiting = np.empty((n + 2, 2), np.int64), 1
    parts[0] = 0, count
    while waiting > 0:
        waiting -= 1
        low, high = parts[waiting]
        if high - low <= SMALLEST:
            continue
        part, cost, m, side = order[low:high], np.inf, 0, 0
        for axis in range(3):
            for v in part:
                key[v] = points[v, axis]
            _sort(key, part, other)
            _number(part, rank)
            _cut_weights(start, near, weight, rank, part, before, after)
            least, at, one = _best_cut(weight, part, before, after)
            if least < cost:
                cost, m, side = least, at, one
                for r in range(part.size):
                    best[r] = part[r]
        if cost < np.inf:
            for r in range(part.size):
                part[r] = best[r]
            _number(part, rank)
            left, right = _divide(start, near, rank, part, other, m, side)
            parts[waiting] = low, low + left
            parts[waiting + 1] = low + left, low + left + right
            waiting += 2
        for v in part:
            rank[v] = -1
    return order
