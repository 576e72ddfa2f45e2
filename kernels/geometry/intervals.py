"""Intervals on a line: insertion sort by their left ends, and the length of their union."""

import numpy as np

from kernels.compile.jit import jit_exact


@jit_exact
def insert(left, right, at, first, begin, end):
    """Insert an interval among the intervals ``first`` to ``at`` (exclusive), sorted by left ends.

    Return its place. left, right (n,): ends of the intervals, with room at ``at``.
    """
    while at > first and left[at - 1] > begin:
        left[at], right[at] = left[at - 1], right[at - 1]
        at -= 1
    left[at], right[at] = begin, end
    return at


@jit_exact
def covered(left, right, first, last):
    """Return the length of the union of the intervals from ``first`` to ``last`` (exclusive).

    left, right (n,): their ends, sorted by ``left``.
    """
    total, reached = 0.0, -np.inf
    for k in range(first, last):
        total += max(right[k] - max(left[k], reached), 0.0)
        reached = max(reached, right[k])
    return total
