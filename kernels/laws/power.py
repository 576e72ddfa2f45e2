"""Powers of four positive numbers at a time, which take as long as one of the C library.

    q^n = e^(n ln q),   q = s 2^k with 2^(-1/2) <= s < 2^(1/2)

    ln q = k ln 2 + 2 (z + z^3 / 3 + z^5 / 5 + ..),   z = (s - 1) / (s + 1)
    e^y = 2^j (c + r) / (c - r),   y = j ln 2 + r with |r| <= ln 2 / 2
    c = r coth(r / 2) = 2 sum of B_i r^i / i!,   i = 0, 2, 4, ..;  B_i: Bernoulli numbers

Both series end where terms are below the round-off of their sum.

Source: M. Abramowitz and I. Stegun, Handbook of Mathematical Functions, 1964, 4.1.27 and 4.5.67.
"""

import math

from kernels.compile.jit import jit
from kernels.compile.simd import exponent, nearest, scaled, spread

LN2 = math.log(2.0)
LOGARITHM = tuple(2.0 / i for i in range(19, 0, -2))  # of z^18, z^16 .. 1
HALVES = (
    -691.0 / 653_837_184_000.0, 1.0 / 23_950_080.0, -1.0 / 604_800.0, 1.0 / 15_120.0, -1.0 / 360.0,
    1.0 / 6.0, 2.0,
)  # fmt: skip  # of r^12, r^10 .. 1


@jit
def _series(coefficients, x):
    """Return the polynomial with these coefficients, the highest power first."""
    total = spread(coefficients[0])
    for coefficient in coefficients[1:]:
        total = total * x + spread(coefficient)
    return total


@jit
def power(q, n):
    """Return the ``n``-th power of a `simd.Four`, correct to 3 units in the last place while it is
    from 0.01 to 100; of numbers that are not positive it is anything.
    """
    one, k = spread(1.0), exponent(q)
    s = scaled(q, spread(0.0) - k)
    z = (s - one) / (s + one)
    y = spread(n) * (k * spread(LN2) + z * _series(LOGARITHM, z * z))
    j = nearest(y / spread(LN2))
    r = y - j * spread(LN2)
    c = _series(HALVES, r * r)
    return scaled((c + r) / (c - r), j)
