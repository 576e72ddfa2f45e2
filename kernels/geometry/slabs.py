"""Area of the union of convex polygons, exact up to round-off.

The plane is cut into slabs at the heights of all corners and of all crossings of sides. Within a
slab the covered length of a level line is linear in its height, so that the area is the covered
length at half height times the height of the slab.
"""

import numpy as np

from kernels.compile.jit import jit_exact, jit_owning
from kernels.geometry.intervals import covered, insert

PARALLEL = 1e-14  # least sine between two sides that cross elsewhere than at corners
FLAT = 1e-15  # share of the total height: a lower slab is merged with the next one


@jit_exact
def _crossing(p, q, r, s):
    """Return the height at which the sides p-q and r-s cross, NaN if they do not."""
    ux, uy = q[0] - p[0], q[1] - p[1]
    vx, vy = s[0] - r[0], s[1] - r[1]
    wx, wy = r[0] - p[0], r[1] - p[1]
    turn = ux * vy - uy * vx
    if abs(turn) <= PARALLEL * np.sqrt((ux * ux + uy * uy) * (vx * vx + vy * vy)):
        return np.nan
    along, beside = (wx * vy - wy * vx) / turn, (wx * uy - wy * ux) / turn
    if min(along, beside) < 0.0 or max(along, beside) > 1.0:
        return np.nan
    return p[1] + along * uy


@jit_exact
def _corner(loops, k, i):
    """Return corner ``i`` of polygon ``k``."""
    return loops[k, i, 0], loops[k, i, 1]


@jit_exact
def heights(loops, low, high, levels):
    """Write the heights of all corners and crossings to ``levels`` (n,) as far as they fit.

    Return their number. loops (k, c + 1, 2): the corners of each polygon, the first one repeated at
    the end. low, high (k, 2): its bounding box. Polygons are sorted by low[:, 1].
    """
    n, sides = 0, loops.shape[1] - 1
    for a in range(loops.shape[0]):
        for i in range(sides):
            if n < levels.size:
                levels[n] = loops[a, i, 1]
            n += 1
        for b in range(a + 1, loops.shape[0]):
            if low[b, 1] > high[a, 1]:
                break
            if low[b, 0] > high[a, 0] or low[a, 0] > high[b, 0]:
                continue
            for i in range(sides):
                p, q = _corner(loops, a, i), _corner(loops, a, i + 1)
                for j in range(sides):
                    y = _crossing(p, q, _corner(loops, b, j), _corner(loops, b, j + 1))
                    if y == y:  # not NaN
                        if n < levels.size:
                            levels[n] = y
                        n += 1
    return n


@jit_exact
def _interval(loops, k, y):
    """Return the interval of a polygon on a line at height ``y`` that passes through no corner."""
    begin, end = np.inf, -np.inf
    for i in range(loops.shape[1] - 1):
        (x0, y0), (x1, y1) = _corner(loops, k, i), _corner(loops, k, i + 1)
        if (y0 < y) != (y1 < y):
            x = x0 + (y - y0) * ((x1 - x0) / (y1 - y0))
            begin, end = min(begin, x), max(end, x)
    return begin, end


@jit_owning
def area(loops, low, high, levels):
    """Return the area of the union in m^2. levels (n,): all `heights`, in ascending order."""
    active, left, right = np.empty(len(loops), np.int64), np.empty(len(loops)), np.empty(len(loops))
    count, begun, total, bottom = 0, 0, 0.0, levels[0]
    flat = FLAT * (levels[-1] - bottom)
    for top in levels:
        if top - bottom <= flat:
            continue
        y, kept = 0.5 * (bottom + top), 0
        while begun < len(loops) and low[begun, 1] < y:
            active[count] = begun
            count, begun = count + 1, begun + 1
        for i in range(count):
            k = active[i]
            if high[k, 1] > y:
                begin, end = _interval(loops, k, y)
                place = insert(left, right, kept, 0, begin, end)
                for j in range(
                    kept, place, -1
                ):  # keep the order of this slab, as the next one has nearly the same
                    active[j] = active[j - 1]
                active[place] = k
                kept += 1
        count = kept
        total += (top - bottom) * covered(left, right, 0, kept)
        bottom = top
    return total
