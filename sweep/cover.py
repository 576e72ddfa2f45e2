"""Area that walls with round ends cover together, however they overlap.

By scanlines: along a line exact, across them the midpoint rule. A wall is a rectangle an element
and a disc a node; each leaves an interval on every line that it meets.
"""

from collections.abc import Iterator
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from kernels import scanline

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]
Band = tuple[int, int]

LINES = 16  # within the thinnest wall: an error of 3e-4 where walls are many, 1e-3 for one of them
MOST_LINES = 1 << 17  # of all: where walls are much thinner than the lattice is high, fewer of each
TOGETHER = 1 << 19  # intervals that are in memory at a time
ANGLE = 0.4  # of the lines: along a wall, as drawn ones often lie, the rule would be of first order


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
    start, end = turned[edges[:, 0]], turned[edges[:, 1]]
    length = np.hypot(*(end - start).T)
    center = np.concatenate([turned, 0.5 * (start + end)])
    axis = np.zeros_like(center)
    axis[len(points) :] = (end - start) / np.where(length > 0.0, length, 1.0)[:, None]
    along = np.concatenate([np.zeros(len(points)), 0.5 * length])
    across = np.concatenate([radius, 0.5 * thickness])
    order = np.argsort(center[:, 0] - along)
    spacing = float(max(thickness.min() / LINES, np.ptp(turned[:, 1]) / MOST_LINES))
    extent = along * np.abs(axis[:, 1]) + across
    shapes = center, axis, along, across, order, spacing
    bands = _bands(center[:, 1], extent, spacing)
    return float(spacing * sum(scanline.covered(*shapes, band) for band in bands))


def _bands(height: Floats, extent: Floats, spacing: float) -> Iterator[Band]:
    """First and last line (exclusive) of bands of lines, few enough intervals in each."""
    first, last = (height - extent).min() / spacing, (height + extent).max() / spacing
    count = 2.0 * extent.sum() / spacing
    cuts = np.linspace(first, last + 1.0, 2 + int(count / TOGETHER)).astype(np.int64)
    cuts[0] -= 1
    return pairwise(cuts.tolist())
