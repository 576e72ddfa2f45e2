"""Square grid."""

from collections.abc import Sequence

from sweep.infill import Drawing, tile

CELL = [(0, 0), (1, 0), (1, 1), (0, 1), (0, 0)]


def draw(columns: Sequence[int], rows: Sequence[int]) -> Drawing:
    """Squares of side 1."""
    return [tile(CELL, columns, rows)]
