"""Arctangent of small ratios in plain arithmetic: several times as fast as a call of libm.

    atan r = r + r z P(z) / Q(z),   z = r^2

with the coefficients of the Cephes Math Library (S. Moshier, 1995; atan.c), for |r| <= 0.66.
"""

import math

from kernels.compile.jit import jit

LARGEST = 0.66


@jit
def arctangent(ratio):
    """Return the arctangent of ``ratio``, whose absolute value is at most `LARGEST`."""
    z = ratio * ratio
    p = -8.750608600031904122785e-1 * z - 1.615753718733365076637e1
    p = (p * z - 7.500855792314704667340e1) * z - 1.228866684490136173410e2
    p = p * z - 6.485021904942025371773e1
    q = (z + 2.485846490142306297962e1) * z + 1.650270098316988542046e2
    q = (q * z + 4.328810604912902668951e2) * z + 4.853903996359136964868e2
    q = q * z + 1.945506571482613964425e2
    return ratio + ratio * (z * p / q)


@jit
def between(cos_a, sin_a, cos_b, sin_b):
    """Return the angle from unit direction a to unit direction b, in (-pi, pi]."""
    sine, cosine = cos_a * sin_b - sin_a * cos_b, cos_a * cos_b + sin_a * sin_b
    if abs(sine) < LARGEST * (1.0 + cosine):
        return 2.0 * arctangent(sine / (1.0 + cosine))
    return math.atan2(sine, cosine)
