"""Auxetic honeycomb: staggered rows of bow ties, which become narrower under compression.

Vertical walls are twice as long as the inclined ones, which rise by 30 degrees.
"""

from collections.abc import Sequence

from sweep.design.infill import Drawing, tile

ORIENTED = True
STAGGERED = True
HALF = 0.75**0.5  # half of the width of a cell whose inclined walls have length 1
CELL = [(0, 0), (HALF, 0.5), (2 * HALF, 0), (2 * HALF, 2), (HALF, 1.5), (0, 2), (0, 0)]


def draw(columns: Sequence[int], rows: Sequence[int]) -> Drawing:
    """Cells whose upper and lower corners point inwards, with inclined walls of length 1."""
    return [tile(CELL, columns, rows, (2 * HALF, 1.5), stagger=0.5)]
