"""Area that shapes cover together, however they overlap."""

import numpy as np
from numpy.typing import NDArray

from kernels.geometry import scanline, slabs

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]

LINES = 16  # within the thinnest wall: an error of 3e-4 where walls are many, 1e-3 for one of them
TOGETHER = 1 << 19  # intervals that are in memory at a time
FAR = 1e6  # thicknesses: what has flown apart so far is no shape any more


def united_area(loops: Floats) -> float:
    """Area of the union of convex polygons (k, c + 1, 2) in m, closed, exact but for rounding."""
    loops = loops - loops.min(axis=(0, 1))
    low, high = loops.min(axis=1), loops.max(axis=1)
    order = np.argsort(low[:, 1])
    polygons = loops[order], low[order], high[order]
    found = np.empty(16 * len(loops))
    while (count := slabs.heights(*polygons, found)) > len(found):
        found = np.empty(count)
    return float(slabs.area(*polygons, np.sort(found[:count])))


def covered_area(points: Floats, edges: Ints, thickness: Floats) -> float:
    """Area of walls with round ends in m^2, by scanlines; NaN where a point is, or `FAR` away.

    points (n, 2) and thickness (m,) of the elements in m; edges (m, 2): the nodes of each element.
    """
    if not np.ptp(points[edges], axis=(0, 1)).max() < FAR * thickness.max():
        return float("nan")
    return float(scanline.covered_area(points, edges, thickness, LINES, TOGETHER))
