"""Height of a lattice: the distance of its outer rows, or its extent."""

import numpy as np

from kernels.compile.jit import jit_exact


@jit_exact
def _mean(x, coordinates):
    """Return the mean of some coordinates of ``x``."""
    total = 0.0
    for c in coordinates:
        total += x[c]
    return total / coordinates.size


@jit_exact
def height(x, top, base):
    """Return the mean of the coordinates ``top`` less the mean of the coordinates ``base``, m.

    If ``top`` is empty, return the extent of ``base``, as a caliper measures it.
    """
    if top.size > 0:
        return _mean(x, top) - _mean(x, base)
    low, high = np.inf, -np.inf
    for c in base:
        low, high = min(low, x[c]), max(high, x[c])
    return high - low
