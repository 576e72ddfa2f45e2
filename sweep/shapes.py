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
from shapely import STRtree, area, buffer, linestrings, union_all

Floats = NDArray[np.float64]
Frames = Mapping[str, np.ndarray]

SQUEEZED = -0.3  # element strain beyond which a wall is a block


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
    """Area that the walls cover in the shape of greatest strain, as a share of that at rest."""
    rest, deepest = frames["position_m"][[0, int(np.argmax(frames["strain"]))]]
    return _covered(deepest, frames) / _covered(rest, frames)


def _covered(position: Floats, frames: Frames) -> float:
    lines = linestrings(position[frames["edges"]])
    walls = buffer(lines, 0.5 * frames["edge_thickness_m"], quad_segs=4)
    return float(area(union_all(walls)))


def shortening(frames: Frames, bottom: NDArray[np.int64], top: NDArray[np.int64]) -> float:
    """Loss of distance between the middles of two rows of nodes in the last shape / at rest.

    A specimen that has jumped off and turned over has its length still.
    """
    rest, last = frames["position_m"][[0, -1]]
    height, left = (
        np.linalg.norm(shape[top].mean(axis=0) - shape[bottom].mean(axis=0))
        for shape in (rest, last)
    )
    return float(1.0 - left / height)


def crossings(frames: Frames) -> int:
    """Largest number of pairs of elements that pass through one another in any stored shape.

    Independent of the solver: shapely's exact predicates on the centre lines.
    """
    edges = frames["edges"]
    worst = 0
    for position in frames["position_m"]:
        lines = linestrings(position[edges])
        one, two = STRtree(lines).query(lines, predicate="intersects")
        apart = (one < two) & ~np.any(edges[one][:, :, None] == edges[two][:, None, :], axis=(1, 2))
        worst = max(worst, int(apart.sum()))
    return worst
