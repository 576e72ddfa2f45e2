"""Length that discs and rectangles cover together on parallel lines, however they overlap."""

import numpy as np

from kernels.jit import jit_exact, jit_owning

FLAT = 1e-12  # least sine between a line and a side of a rectangle


@jit_exact
def _not_flat(sine):
    return np.copysign(max(abs(sine), FLAT), sine)


@jit_exact
def _interval(height, ux, uy, along, across):
    """Return where a shape begins and ends on a line ``height`` m above its middle."""
    if ux == 0.0 and uy == 0.0:
        half = np.sqrt(max(across * across - height * height, 0.0))
        return -half, half
    cosine, sine = _not_flat(ux), _not_flat(uy)
    one, two = -height * (sine / cosine), height * (cosine / sine)
    far, wide = along / abs(cosine), across / abs(sine)
    return max(one - far, two - wide), min(one + far, two + wide)


@jit_exact
def _lines(y, axis, along, across, spacing, band):
    """Return the first line (inclusive) and the last (exclusive) of a band that a shape meets."""
    extent = along * abs(axis[1]) + across * abs(axis[0])
    if axis[0] == 0.0 and axis[1] == 0.0:
        extent = across
    first, last = np.ceil((y - extent) / spacing), np.ceil((y + extent) / spacing)
    return max(int(first), band[0]), min(int(last), band[1])


@jit_exact
def _insert(left, right, at, first, begin, end):
    """Put an interval in its place among those from ``first`` to ``at`` that begin in order."""
    while at > first and left[at - 1] > begin:
        left[at], right[at] = left[at - 1], right[at - 1]
        at -= 1
    left[at], right[at] = begin, end


@jit_exact
def _union(left, right):
    """Return the length of intervals that begin in order, where they overlap but once."""
    total, reached = 0.0, -np.inf
    for k in range(left.size):
        total += max(right[k] - max(left[k], reached), 0.0)
        reached = max(reached, right[k])
    return total


@jit_owning
def covered(center, axis, along, across, order, spacing, band):
    """Return the length in m that k shapes cover on the lines of a ``band``: first, last + 1.

    center (k, 2), axis (k, 2): unit vector; along, across (k,): half of a rectangle's length and
    width, m. A shape without an axis is a disc of radius ``across``. The lines are level,
    ``spacing`` m apart. ``order`` (k,): from left to right, nearly as they begin on each line, as
    small shapes do; else the time goes with the square of their number on a line.
    """
    start = np.zeros(band[1] - band[0] + 1, np.int64)
    for k in order:
        first, last = _lines(center[k, 1], axis[k], along[k], across[k], spacing, band)
        for line in range(first, last):
            start[line - band[0] + 1] += 1
    for line in range(start.size - 1):
        start[line + 1] += start[line]
    left, right, free = np.empty(start[-1]), np.empty(start[-1]), start[:-1].copy()
    for k in order:
        first, last = _lines(center[k, 1], axis[k], along[k], across[k], spacing, band)
        for line in range(first, last):
            height, at = spacing * line - center[k, 1], line - band[0]
            begin, end = _interval(height, axis[k, 0], axis[k, 1], along[k], across[k])
            x = center[k, 0]
            _insert(left, right, free[at], start[at], x + begin, x + end)
            free[at] += 1
    total = 0.0
    for line in range(start.size - 1):
        total += _union(left[start[line] : start[line + 1]], right[start[line] : start[line + 1]])
    return total
