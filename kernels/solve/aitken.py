"""Fixed-point iteration with the vector form of Aitken's extrapolation.

With y the argument and x its image, y' = y + w (x - y); w follows from how x - y has changed since
the iteration before (Irons & Tuck 1969, Int. J. Numer. Methods Eng. 1, 275).
"""

from kernels.compile.jit import jit_exact

LEAST, MOST = 0.3, 8.0  # of the way from argument to image
FURTHER = 0.5  # leaps beyond the image, or short of it: more is no small change


@jit_exact
def approach(x, y, change, coordinates, relaxed):
    """Move the argument ``y`` (n,) on, given its image ``x``; return the share w.

    change (n,), in m: x - y of the iteration before, exchanged for that of this one. relaxed: the
    share before, 0 at the first.
    """
    turned, square, most = 0.0, 0.0, 0.0
    for i in range(x.size):
        now = (x[i] - y[i]) * coordinates.scale[i]
        turn = now - change[i]
        turned += change[i] * turn
        square += turn * turn
        most = max(most, abs(now))
        change[i] = now
    share = 1.0
    if relaxed > 0.0 and square > 0.0:
        share = min(max(-relaxed * turned / square, LEAST), MOST)
        if abs(share - 1.0) * most > FURTHER * coordinates.leap:
            share = 1.0
    for i in range(x.size):
        y[i] += share * change[i] / coordinates.scale[i]
    return share
