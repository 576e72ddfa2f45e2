"""The arc of an element is longer than its chord.

In a bilinear element the mid-surface is straight along its sides, while the directors at their ends
show that it is bent. An arc of curvature k and length l has a chord that is shorter by the factor
1 - (k l)^2 / 24. The strain of the mid-surface is that of the arc,

    A11 <- A11 + h_s^2 / 12 B11^2,   A22 <- A22 + h_z^2 / 12 B22^2

less the same at rest. In a deflected plate this is the mean of the squared slope, whose variation
between two nodes the bilinear element does not have; its buckling load would be too high without.
"""

from kernels.compile.jit import jit

TWELFTH = 1.0 / 12.0


@jit
def lengthen(size, rest, m):
    """Add the bow to measures ``m`` (9,) less those at ``rest`` (9,); return d A11 / d B11 and
    d A22 / d B22.
    """
    s, z = TWELFTH * size[0] * size[0], TWELFTH * size[1] * size[1]
    m[0] += s * m[3] * (m[3] + 2.0 * rest[3])
    m[1] += z * m[4] * (m[4] + 2.0 * rest[4])
    return 2.0 * s * (m[3] + rest[3]), 2.0 * z * (m[4] + rest[4])


@jit
def pull_back(lean, slope):
    """Turn the slopes (9,) of an energy in lengthened measures into those in the measures."""
    slope[3] += lean[0] * slope[0]
    slope[4] += lean[1] * slope[1]


@jit
def pull_back_second(size, lean, slope, second):
    """Turn its second derivatives (9, 9) into those in the measures; slope: not yet turned."""
    for k in range(9):
        second[3, k] += lean[0] * second[0, k]
        second[4, k] += lean[1] * second[1, k]
    for k in range(9):
        second[k, 3] += lean[0] * second[k, 0]
        second[k, 4] += lean[1] * second[k, 1]
    second[3, 3] += 2.0 * TWELFTH * size[0] * size[0] * slope[0]
    second[4, 4] += 2.0 * TWELFTH * size[1] * size[1] * slope[1]
