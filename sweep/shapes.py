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
from shapely import (
    STRtree,
    area,
    buffer,
    get_parts,
    intersects,
    line_merge,
    linestrings,
    multilinestrings,
    union_all,
)

Floats = NDArray[np.float64]
Frames = Mapping[str, np.ndarray]

SQUEEZED = -0.3  # element strain beyond which a wall is a block
SWEPT = 1 << 14  # elements x shapes whose boxes are joined: small lattices in one go
TOGETHER = 1 << 17  # pairs of boxes that are compared at a time


def element_strains(frames: Frames) -> Floats:
    """Nominal strain of every element in every stored shape, (f, m)."""
    start, end = np.moveaxis(frames["position_m"][:, frames["edges"]], 2, 0)
    length = np.linalg.norm(end - start, axis=-1)
    return length / length[0] - 1.0


def work_within_model(frames: Frames, time: Floats, work: Floats) -> float:
    """Work in J done until an element is squeezed below `SQUEEZED`; all of it if none is.

    time (rows,) s, work (rows,) J: of the loading. Interpolated between stored shapes.
    """
    least = element_strains(frames).min(axis=1)
    beyond = np.flatnonzero(least < SQUEEZED)
    if len(beyond) == 0:
        return float(work[-1])
    at = slice(beyond[0] - 1, beyond[0] + 1)
    moment = np.interp(-SQUEEZED, -least[at], frames["time_s"][at])
    return float(np.interp(moment, time, work))


def kept_area(frames: Frames) -> float:
    """Area that the walls cover in the shape of greatest strain, as a share of that at rest.

    NaN where strain has no meaning.
    """
    if np.isnan(frames["strain"]).any():
        return float("nan")
    rest, deepest = frames["position_m"][[0, int(np.argmax(frames["strain"]))]]
    return _covered(deepest, frames) / _covered(rest, frames)


def _covered(position: Floats, frames: Frames) -> float:
    lines, thickness = linestrings(position[frames["edges"]]), frames["edge_thickness_m"]
    walls = [
        buffer(get_parts(line_merge(multilinestrings(lines[thickness == t]))), 0.5 * t, quad_segs=4)
        for t in np.unique(thickness)
    ]
    return float(area(union_all(np.concatenate(walls))))


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
    ends = frames["position_m"][:, frames["edges"]]
    parts = np.array_split(ends, 1 + ends.shape[0] * ends.shape[1] // SWEPT)
    return max(_most_crossings(part, frames["edges"]) for part in parts if len(part) > 0)


def _most_crossings(ends: Floats, edges: NDArray[np.int64]) -> int:
    """The same of a few shapes; ends (f, m, 2, 2), edges (m, 2)."""
    low, high = ends.min(axis=2), ends.max(axis=2)
    met = _ever_near(low, high)
    nodes = edges[met]
    apart = ~np.any(nodes[:, 0, :, None] == nodes[:, 1, None], axis=(1, 2))
    crossed = np.zeros(len(ends), np.int64)
    for one, two in np.array_split(met[apart].T, 1 + len(met) * len(ends) // TOGETHER, axis=1):
        overlap = (low[:, one] <= high[:, two]) & (low[:, two] <= high[:, one])
        shape, pair = np.nonzero(overlap[..., 0] & overlap[..., 1])
        lines = linestrings(ends[shape, one[pair]]), linestrings(ends[shape, two[pair]])
        crossed += np.bincount(shape[intersects(*lines)], minlength=len(ends))
    return int(crossed.max())


def _ever_near(low: Floats, high: Floats) -> NDArray[np.int64]:
    """Pairs of elements, (k, 2), where the boxes of all that they sweep over overlap.

    low, high (f, m, 2): corners of the box of every element in every shape.
    """
    swept = linestrings(np.stack([low.min(axis=0), high.max(axis=0)], axis=1))
    one, two = STRtree(swept).query(swept)
    return np.column_stack([one, two])[one < two]
