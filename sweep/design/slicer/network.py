"""The network that a slicer prints: infill within a box of perimeters, and its extruded area.

A joint of the pattern is in the middle of the box, or a cell of the honeycomb; slicers place the
pattern otherwise. Joints nearer to one another than a line are one, and so are those between which
less than a line is open beside the perimeters.
"""

from functools import lru_cache
from math import ceil, cos, hypot, isclose, sin

import numpy as np

from sweep.design.drawing import (
    TOLERANCE,
    Floats,
    Indices,
    clipped,
    on_outline,
    segments_of,
    welded,
    with_outline,
)
from sweep.design.geometry import Geometry
from sweep.design.infill import drawer
from sweep.design.network import Network
from sweep.design.slicer.patterns import PATTERNS, Sliced, distance_of

LEAST_SHARE = 0.01  # of infill, tried for a mass
CLOSE = 5e-3  # relative error allowed in a mass, where lines appear all at once


def build_sliced(geometry: Geometry) -> Network:
    """The infill cut at the perimeters and joined to them."""
    sliced, box = _sliced(geometry), np.array(geometry.box)
    lines = with_outline(infill(sliced, geometry.box), box, [True, True])
    points, walls = _merged(lines, box, sliced.line, 0.5 * max(geometry.outline))
    thickness = np.full(len(walls), geometry.wall_thickness)
    gyration = np.full(len(walls), PATTERNS[sliced.pattern].gyration)
    for axis, outline in enumerate(geometry.outline):
        for side in (0.0, box[axis]):
            on = on_outline(points, walls, side, axis)
            thickness[on], gyration[on] = outline, 1.0
    y = points[:, 1]
    bottom, top = np.flatnonzero(y == y.min()), np.flatnonzero(y == y.max())
    return Network(points, walls, thickness, bottom, top, gyration=gyration)


def extruded_area(geometry: Geometry) -> float:
    """What is extruded / depth, m^2: lines of infill, crossings twice, and perimeters."""
    sliced, (width, height) = _sliced(geometry), geometry.box
    inner = infill(sliced, geometry.box) - sliced.inset
    room = np.array(geometry.box) - 2.0 * sliced.inset
    lines = clipped(inner, room, [True, True])
    length = np.linalg.norm(lines[:, 1] - lines[:, 0], axis=1).sum()
    sides, caps = geometry.outline
    return float(sliced.extruded * length + 2.0 * (sides * height + caps * width))


@lru_cache(maxsize=256)
def infill(sliced: Sliced, box: tuple[float, float]) -> Floats:
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
    points, walls = welded(segments_of(drawer(family, _upright(family))(cells, cells)), TOLERANCE)
    return np.asarray(points[walls])


def _upright(family: str) -> str | None:
    return "pointy" if family == "hex" else None


def _merged(segments: Floats, box: Floats, line: float, half: float) -> tuple[Floats, Indices]:
    """Joints (j, 2) and walls (w, 2), none shorter than a ``line``, with ``half`` the thickness of
    the outline added beside it; all in m.

    The joints of shorter walls become one: at a corner or on the outline if one of them is there,
    else in the middle of them.
    """
    tolerance = TOLERANCE * box.max()
    points, walls = welded(segments, tolerance)
    for _ in range(len(walls)):
        ends = points[walls]
        length = np.linalg.norm(ends[:, 1] - ends[:, 0], axis=1)
        beside = np.any((ends == 0.0) | (ends == box), axis=(1, 2))
        short = length < (1.0 - TOLERANCE) * (line + half * beside)
        if not short.any():
            break
        ends = _joined(points, walls[short], box)[walls]
        points, walls = welded(ends[np.any(ends[:, 0] != ends[:, 1], axis=1)], tolerance)
    return points, walls


def _joined(points: Floats, short: Indices, box: Floats) -> Floats:
    """The points with both ends of ``short`` walls (k, 2) at one place."""
    from scipy.sparse import coo_array
    from scipy.sparse.csgraph import connected_components

    graph = coo_array((np.ones(len(short)), short.T), shape=(len(points),) * 2)
    count, group = connected_components(graph, directed=False)
    sides = (points == 0.0) | (points == box)
    fixed = sides.sum(axis=1)  # 2: a corner, 1: on a side
    most = np.zeros(count, np.int64)
    np.maximum.at(most, group, fixed)
    leads = fixed == most[group]
    mean = np.empty((count, 2))
    for axis in (0, 1):
        total = np.bincount(group[leads], points[leads, axis], count)
        mean[:, axis] = total / np.bincount(group[leads], minlength=count)
    single = np.bincount(group, minlength=count) == 1
    placed = mean[group]
    for side in (np.zeros(2), box):  # means of equal numbers may differ from them by round-off
        placed = np.where(np.abs(placed - side) < TOLERANCE * box.max(), side, placed)
    return np.where(single[group][:, None], points, placed)


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


def _sliced(geometry: Geometry) -> Sliced:
    if geometry.sliced is None:
        raise ValueError("a lattice without a slicer has no lines")
    return geometry.sliced
