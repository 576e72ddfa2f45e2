"""A lattice that repeats: the walls of one period, and copies of the walls that they may touch.

It repeats in x and y without end; or in x alone, and begins and ends in y as the infill of a box
does. No wall passes through another, so two walls can only touch if they border the same opening.
Therefore only the walls round the openings next to the period are copied, at any strain.
"""

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from sweep.array_types import Floats, Ints
from sweep.design.drawing import (
    SPILL,
    TOLERANCE,
    Flags,
    distinct,
    extent,
    outer_rows,
    segments_of,
    sketch,
    welded,
)
from sweep.design.geometry import Geometry
from sweep.design.infill import drawer
from sweep.design.network import Network

REACH = 1.5  # pitches: no opening of any family is wider or higher
FAR = 3  # periods: distance of the farthest copy within reach of a period of one cell


@dataclass(frozen=True)
class Endless(Network):
    """The walls of a period, then copies of walls, in the direction of their originals.

    period (2,): width and height in m. repeats (2,): whether it repeats in x and in y. own: number
    of walls of the period. original (w,): the wall of the period that each wall copies. origin
    (j,): the joint of the period that each joint is or copies; shift (j, 2): by how many periods it
    is moved in x and y. The joints of the period come first. bottom, top: the rows of the period;
    if it repeats in y, a joint, and its image one period above.
    """

    period: Floats
    repeats: Flags
    own: int
    original: Ints
    origin: Ints
    shift: Ints

    @cached_property
    def printed_area(self) -> float:
        """Area of the walls within one period, m^2."""
        from sweep.design.area import united_area  # the import loads the kernels

        walls = self.loops
        low = np.where(self.repeats, 0.0, walls.min(axis=(0, 1)))
        size = np.where(self.repeats, self.period, walls.max(axis=(0, 1)) - low)
        box = low + np.array([[0, 0], [1, 0], [1, 1], [0, 1], [0, 0]]) * size
        inside = float(np.prod(size))
        return united_area(walls) + inside - united_area(np.concatenate([walls, [box]]))

    def copied(self, inside: Ints) -> tuple[Ints, Ints]:
        """For each joint, then each of the ``inside`` (w,) places inside the walls, wall by wall:
        itself or the place that it copies, (n,), and by how many periods it is moved, (n, 2).
        """
        first = len(self.points) + np.cumsum(inside) - inside
        wall = np.repeat(np.arange(len(inside)), inside)
        number = len(self.points) + np.arange(len(wall)) - first[wall]
        origin = np.concatenate([self.origin, first[self.original[wall]] + number])
        return origin, np.concatenate([self.shift, self.shift[self.walls[wall, 0]]])


def own_parts(network: Network) -> tuple[int, int]:
    """Numbers of joints and of walls of one period."""
    assert isinstance(network, Endless)
    return int(network.origin.max()) + 1, network.own


def build_period(geometry: Geometry) -> Endless:
    """The lattice that repeats ``geometry``."""
    period, cells, repeats = np.array(geometry.box), geometry.cells, np.array(geometry.periodic)
    points, ends, shift = _walls(geometry, period)
    far, up = FAR * repeats
    away = np.mgrid[-far : far + 1, -up : up + 1].reshape(2, -1).T
    middle = 0.5 * (points[ends].sum(axis=1) + shift * period)
    copied, reach = middle + away[:, None] * period, REACH * period / cells
    near = (copied >= middle.min(axis=0) - reach) & (copied <= middle.max(axis=0) + reach)
    copy, of = np.nonzero(np.all(near, axis=2) & np.any(away, axis=1, keepdims=True))
    original = np.concatenate([np.arange(len(ends)), of])
    start = np.concatenate([np.zeros_like(shift), away[copy]])
    end = np.column_stack([start + shift[original], ends[original, 1]])
    start = np.column_stack([start, ends[original, 0]])
    named, joint = np.unique(np.concatenate([start, end]), axis=0, return_inverse=True)
    order = np.argsort(named[:, :2].any(axis=1), kind="stable")
    shift, origin = named[order, :2], named[order, 2]
    if repeats[1]:
        top = np.flatnonzero((shift == (0, 1)).all(axis=1))[:1]
        bottom = origin[top]
    else:
        bottom, top = outer_rows(points)
    return Endless(
        points=points[origin] + shift * period,
        walls=np.argsort(order)[joint].reshape(2, -1).T,
        wall_thickness=np.full(len(original), geometry.wall_thickness),
        bottom=bottom,
        top=top,
        period=period,
        repeats=repeats,
        own=len(ends),
        original=original,
        origin=origin,
        shift=shift,
    )


def _walls(geometry: Geometry, period: Floats) -> tuple[Floats, Ints, Ints]:
    """Joints and walls of one period.

    Joints (j, 2) in m from the lower left corner; the two joints of each wall (w, 2); by how many
    periods the second joint is moved in x and y, (w, 2).
    """
    drawn = sketch(geometry)
    low, high = extent(drawn.kind, drawn.orientation, drawn.cells)
    repeats = np.array(geometry.periodic)
    columns, rows = (
        range(-spill, n + spill) for n, spill in zip(drawn.cells, 2 * SPILL * repeats, strict=True)
    )
    segments = segments_of(drawer(drawn.kind, drawn.orientation)(columns, rows))
    tolerance = TOLERANCE * period.max()
    points, walls = welded((segments - low) * (np.array(drawn.box) / (high - low)), tolerance)
    ends = points[walls]
    middle = ends.mean(axis=1)
    within = (middle >= -tolerance) & (middle < period - tolerance)
    ends = ends[np.all(within | ~repeats, axis=1)]
    shift = np.floor((ends + tolerance) / period).astype(np.int64) * repeats
    phase = ends - shift * period
    return *distinct(phase, tolerance), shift[:, 1] - shift[:, 0]
