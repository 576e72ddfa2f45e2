"""How high a lattice stands."""

import numpy as np

from kernels.compile.jit import jit_exact


@jit_exact
def _mean(x, coordinates):
    total = 0.0
    for c in coordinates:
        total += x[c]
    return total / coordinates.size


@jit_exact
def height(x, top, base):
    """Return how far the mean of ``top`` is above that of ``base`` (coordinates).

    Where ``top`` is empty it is the extent of ``base``, what a caliper would read.
    """
    if top.size > 0:
        return _mean(x, top) - _mean(x, base)
    low, high = np.inf, -np.inf
    for c in base:
        low, high = min(low, x[c]), max(high, x[c])
    return high - low
