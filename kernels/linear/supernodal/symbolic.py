"""Symbolic factorisation: the columns of the factor, grouped into supernodes.

A *supernode* is a set of blocks whose columns have the same rows below them, or nearly: its panel
is dense. Columns are found by the row subtrees of the elimination tree (Davis 2006, Direct Methods
for Sparse Linear Systems, ch. 4); a supernode is merged into its parent where that saves time,
although zeros are stored then (Ashcraft & Grimes 1989, ACM Trans. Math. Softw. 15).
"""

import numpy as np

from kernels.arrays import grouped
from kernels.compile.jit import jit_exact, jit_owning

# Nanoseconds, measured on one core of 2.6 GHz with AVX2; only their ratios matter.
OPERATION = 0.027
ENTRY = 2.5  # per entry of a panel: copied, and read in the solves
PASSED_ON = 2.0  # an entry of an update
SUPERNODE = 2000.0


@jit_exact
def _positions(order, position):
    """Fill ``position`` (n,) with the place of each block in ``order``."""
    for p in range(order.size):
        position[order[p]] = p


@jit_owning
def columns(start, near, order):
    """Return (parent (n,), first (n + 1,), row): rows below each column of the factor, ascending,
    with columns and rows numbered by their place in ``order``; parent: the first row, -1 if none.
    """
    n = order.size
    position, parent, mark = np.empty(n, np.int64), np.full(n, -1), np.full(n, -1)
    first = np.zeros(n + 1, np.int64)
    _positions(order, position)
    row, free = np.empty(0, np.int64), np.empty(0, np.int64)
    for is_filling in range(2):
        for i in range(n):
            mark[i] = i
            for q in range(start[order[i]], start[order[i] + 1]):
                j = position[near[q]]
                while j < i and mark[j] != i:
                    mark[j] = i
                    if is_filling:
                        row[free[j]] = i
                        free[j] += 1
                    else:
                        parent[j] = i if parent[j] < 0 else parent[j]
                        first[j + 1] += 1
                    j = parent[j]
        if not is_filling:
            for j in range(n):
                first[j + 1] += first[j]
            row, free = np.empty(first[n], np.int64), first.copy()
            for j in range(n):
                mark[j] = -1
    return parent, first, row


@jit_exact
def _cost(w, r):
    """Return the time in ns that a supernode of ``w`` columns and ``r`` rows below takes."""
    operations = w * (w * (w / 3.0 + r) + r * r)
    return OPERATION * operations + ENTRY * w * (0.5 * w + r) + PASSED_ON * 0.5 * r * r + SUPERNODE


@jit_owning
def _fundamental(parent, first):
    """Return (group (n,), count): the supernode of each column, of adjacent columns only."""
    group, count = np.empty(parent.size, np.int64), 0
    for j in range(parent.size):
        below = first[j + 1] - first[j]
        if j > 0 and not (parent[j - 1] == j and first[j] - first[j - 1] == below + 1):
            count += 1
        group[j] = count
    return group, min(count + 1, parent.size)


@jit_exact
def _top(into, s):
    """Return the supernode that ``s`` was merged into, itself if into none."""
    while into[s] != s:
        s = into[s]
    return s


@jit_owning
def children(above):
    """Return (start (ns + 2,), child (ns,)): the children of supernode s are child[start[s]:start[s
    + 1]], ascending; supernodes without a parent start at start[ns]. above (ns,): parents, -1 if
    none.
    """
    group = np.empty(above.size, np.int64)
    for s in range(above.size):
        group[s] = above[s] if above[s] >= 0 else above.size
    return grouped(group, above.size + 1)


@jit_owning
def _merged(group, count, parent, first, row, weight):
    """Return (into (count,), above (count,)): the supernode that each one is merged into, and the
    parent of each remaining one, -1 if none.
    """
    width, below = np.zeros(count, np.int64), np.zeros(count, np.int64)
    above, into = np.full(count, -1), np.arange(count)
    for j in range(group.size):
        s = group[j]
        width[s] += weight[j]
        if j + 1 == group.size or group[j + 1] != s:
            for q in range(first[j], first[j + 1]):
                below[s] += weight[row[q]]
            above[s] = group[parent[j]] if parent[j] >= 0 else -1
    start, child = children(above)
    for s in range(count):
        for q in range(start[s + 1] - 1, start[s] - 1, -1):
            c = child[q]
            parts = _cost(width[s], below[s]) + _cost(width[c], below[c])
            if _cost(width[s] + width[c], below[s]) <= parts:
                into[c] = s
                width[s] += width[c]
    for s in range(count):
        above[s] = _top(into, above[s]) if above[s] >= 0 else -1
    return into, above


@jit_owning
def _postorder(into, above):
    """Return (rank (count,), left): place of each remaining supernode, children directly before
    their parents; -1 for merged ones.
    """
    count = into.size
    rank, left = np.full(count, -1), 0
    size = np.zeros(count, np.int64)  # supernodes of a subtree
    for s in range(count):
        if into[s] == s:
            left += 1
            size[s] += 1
            if above[s] >= 0:
                size[above[s]] += size[s]
    end, last = np.full(count, -1), left  # of the places in a subtree that are still free
    for s in range(count - 1, -1, -1):
        if into[s] == s:
            if above[s] < 0:
                rank[s] = last - 1
                last -= size[s]
            else:
                rank[s] = end[above[s]] - 1
                end[above[s]] -= size[s]
            end[s] = rank[s]
    return rank, left


@jit_owning
def supernodes(parent, first, row, weight):
    """Return (start (ns + 1,), block, below (ns + 1,), rows, above (ns,)).

    The columns of supernode s are block[start[s]:start[s + 1]], given by their places in the
    previous order; rows[below[s]:below[s + 1]] are the places in ``block`` of the rows below them,
    ascending. above: parent of each supernode, -1 if none. weight (n,): unknowns of each column.
    """
    n = parent.size
    group, count = _fundamental(parent, first)
    into, above = _merged(group, count, parent, first, row, weight)
    rank, left = _postorder(into, above)
    place = np.empty(n, np.int64)
    for j in range(n):
        place[j] = rank[_top(into, group[j])]
    start, block = grouped(place, left)
    position = np.empty(n, np.int64)
    _positions(block, position)
    up, below = np.full(left, -1), np.zeros(left + 1, np.int64)
    for s in range(count):
        if into[s] == s and above[s] >= 0:
            up[rank[s]] = rank[above[s]]
    for s in range(left):
        j = block[start[s + 1] - 1]
        below[s + 1] = below[s] + first[j + 1] - first[j]
    rows = np.empty(below[left], np.int64)
    for s in range(left):
        j = block[start[s + 1] - 1]
        for q in range(first[j + 1] - first[j]):
            at, later = below[s] + q, position[row[first[j] + q]]
            while at > below[s] and rows[at - 1] > later:
                rows[at] = rows[at - 1]
                at -= 1
            rows[at] = later
    return start, block, below, rows, up
