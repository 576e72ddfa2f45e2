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
from shapely import STRtree, intersects, linestrings

from sweep.cover import covered_area

Floats = NDArray[np.float64]
Frames = Mapping[str, np.ndarray]

SQUEEZED = -0.3  # element strain beyond which a wall is a block
SWEPT = 1 << 14  # elements x shapes whose boxes are joined: small lattices in one go
TOGETHER = 1 << 15  # pairs of boxes that are compared at a time: more leave the cache


def element_strains(frames: Frames) -> Floats:
    """Nominal strain of every element in every stored shape, (f, m)."""
    start, end = np.moveaxis(frames["position_m"][:, frames["edges"]], 2, 0)
    axis = end - start
    length = np.hypot(axis[..., 0], axis[..., 1])
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

    Independent of the solver: shapely's exact predicates on the centre lines, asked only of
    elements without a common node whose boxes overlap.
    """
    ends = np.ascontiguousarray(frames["position_m"].T)[:, frames["edges"]]
    parts = np.array_split(ends, 1 + ends[0, :, 0].size // SWEPT, axis=-1)
    return max(_most_crossings(part, frames["edges"]) for part in parts if part.size > 0)


def _most_crossings(ends: Floats, edges: NDArray[np.int64]) -> int:
    """The same of a few shapes; ends (2, m, 2, f): x and y of both ends, edges (m, 2)."""
    low, high = np.minimum(*(sides := np.moveaxis(ends, 2, 0))), np.maximum(*sides)
    near = _ever_near(low, high)
    start, end = np.moveaxis(edges[near], 2, 0)
    shared = (start[:, 0] == start[:, 1]) | (end[:, 0] == end[:, 1])
    shared |= (start[:, 0] == end[:, 1]) | (end[:, 0] == start[:, 1])
    crossed = np.zeros(ends.shape[-1], np.int64)
    apart = near[~shared].T
    for one, two in np.array_split(apart, 1 + low[0, apart[0]].size // TOGETHER, axis=1):
        overlap = (low[:, one] <= high[:, two]) & (low[:, two] <= high[:, one])
        pair, shape = np.nonzero(overlap[0] & overlap[1])
        lines = (np.swapaxes(ends[:, which[pair], :, shape], 1, 2) for which in (one, two))
        crossed += np.bincount(shape[intersects(*map(linestrings, lines))], minlength=len(crossed))
    return int(crossed.max())


def _ever_near(low: Floats, high: Floats) -> NDArray[np.int64]:
    """Pairs of elements, (k, 2), where the boxes of all that they sweep over overlap.

    low, high (2, m, f): corners of the box of every element in every shape.
    """
    swept = linestrings(np.stack([low.min(axis=2), high.max(axis=2)]).transpose(2, 0, 1))
    one, two = STRtree(swept).query(swept)
    return np.column_stack([one, two])[one < two]
