"""Area that walls with round ends cover together, however they overlap."""

import numpy as np
from numpy.typing import NDArray

from kernels import scanline

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]

LINES = 16  # within the thinnest wall: an error of 3e-4 where walls are many, 1e-3 for one of them
TOGETHER = 1 << 19  # intervals that are in memory at a time


def covered_area(points: Floats, edges: Ints, thickness: Floats) -> float:
    """Area in m^2, NaN where a point is. points (n, 2) and thickness (m,) of the elements in m.

    edges (m, 2): the nodes of each element.
    """
    if not np.isfinite(points).all():
        return float("nan")
    return float(scanline.covered_area(points, edges, thickness, LINES, TOGETHER))
