"""What the stored shapes of a case say: how far its elements are strained, what the walls keep.

The model holds as long as no element is squeezed below 0.7 of its length, `SQUEEZED`. Its walls
keep their thickness; a wall of incompressible TPU would by then be 1.4 times as thick, which
neither its bending nor its contacts know of. Its law in compression is derived from tension, and
good to 30 % at best. Compared with solid finite elements it was right to 7 % as far as these went,
where the worst element was squeezed to 0.85.
"""

from collections.abc import Mapping

import numpy as np
from numpy.typing import NDArray
from shapely import intersects, linestrings

from kernels.geometry import crossing
from sweep.design.area import covered_area

Floats = NDArray[np.float64]
Frames = Mapping[str, np.ndarray]

SQUEEZED = -0.3  # element strain beyond which a wall is a block
TOGETHER = 1 << 16  # pairs that shapely is asked for at a time


def element_strains(frames: Frames) -> Floats:
    """Nominal strain of every element in every stored shape, (f, m)."""
    x, y = np.ascontiguousarray(frames["position_m"].T)
    start, end = frames["edges"].T
    length = np.sqrt((x[end] - x[start]) ** 2 + (y[end] - y[start]) ** 2).T
    return length / length[0] - 1.0


def work_within_model(strains: Floats, stored: Floats, time: Floats, work: Floats) -> float:
    """Work in J done until an element is squeezed below `SQUEEZED`; all of it if none is.

    strains (f, m): of the elements in the shapes that were stored at the times stored (f,), s.
    time (rows,) s, work (rows,) J: of the loading. Interpolated between stored shapes.
    """
    least = strains.min(axis=1)
    beyond = np.flatnonzero(least < SQUEEZED)
    if len(beyond) == 0:
        return float(work[-1])
    at = slice(beyond[0] - 1, beyond[0] + 1)
    moment = np.interp(-SQUEEZED, -least[at], stored[at])
    return float(np.interp(moment, time, work))


def kept_area(frames: Frames) -> float:
    """Area that the walls cover in the shape of greatest strain, as a share of that at rest.

    NaN where strain has no meaning.
    """
    if np.isnan(frames["strain"]).any():
        return float("nan")
    rest, deepest = frames["position_m"][[0, int(np.argmax(frames["strain"]))]]
    walls = frames["edges"], frames["edge_thickness_m"]
    return covered_area(deepest, *walls) / covered_area(rest, *walls)


def shortening(frames: Frames, bottom: NDArray[np.int64], top: NDArray[np.int64]) -> float:
    """Loss of distance between the middles of two rows of nodes in the last shape / at rest.

    A specimen that has jumped off and turned over has its length still. NaN without rows.
    """
    if len(bottom) == 0:
        return float("nan")
    rest, last = frames["position_m"][[0, -1]]
    height, left = (
        np.linalg.norm(shape[top].mean(axis=0) - shape[bottom].mean(axis=0))
        for shape in (rest, last)
    )
    return float(1.0 - left / height)


def crossings(frames: Frames) -> int:
    """Largest number of pairs of elements that pass through one another in any stored shape.

    Independent of the solver. Where rounding might tell, shapely's exact predicates do.
    """
    position, edges = frames["position_m"], frames["edges"]
    low, high = position.min(axis=0)[edges].min(axis=1), position.max(axis=0)[edges].max(axis=1)
    given = np.ascontiguousarray(position.T), low, high, np.argsort(low[:, 0]), edges
    crossed, unsure = np.empty(len(position), np.int64), np.empty((0, 3), np.int64)
    while (count := crossing.count(*given, crossed, unsure)) > len(unsure):
        unsure = np.empty((count, 3), np.int64)
    for begin in range(0, len(unsure), TOGETHER):
        *pair, shape = unsure[begin : begin + TOGETHER].T
        lines = (linestrings(position[shape[:, None], edges[which]]) for which in pair)
        crossed += np.bincount(shape[intersects(*lines)], minlength=len(crossed))
    return int(crossed.max())
