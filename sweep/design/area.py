"""Area of the union of overlapping shapes.

`united_area` gives the mass of a print (`network.mass`), `covered_area` the area of deformed
shapes.
"""

import numpy as np

from kernels.geometry import scanline, slabs
from sweep.array_types import Floats, Ints

LINES = 16  # scanlines across the thinnest wall: error 3e-4 with many walls, 1e-3 with one wall
CHUNK = 1 << 19  # intervals held in memory at a time
FAR = 1e6  # extent of a shape in thicknesses above which its area is not computed


def united_area(loops: Floats) -> float:
    """Area (m^2) of the union of closed convex polygons (k, c + 1, 2) in m, exact to round-off."""
    loops = loops - loops.min(axis=(0, 1))
    low, high = loops.min(axis=1), loops.max(axis=1)
    order = np.argsort(low[:, 1])
    polygons = loops[order], low[order], high[order]
    heights = np.empty(16 * len(loops))
    while (count := slabs.heights(*polygons, heights)) > len(heights):
        heights = np.empty(count)
    return float(slabs.area(*polygons, np.sort(heights[:count])))


def covered_area(points: Floats, edges: Ints, thickness: Floats) -> float:
    """Area (m^2) of the union of walls with round ends, by scanlines.

    points (n, 2) and thickness (m,) of the elements in m; edges (m, 2): the nodes of each element.
    NaN if a point is NaN or if the shape is larger than `FAR` thicknesses.
    """
    if not np.ptp(points[edges], axis=(0, 1)).max() < FAR * thickness.max():
        return float("nan")
    nodes, places = np.unique(edges, return_inverse=True)  # others may be anywhere
    points, edges = points[nodes], places.reshape(edges.shape)
    return float(scanline.covered_area(points, edges, thickness, LINES, CHUNK))
