"""The network that a slicer prints: infill within a box of perimeters, and its extruded area.

A joint of the pattern, or a cell of the honeycomb, is in the middle of the box; slicers place the
pattern elsewhere.
"""

from functools import lru_cache
from math import ceil, cos, hypot, isclose, sin

import numpy as np

from sweep.array_types import Floats
from sweep.design.drawing import TOLERANCE, clipped, on_outline, outer_rows, segments_of, welded
from sweep.design.geometry import Geometry
from sweep.design.infill import drawer
from sweep.design.network import Network
from sweep.design.slicer.joining import joined
from sweep.design.slicer.patterns import PATTERNS, InfillLines, distance_of

LEAST_SHARE = 0.01  # least share of infill tried for a mass
CLOSE = 5e-3  # relative error allowed in a mass, where lines appear all at once


def build_sliced(geometry: Geometry) -> Network:
    """The infill cut at the perimeters and joined to them."""
    sliced, box = _sliced(geometry), np.array(geometry.box)
    least = sliced.line + 0.5 * max(geometry.outline)
    points, walls = joined(infill(sliced, geometry.box), box, least, sliced.distance)
    thickness = sliced.line * _thickness(sliced, points[walls])
    gyration = np.full(len(walls), PATTERNS[sliced.pattern].gyration)
    for axis, outline in enumerate(geometry.outline):
        for side in (0.0, box[axis]):
            on = on_outline(points, walls, side, axis)
            thickness[on], gyration[on] = outline, 1.0
    return Network(points, walls, thickness, *outer_rows(points), gyration=gyration)


def extruded_area(geometry: Geometry) -> float:
    """Extruded volume / depth, m^2: lines of infill, crossings twice, and perimeters."""
    (width, height), (sides, caps) = geometry.box, geometry.outline
    lines = infill(_sliced(geometry), geometry.box)
    return _area(geometry, lines) + 2.0 * (sides * height + caps * width)


def drawn_over_extruded(network: Network, geometry: Geometry) -> float:
    """The volume that would be extruded if the lines lay as the walls of a network, over the
    extruded volume.

    0 if the network is not as large as its box.
    """
    points, walls, thickness = network.points, network.walls, network.wall_thickness
    if np.abs(np.ptp(points, axis=0) - geometry.box).max() > TOLERANCE * max(geometry.box):
        return 0.0
    sides = [(side, axis) for axis, size in enumerate(geometry.box) for side in (0.0, size)]
    outer = np.any([on_outline(points, walls, *side) for side in sides], axis=0)
    along = float(network.length[outer] @ thickness[outer])
    drawn = _area(geometry, points[walls[~outer]]) + along
    return drawn / extruded_area(geometry)


def _area(geometry: Geometry, lines: Floats) -> float:
    """Volume extruded along the parts of lines (s, 2, 2) that are infill / depth, m^2."""
    sliced = _sliced(geometry)
    inset = np.array(sliced.inset)
    inside = clipped(lines - inset, geometry.box - 2.0 * inset, [True, True])
    thickness = _thickness(sliced, inside) - PATTERNS[sliced.pattern].corners * sliced.share
    return sliced.line * float(np.linalg.norm(inside[:, 1] - inside[:, 0], axis=1) @ thickness)


def _thickness(sliced: InfillLines, ends: Floats) -> Floats:
    """Thickness of walls (w, 2, 2) of the infill over what the lines of one fill, (w,).

    Where layers are stacked up the drawing it is the cosine of the slope of the pattern that is
    nearest to the one of the wall.
    """
    pattern = PATTERNS[sliced.pattern]
    if not pattern.slopes:
        return np.full(len(ends), pattern.wall)
    across, up = np.abs(ends[:, 1] - ends[:, 0]).T
    slopes = np.array(pattern.slopes)
    nearest = np.abs(np.arctan2(across, up)[:, None] - slopes).argmin(axis=1)
    return np.asarray(np.cos(slopes[nearest]))


@lru_cache(maxsize=256)
def infill(sliced: InfillLines, box: tuple[float, float]) -> Floats:
    """The centre lines of a pattern round the middle of a box and beyond it, (s, 2, 2) m."""
    pattern, half = PATTERNS[sliced.pattern], 0.5 * np.array(box)
    unit = pattern.side * sliced.distance
    reach = ceil(hypot(*half) / (0.75**0.5 * unit)) + 2
    drawn = _unturned(pattern.family, reach)
    drawn = unit * (drawn - pattern.middle)
    angle = sliced.angle + pattern.turn
    turn = np.array([[cos(angle), sin(angle)], [-sin(angle), cos(angle)]])
    lines: Floats = drawn @ turn + half
    lines.flags.writeable = False
    return lines


@lru_cache(maxsize=64)
def _unturned(family: str, reach: int) -> Floats:
    """All segments of ``reach`` cells on each side of the origin, in the unit of the family."""
    if not family:
        y = np.arange(-reach, reach + 1.0)
        ends = np.array([-2.0, 2.0]) * reach
        return np.stack([np.column_stack([np.full_like(y, x), y]) for x in ends], axis=1)
    cells = range(-reach, reach + 1)
    draw = drawer(family, "pointy" if family == "hex" else None)
    points, walls = welded(segments_of(draw(cells, cells)), TOLERANCE)
    return np.asarray(points[walls])


@lru_cache(maxsize=1024)
def share_for(geometry: Geometry, area: float, most: float) -> tuple[float, float, float]:
    """Share of infill with which ``area`` (m^2) is extruded, and the least and greatest area.

    most: the greatest share that leaves openings. NaN if no share gives the area: out of bounds, or
    where lines along a side appear all at once.
    """
    from scipy.optimize import brentq

    sliced = _sliced(geometry)

    def excess(share: float) -> float:
        distance = distance_of(sliced.pattern, share, sliced.line)
        return extruded_area(geometry._replace(sliced=sliced._replace(distance=distance))) - area

    light, heavy = excess(LEAST_SHARE), excess(most)
    share = float("nan")
    if light < 0.0 < heavy:
        share = brentq(excess, LEAST_SHARE, most, xtol=1e-13)
        if not isclose(excess(share) + area, area, rel_tol=CLOSE):
            share = float("nan")
    return share, light + area, heavy + area


def _sliced(geometry: Geometry) -> InfillLines:
    if geometry.sliced is None:
        raise ValueError("a lattice without a slicer has no lines")
    return geometry.sliced
