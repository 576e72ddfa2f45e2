"""Treatment of pivots that are zero or positive within round-off.

The argument ``rounded`` of a factorisation, `ROUNDED` or `THROUGH`, is the least pivot, as a share
of its diagonal, that counts as zero.
"""

import math

from kernels.compile.jit import jit_exact

ZERO_PIVOT = 1e-11  # a pivot below this share of its diagonal is zero within round-off
SOFT = 1e-6  # share of its diagonal that replaces such a pivot
ROUNDED = -1e-13  # a negative pivot above this share is round-off too: see `condensed.block_ldlt`
THROUGH = math.inf  # no pivot is replaced, negative ones are no failure: they are counted


@jit_exact
def regularised(pivot, own, scale, rounded):
    """Return ``pivot``, or its replacement if it is zero within round-off.

    Such a pivot, between ``rounded`` and `ZERO_PIVOT` times its diagonal ``own``, belongs to a
    motion without stiffness. It is replaced by a small share of the diagonal (or of ``scale``, of
    the same unit): the solution follows a force along the motion, but hardly the round-off in
    forces. With `THROUGH` no pivot is replaced, as true pivots are as small near limit points.
    """
    size = max(abs(own), 1e-3 * scale)
    if rounded * size <= pivot <= ZERO_PIVOT * size:
        return SOFT * max(abs(own), scale)
    return pivot
