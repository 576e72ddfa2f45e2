"""Fixed-point iteration with the vector form of Aitken's extrapolation.

With y the argument, x its image and r = x - y, the next argument is

    y' = y + w r,   w = -w_0 r_0 . (r - r_0) / |r - r_0|^2

with w_0 and r_0 of the previous iteration (Irons & Tuck 1969, Int. J. Numer. Methods Eng. 1, 275).
"""

from kernels.compile.jit import jit_exact

SMALLEST_FACTOR, LARGEST_FACTOR = 0.3, 8.0  # bounds of w
LARGEST_CHANGE = 0.5  # of `Coordinates.leap`: w = 1 if w != 1 would shift the argument by more


@jit_exact
def relax(x, y, change, coordinates, previous):
    """Replace the argument ``y`` (n,) by y', given its image ``x`` (n,); return w.

    change (n,): residual of the previous iteration in m, overwritten with the present one.
    previous: w of the previous iteration, 0 in the first.
    """
    product, norm2, largest = 0.0, 0.0, 0.0
    for i in range(x.size):
        residual = (x[i] - y[i]) * coordinates.scale[i]
        difference = residual - change[i]
        product += change[i] * difference
        norm2 += difference * difference
        largest = max(largest, abs(residual))
        change[i] = residual
    factor = 1.0
    if previous > 0.0 and norm2 > 0.0:
        factor = min(max(-previous * product / norm2, SMALLEST_FACTOR), LARGEST_FACTOR)
        if abs(factor - 1.0) * largest > LARGEST_CHANGE * coordinates.leap:
            factor = 1.0
    for i in range(x.size):
        y[i] += factor * change[i] / coordinates.scale[i]
    return factor
