"""Area of the union of walls with round ends, by scanlines.

Lengths along a line are exact; the area is their midpoint rule across the lines. A wall is one
rectangle per element and one disc per node; each shape covers an interval of every line it meets.
"""

from typing import NamedTuple

import numpy as np

from kernels.arrays import grouped, pair
from kernels.compile.jit import jit_exact, jit_owning
from kernels.geometry.intervals import covered, insert

FLAT = 1e-12  # least sine between a line and a side of a rectangle
ANGLE = 0.4  # angle of the lines, rad: the rule is of first order where walls are parallel to them
COSINE, SINE = np.cos(ANGLE), np.sin(ANGLE)
MOST_LINES = 1 << 17  # total number: bounds the lines per wall where walls are very thin


class Shapes(NamedTuple):
    """Discs and rectangles. center (k, 2) in m. axis (k, 2): unit vector; (0, 0) for a disc.

    along, across (k,): half the length and width of a rectangle, m; 0 and the radius of a disc.
    """

    center: np.ndarray
    axis: np.ndarray
    along: np.ndarray
    across: np.ndarray


@jit_exact
def _rotated(x, y):
    """Return the coordinates of a point along and across the lines."""
    return COSINE * x + SINE * y, COSINE * y - SINE * x


@jit_owning
def _shapes(points, edges, thickness):
    """Return the discs of all nodes, then the rectangles of all elements, in rotated axes."""
    n, m = points.shape[0], edges.shape[0]
    shapes = Shapes(np.zeros((n + m, 2)), np.zeros((n + m, 2)), np.zeros(n + m), np.zeros(n + m))
    middle_x, middle_y = 0.0, 0.0
    for e in range(m):
        i, j = pair(edges, e)
        middle_x += 0.5 * (points[i, 0] + points[j, 0]) / m
        middle_y += 0.5 * (points[i, 1] + points[j, 1]) / m
    for p in range(n):
        at = _rotated(points[p, 0] - middle_x, points[p, 1] - middle_y)
        shapes.center[p, 0], shapes.center[p, 1] = at
    for e in range(m):
        k = n + e
        i, j = pair(edges, e)
        for axis in range(2):
            shapes.center[k, axis] = 0.5 * (shapes.center[i, axis] + shapes.center[j, axis])
            shapes.axis[k, axis] = shapes.center[j, axis] - shapes.center[i, axis]
        length = np.sqrt(shapes.axis[k, 0] ** 2 + shapes.axis[k, 1] ** 2)
        if length > 0.0:
            shapes.axis[k, 0] /= length
            shapes.axis[k, 1] /= length
        shapes.along[k], shapes.across[k] = 0.5 * length, 0.5 * thickness[e]
        for p in (i, j):
            shapes.across[p] = max(shapes.across[p], shapes.across[k])
    return shapes


@jit_exact
def _extent(shapes, k):
    """Return half the extent of a shape across the lines, m."""
    if shapes.along[k] == 0.0:
        return shapes.across[k]
    ux, uy = abs(shapes.axis[k, 0]), abs(shapes.axis[k, 1])
    return shapes.along[k] * uy + shapes.across[k] * ux


@jit_owning
def _from_left_to_right(shapes):
    """Return the shapes (k,) sorted by their left ends, to within the width of one of k strips."""
    count = shapes.along.size
    left = shapes.center[:, 0] - shapes.along
    least, most = np.inf, -np.inf
    for k in range(count):
        least, most = min(least, left[k]), max(most, left[k])
    strip = np.zeros(count, np.int64)
    if most > least:
        for k in range(count):
            strip[k] = int((count - 1) * ((left[k] - least) / (most - least)))
    return grouped(strip, count)[1]


@jit_exact
def _not_flat(sine):
    """Return ``sine`` with a magnitude of at least `FLAT`."""
    return np.copysign(max(abs(sine), FLAT), sine)


@jit_exact
def _interval(height, ux, uy, along, across):
    """Return the interval of a shape, relative to its centre, on a line ``height`` m above the
    centre.
    """
    if ux == 0.0 and uy == 0.0:
        half = np.sqrt(max(across * across - height * height, 0.0))
        return -half, half
    cosine, sine = _not_flat(ux), _not_flat(uy)
    one, two = -height * (sine / cosine), height * (cosine / sine)
    far, wide = along / abs(cosine), across / abs(sine)
    return max(one - far, two - wide), min(one + far, two + wide)


@jit_exact
def _lines(shapes, k, spacing, band):
    """Return the first (inclusive) and the last (exclusive) line of a band that a shape
    intersects.
    """
    y, extent = shapes.center[k, 1], _extent(shapes, k)
    first, last = np.ceil((y - extent) / spacing), np.ceil((y + extent) / spacing)
    return max(int(first), band[0]), min(int(last), band[1])


@jit_owning
def _covered(shapes, order, spacing, band):
    """Return the length in m covered on the lines of a ``band`` (first, last + 1).

    The insertion sort takes quadratic time on a line where ``order`` differs much from the order of
    the left ends, as with large shapes.
    """
    start = np.zeros(band[1] - band[0] + 1, np.int64)
    for k in order:
        first, last = _lines(shapes, k, spacing, band)
        for line in range(first, last):
            start[line - band[0] + 1] += 1
    for line in range(start.size - 1):
        start[line + 1] += start[line]
    left, right, free = np.empty(start[-1]), np.empty(start[-1]), start[:-1].copy()
    for k in order:
        x, y = pair(shapes.center, k)
        ux, uy = pair(shapes.axis, k)
        first, last = _lines(shapes, k, spacing, band)
        for line in range(first, last):
            at = line - band[0]
            height = spacing * line - y
            begin, end = _interval(height, ux, uy, shapes.along[k], shapes.across[k])
            insert(left, right, free[at], start[at], x + begin, x + end)
            free[at] += 1
    total = 0.0
    for line in range(start.size - 1):
        total += covered(left, right, start[line], start[line + 1])
    return total


@jit_owning
def covered_area(points, edges, thickness, lines, together):
    """Return the area in m^2 of the union of all elements and the discs round their nodes.

    points (n, 2) m; edges (m, 2): nodes of each element; thickness (m,) m. lines: number of lines
    across the thinnest wall. together: most intervals in memory at a time.
    """
    shapes = _shapes(points, edges, thickness)
    low, high, sum_of_extents = np.inf, -np.inf, 0.0
    for k in range(shapes.along.size):
        y, extent = shapes.center[k, 1], _extent(shapes, k)
        if extent > 0.0:
            low, high = min(low, y - extent), max(high, y + extent)
            sum_of_extents += extent
    spacing = max(thickness.min() / lines, (high - low) / MOST_LINES)
    first, last = int(np.floor(low / spacing)), int(np.ceil(high / spacing)) + 1
    bands = 1 + int(2.0 * sum_of_extents / spacing / together)
    order, total = _from_left_to_right(shapes), 0.0
    for b in range(bands):
        band = first + (last - first) * b // bands, first + (last - first) * (b + 1) // bands
        total += _covered(shapes, order, spacing, band)
    return spacing * total
