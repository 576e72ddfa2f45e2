"""Triangles in rows between horizontal lines; the sides of the lattice are zigzags."""

from collections.abc import Sequence

from sweep.design.infill import Drawing, tile

STAGGERED = True
RISE = 0.75**0.5  # height of a regular triangle of side 1
UP = [(0, 0), (1, 0), (0.5, RISE), (0, 0)]
DOWN = [(0, RISE), (1, RISE), (0.5, 0), (0, RISE)]
TIE = [(0.5, 0), (1.5, 0)]


def draw(columns: Sequence[int], rows: Sequence[int]) -> Drawing:
    """Rows of triangles with a corner upwards and downwards in turn; free corners are joined."""
    pitch = (1.0, RISE)
    even, odd = ([row for row in rows if row % 2 == parity] for parity in (0, 1))
    tied = sorted({*odd, *(row + 1 for row in even)})
    return [
        tile(UP, columns, even, pitch),
        tile(DOWN, columns, odd, pitch),
        tile(TIE, columns[:-1], tied, pitch),
    ]
