"""Intervals on a line: kept in the order in which they begin, and measured together."""

import numpy as np

from kernels.compile.jit import jit_exact


@jit_exact
def insert(left, right, at, first, begin, end):
    """Put an interval in its place among those from ``first`` to ``at`` that begin in order.

    Return the place.
    """
    while at > first and left[at - 1] > begin:
        left[at], right[at] = left[at - 1], right[at - 1]
        at -= 1
    left[at], right[at] = begin, end
    return at


@jit_exact
def covered(left, right, first, last):
    """Return the length of the intervals from ``first`` to ``last`` (exclusive), overlaps once.

    left, right (n,): where they begin, in order, and end.
    """
    total, reached = 0.0, -np.inf
    for k in range(first, last):
        total += max(right[k] - max(left[k], reached), 0.0)
        reached = max(reached, right[k])
    return total
