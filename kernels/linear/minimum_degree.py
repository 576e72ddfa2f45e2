"""Minimum-degree order of elimination, on a graph stored as rows of bits.

Eliminating a block connects all its neighbours with each other. The neighbours that remain in its
row of bits are its column of the factor (George & Liu 1989, SIAM Review 31: The evolution of the
minimum degree ordering algorithm).
"""

import numpy as np

from kernels.compile.jit import jit_exact, jit_owning

ONE = np.uint64(1)
WORD = 64


@jit_owning
def graph(n):
    """Return an empty graph of ``n`` blocks: (n, words) bits."""
    return np.zeros((n, n // WORD + 1), np.uint64)


@jit_exact
def connect(bits, i, j):
    """Connect blocks ``i`` and ``j``."""
    if i != j:
        bits[i, j // WORD] |= ONE << np.uint64(j % WORD)
        bits[j, i // WORD] |= ONE << np.uint64(i % WORD)


@jit_exact
def _members(row, out):
    """Write the bits set in ``row`` to ``out``, ascending; return their number."""
    n = 0
    for word in range(row.size):
        rest, base = row[word], word * WORD
        while rest != 0:
            if rest & ONE:
                out[n] = base
                n += 1
            rest >>= ONE
            base += 1
    return n


@jit_exact
def _count(row):
    """Return the number of bits set in ``row``."""
    n = 0
    for word in range(row.size):
        rest = row[word]
        while rest != 0:
            rest &= rest - ONE
            n += 1
    return n


@jit_exact
def _link(queue, i, degree):
    """Insert ``i`` at the head of the list of its degree; ``queue``: rows head, next, previous."""
    first = queue[0, degree]
    queue[0, degree], queue[1, i], queue[2, i] = i, first, -1
    if first >= 0:
        queue[2, first] = i


@jit_exact
def _unlink(queue, i, degree):
    """Remove ``i`` from the list of its degree."""
    after, before = queue[1, i], queue[2, i]
    if before >= 0:
        queue[1, before] = after
    else:
        queue[0, degree] = after
    if after >= 0:
        queue[2, after] = before


@jit_owning
def minimum_degree(bits):
    """Return the order (n,) of elimination; ``bits`` becomes the columns of the factor."""
    n = bits.shape[0]
    order, members, degree = np.empty(n, np.int64), np.empty(n, np.int64), np.empty(n, np.int64)
    queue = np.full((3, n), -1)
    for i in range(n - 1, -1, -1):
        degree[i] = _count(bits[i])
        _link(queue, i, degree[i])
    least = 0
    for step in range(n):
        while queue[0, least] < 0:
            least += 1
        v = queue[0, least]
        _unlink(queue, v, least)
        order[step] = v
        mask, word = ~(ONE << np.uint64(v % WORD)), v // WORD
        for m in range(_members(bits[v], members)):
            u = members[m]
            _unlink(queue, u, degree[u])
            for k in range(bits.shape[1]):
                bits[u, k] |= bits[v, k]
            bits[u, word] &= mask
            bits[u, u // WORD] &= ~(ONE << np.uint64(u % WORD))
            degree[u] = _count(bits[u])
            _link(queue, u, degree[u])
            least = min(least, degree[u])
    return order


@jit_owning
def columns(bits, order):
    """Return (start (n + 1,), row): positions below each block in its column, ascending."""
    n = order.size
    position, members = np.empty(n, np.int64), np.empty(n, np.int64)
    start = np.zeros(n + 1, np.int64)
    for p in range(n):
        position[order[p]] = p
        start[p + 1] = start[p] + _count(bits[order[p]])
    row = np.empty(start[n], np.int64)
    for p in range(n):
        for m in range(_members(bits[order[p]], members)):
            at, later = start[p] + m, position[members[m]]
            while at > start[p] and row[at - 1] > later:
                row[at] = row[at - 1]
                at -= 1
            row[at] = later
    return start, row
