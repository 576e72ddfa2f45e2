"""Square grid. Closed forms of its counts and its opening avoid a drawing."""

from collections.abc import Sequence

from sweep.design.infill import Drawing, tile

CELL = [(0, 0), (1, 0), (1, 1), (0, 1), (0, 0)]


def draw(columns: Sequence[int], rows: Sequence[int]) -> Drawing:
    """Squares of side 1."""
    return [tile(CELL, columns, rows)]


def counts(columns: int, rows: int) -> tuple[int, int]:
    """Numbers of joints and walls."""
    return (columns + 1) * (rows + 1), columns * (rows + 1) + rows * (columns + 1)


def opening(width: float, height: float) -> float:
    """Clear width of cells of this width and height."""
    return min(width, height)
