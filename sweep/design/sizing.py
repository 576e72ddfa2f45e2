"""Finds the cells for a share of infill or for a size, and the wall thickness for a mass."""

from functools import lru_cache
from math import log

import numpy as np

from sweep.design.box import infill_walls
from sweep.design.drawing import FEW, extent, pitch, sketch
from sweep.design.geometry import THIN, Geometry
from sweep.design.infill import trait
from sweep.design.lattice import build_network
from sweep.design.network import mass

SLACK = 1 / 3  # relative error allowed in a share: one or two cells differ by as much
CLOSE = 1e-14  # tolerance, as a share of the greatest mass


def infill_share(geometry: Geometry) -> float:
    """Share of the box that lines fill, as slicers count: length x thickness, crossings twice.

    The box is measured over centre lines; an outline does not count as infill.
    """
    (length, _), (width, height) = infill_walls(geometry), geometry.box
    return float(length.sum()) * geometry.wall_thickness / (width * height)


def cells_for(geometry: Geometry, share: float, most: int) -> tuple[int, int] | None:
    """Columns and rows, nearly regular, whose lines fill the share nearest to ``share``.

    None if a single cell fills too much, or if more than ``most`` cells are needed.
    """
    width, height = pitch(geometry.kind, geometry.orientation)
    beside = geometry.box[0] / geometry.box[1] * height / width

    def cells(rows: int) -> tuple[int, int]:
        return max(1, round(rows * beside)), rows

    def filled(rows: int) -> float:
        return infill_share(geometry._replace(cells=cells(rows)))

    def missed(rows: int) -> float:
        return abs(filled(rows) - share)

    few, more = filled(FEW), filled(FEW + 2)
    guess = FEW + round(2 * (share - few) / (more - few))
    near = range(max(1, guess - 2), max(1, guess) + 3)
    if near[-1] * cells(near[-1])[0] > most:
        return None
    best = min(near, key=missed)
    return cells(best) if missed(best) <= SLACK * share else None


def cell_of(geometry: Geometry) -> tuple[float, float]:
    """Width and height of a cell in the box, m."""
    low, high = extent(geometry.kind, geometry.orientation, geometry.cells)
    box = np.array(sketch(geometry).box)
    width, height = pitch(geometry.kind, geometry.orientation) * box / (high - low)
    return float(width), float(height)


def cells_of_size(geometry: Geometry, size: float, most: int) -> tuple[int, int] | None:
    """Columns and rows whose cells come nearest to a regular cell of width ``size`` (m).

    Nearest in each direction, by the ratio of the lengths. None if the only cell in a direction is
    smaller than that by more than `SLACK`, or if more than ``most`` cells are needed.
    """
    shape = pitch(geometry.kind, geometry.orientation)
    width, height = (float(side) for side in size * shape / shape[0])
    columns, rows = geometry.box[0] / width, geometry.box[1] / height
    if round(columns) * round(rows) > most:
        return None
    cells = _nearest(geometry, 0, columns, width), _nearest(geometry, 1, rows, height)
    cell = cell_of(geometry._replace(cells=cells))
    fits = cell[0] > (1.0 - SLACK) * width and cell[1] > (1.0 - SLACK) * height
    return cells if fits else None


def _nearest(geometry: Geometry, axis: int, count: float, side: float) -> int:
    """The number of cells, near ``count``, whose length along an axis is nearest to ``side`` (m).

    It is even if the lattice repeats and its pattern does so every two cells.
    """
    shifted = trait(geometry.kind, "STAGGERED") and axis == (geometry.orientation != "flat")
    step = 2 if geometry.periodic[axis] and shifted else 1
    middle = step * round(count / step)

    def missed(n: int) -> float:
        return abs(log(cell_of(geometry._replace(cells=(n, n)))[axis] / side))

    near = range(middle - 2 * step, middle + 3 * step, step)
    return min((n for n in near if n >= step), key=missed)


@lru_cache(maxsize=4096)
def thickness_for(
    geometry: Geometry, target: float, thickest: float, depth: float, density: float
) -> tuple[float, float, float]:
    """Wall thickness (m) for a mass (kg), and the least and greatest possible mass.

    ``thickest``: the greatest allowed thickness, m. Regula falsi (Illinois) on the exact mass. The
    thickness is NaN if the mass is out of these bounds.
    """

    def weight(thickness: float) -> float:
        return mass(build_network(geometry._replace(wall_thickness=thickness)), depth, density)

    high = thickest
    low = THIN * high
    light, heavy = weight(low), weight(high)
    if not light < target < heavy:
        return float("nan"), light, heavy
    below, above = light - target, heavy - target
    middle = low
    for _ in range(60):
        middle = (low * above - high * below) / (above - below)
        excess = weight(middle) - target
        if abs(excess) <= CLOSE * heavy:
            break
        if excess < 0.0:
            low, below, above = middle, excess, 0.5 * above
        else:
            high, above, below = middle, excess, 0.5 * below
    return middle, light, heavy
