"""Area that walls with round ends cover together, however they overlap.

By scanlines: along a line exact, across them the midpoint rule. A wall is a rectangle an element
and a disc a node; each leaves an interval on every line that it meets.
"""

from collections.abc import Iterator
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]
Intervals = tuple[Ints, Floats, Floats]
Band = tuple[int, int]

LINES = 16  # within the thickness of the thinnest wall: an error of 3e-4 where walls are many
MOST_LINES = 1 << 17  # of all: where walls are much thinner than the lattice is high, fewer of each
TOGETHER = 1 << 19  # intervals that are in memory at a time
ANGLE = 0.4  # of the lines: along a wall, as drawn ones often lie, the rule would be of first order
FLAT = 1e-12  # least sine between a line and a side of a rectangle


def covered_area(points: Floats, edges: Ints, thickness: Floats) -> float:
    """Area in m^2, NaN where a point is. points (n, 2) and thickness (m,) of the elements in m.

    edges (m, 2): the nodes of each element.
    """
    if not np.isfinite(points).all():
        return float("nan")
    cosine, sine = np.cos(ANGLE), np.sin(ANGLE)
    turned = (points - points[edges].mean(axis=(0, 1))) @ np.array(
        [[cosine, -sine], [sine, cosine]]
    )
    radius = np.zeros(len(points))
    np.maximum.at(radius, edges, 0.5 * thickness[:, None])
    ends, length = turned[edges], 0.0
    spacing = float(max(thickness.min() / LINES, np.ptp(ends[..., 1]) / MOST_LINES))
    for band in _bands(turned[:, 1], radius, ends, spacing):
        discs, bars = _discs(turned, radius, spacing, band), _bars(ends, thickness, spacing, band)
        line, left, right = (np.concatenate(both) for both in zip(discs, bars, strict=True))
        length += _length_of_union(line, left, right)
    return float(spacing * length)


def _bands(height: Floats, radius: Floats, ends: Floats, spacing: float) -> Iterator[Band]:
    """First and last line (exclusive) of bands of lines, few enough intervals in each."""
    first, last = (height - radius).min() / spacing, (height + radius).max() / spacing
    count = (2.0 * radius.sum() + np.abs(ends[:, 1, 1] - ends[:, 0, 1]).sum()) / spacing
    cuts = np.linspace(first, last + 1.0, 2 + int(count / TOGETHER)).astype(np.int64)
    cuts[0] -= 1
    return pairwise(cuts.tolist())


def _discs(center: Floats, radius: Floats, spacing: float, band: Band) -> Intervals:
    """Intervals of discs. center (n, 2), radius (n,)."""
    which, line, height = _lines(center[:, 1], radius, spacing, band)
    half = np.sqrt(np.maximum(radius[which] ** 2 - height**2, 0.0))
    return line, center[which, 0] - half, center[which, 0] + half


def _bars(ends: Floats, thickness: Floats, spacing: float, band: Band) -> Intervals:
    """Intervals of rectangles: where the strip along each meets the one across. ends (m, 2, 2)."""
    axis, center = ends[:, 1] - ends[:, 0], ends.mean(axis=1)
    length = np.hypot(axis[:, 0], axis[:, 1])
    cosine, sine = (_not_flat(part / np.where(length > 0.0, length, 1.0)) for part in axis.T)
    along, across = 0.5 * length, 0.5 * thickness
    extent = along * np.abs(sine) + across * np.abs(cosine)
    which, line, height = _lines(center[:, 1], extent, spacing, band)
    middle = -height * (sine / cosine)[which], height * (cosine / sine)[which]
    half = (along / np.abs(cosine))[which], (across / np.abs(sine))[which]
    left = np.maximum(middle[0] - half[0], middle[1] - half[1])
    right = np.minimum(middle[0] + half[0], middle[1] + half[1])
    return line, center[which, 0] + left, center[which, 0] + right


def _not_flat(sine: Floats) -> Floats:
    return np.copysign(np.maximum(np.abs(sine), FLAT), sine)


def _lines(middle: Floats, extent: Floats, spacing: float, band: Band) -> tuple[Ints, Ints, Floats]:
    """Every line of a band that each of some shapes meets: the shape, the line, its height over
    the middle.

    middle, extent (k,): a shape lies between middle - extent and middle + extent.
    """
    low, high = (
        np.ceil(end / spacing).astype(np.int64) for end in (middle - extent, middle + extent)
    )
    first = np.maximum(low, band[0])
    count = np.maximum(np.minimum(high, band[1]) - first, 0)
    which = np.repeat(np.arange(len(middle)), count)
    line = np.arange(len(which)) - np.repeat(np.cumsum(count) - count - first, count)
    return which, line, spacing * line - middle[which]


def _length_of_union(line: Ints, left: Floats, right: Floats) -> float:
    """Length that the intervals cover, all lines together, which are laid out one after another."""
    if len(line) == 0:
        return 0.0
    apart = 2.0 * max(-left.min(), right.max())
    order = np.argsort(left := left + apart * line)
    left, right = left[order], (right + apart * line)[order]
    reached = np.maximum.accumulate(right)
    fresh = right[1:] - np.maximum(left[1:], reached[:-1])
    return float(right[0] - left[0] + np.maximum(fresh, 0.0).sum())
