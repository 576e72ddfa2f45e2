"""Grid at 45 degrees, clipped by the box: diamonds whose corners touch its sides."""

from collections.abc import Sequence

from sweep.design.infill import Drawing, tile

CELL = [(0.5, 0), (1, 0.5), (0.5, 1), (0, 0.5), (0.5, 0)]


def draw(columns: Sequence[int], rows: Sequence[int]) -> Drawing:
    """Diamonds of width and height 1; the gaps between them are diamonds too."""
    return [tile(CELL, columns, rows)]
