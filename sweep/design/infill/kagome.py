"""Kagome: triangles and hexagons between straight lines in three directions."""

from collections.abc import Sequence

from sweep.design.infill import Drawing, tile

STAGGERED = True
RISE = 0.75**0.5  # height of a regular triangle of side 1
HOURGLASS = [(0, 0), (1, 0), (0.5, RISE), (1, 2 * RISE), (0, 2 * RISE), (0.5, RISE), (0, 0)]
TIES = ([(1, 0), (2, 0)], [(1, 2 * RISE), (2, 2 * RISE)])


def draw(columns: Sequence[int], rows: Sequence[int]) -> Drawing:
    """Staggered rows of hourglasses, joined to their neighbours at the top and the bottom."""
    pitch = (2.0, 2 * RISE)
    ties = [tile(tie, columns[:-1], rows, pitch, stagger=0.5) for tie in TIES]
    return [tile(HOURGLASS, columns, rows, pitch, stagger=0.5), *ties]
