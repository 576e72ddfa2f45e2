"""Honeycomb: staggered rows of hexagons with a corner upwards; "flat": with a side upwards."""

from collections.abc import Sequence

from sweep.design.infill import Drawing, tile

ORIENTED = True
STAGGERED = True
HALF = 0.75**0.5  # half of the width of a hexagon of side 1
CELL = [(0, 0.5), (HALF, 0), (2 * HALF, 0.5), (2 * HALF, 1.5), (HALF, 2), (0, 1.5), (0, 0.5)]


def draw(columns: Sequence[int], rows: Sequence[int]) -> Drawing:
    """Regular hexagons of side 1: width (columns + 1/2) pitches, height 1.5 rows + 0.5."""
    return [tile(CELL, columns, rows, (2 * HALF, 1.5), stagger=0.5)]
