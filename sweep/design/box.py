"""The infill of a box: walls cut at an outline, graded thickness, clear width of the cells."""

from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from sweep.array_types import Floats, Ints
from sweep.design.drawing import Sketch, joints_and_walls, on_outline, outer_rows, sample, sketch
from sweep.design.geometry import Geometry
from sweep.design.network import Network


def build_box(geometry: Geometry) -> Network:
    """The infill stretched to the box; an outline cuts the infill and is joined to it."""
    points, walls = joints_and_walls(sketch(geometry))
    thickness = np.full(len(walls), geometry.wall_thickness)
    if geometry.grading != 1.0:
        thickness *= gradient(geometry)
    for on, outline in _outlines(geometry, points, walls):
        thickness[on] = outline
    thickness.flags.writeable = False
    return Network(points, walls, thickness, *outer_rows(points))


def infill_walls(geometry: Geometry) -> tuple[Floats, Floats]:
    """Length (w,) of every wall in m, and the height of its middle / height of the box, (w,).

    Walls of the outline get length 0.
    """
    points, walls = joints_and_walls(sketch(geometry))
    ends = points[walls]
    length = np.linalg.norm(ends[:, 1] - ends[:, 0], axis=1)
    for on, _ in _outlines(geometry, points, walls):
        length[on] = 0.0
    return length, ends[..., 1].mean(axis=1) / geometry.box[1]


def gradient(geometry: Geometry) -> Floats:
    """Thickness of every wall / the mean thickness of the infill, weighted by length, (w,).

    The thickness is linear in the height of the wall's middle; `grading` is its value at the top
    over its value at the bottom.
    """
    length, height = infill_walls(geometry)
    share = 1.0 + (geometry.grading - 1.0) * height
    return share / np.average(share, weights=length) if length.any() else share


def _outlines(
    geometry: Geometry, points: Floats, walls: Ints
) -> list[tuple[NDArray[np.bool_], float]]:
    """For each side with an outline: which walls lie on it (w,), and their thickness."""
    outlines = []
    for axis, thickness in enumerate(geometry.outline):
        if thickness > 0.0:
            for side in (0.0, geometry.box[axis]):
                outlines.append((on_outline(points, walls, side, axis), thickness))
    return outlines


def opening(geometry: Geometry) -> float:
    """Clear width (m) of the narrowest whole cell: the diameter of the largest inscribed circle.

    It is measured between centre lines.
    """
    return _opening(sketch(geometry, outlined=False))


@lru_cache(maxsize=256)
def _opening(drawn: Sketch) -> float:
    points, walls = joints_and_walls(sample(drawn))
    return float(clear_widths(points, walls).min())


def clear_widths(points: Floats, walls: Ints) -> Floats:
    """Diameter (m) of the largest circle in each cell between walls, with equal cells counted
    once.
    """
    import shapely  # few sweeps need it

    cells = shapely.get_parts(shapely.polygonize(shapely.linestrings(points[walls])))
    size = np.column_stack([shapely.area(cells), shapely.length(cells)])
    scale = size[:, 1].max(initial=0.0) ** np.array([2, 1])
    _, differing = np.unique((size / scale).round(7), axis=0, return_index=True)
    tolerance = 1e-6 * np.ptp(points, axis=0).max()
    radii = shapely.maximum_inscribed_circle(cells[differing], tolerance)
    return np.asarray(2.0 * shapely.length(radii))
