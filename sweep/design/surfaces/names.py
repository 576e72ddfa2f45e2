"""The sheets that can be printed: their area, and where a panel may be cut.

A panel ends where the surface meets its faces steeply, so that the sheet can be held there: at
whole numbers of `Cut.step` from `Cut.start`. No numpy here, as every config reads this.
"""

from math import sqrt
from typing import NamedTuple

ROOT = sqrt(2.0)


class Cut(NamedTuple):
    """Faces of a panel. start: of the lower one; step: of others above it; across, along: periods
    in its plane; all in periods of the surface.
    """

    start: float
    step: float
    across: float = 1.0
    along: float = 1.0


class SheetName(NamedTuple):
    """A sheet. In a period, from a net of 24 quads: area, in units of the squared period; steep:
    mean of |n_xy|, n its unit normal.

    straight: a panel that is pressed along one of the axes of the surface, which are all
    equivalent. turned: pressed along (1, 1, 0), the other axes of the panel are (1, -1, 0) and z.
    corner: of a block of whole halves of a period along these axes, in periods: all of its faces
    meet the surface steeply, and its corners are far from it.
    """

    area: float
    steep: float
    straight: Cut
    turned: Cut
    corner: tuple[float, float, float]

    def cut(self, turned: bool) -> Cut:
        """Where a panel is cut from it."""
        return self.turned if turned else self.straight


SHEETS = {
    "gyroid": SheetName(
        3.0915,
        0.7953,
        Cut(0.0, 0.25),
        Cut(0.125 * ROOT, 0.25 * ROOT, across=ROOT),
        (0.0, 0.25, 0.0),
    ),
    "schwarz_p": SheetName(
        2.3517, 0.8017, Cut(0.0, 0.5), Cut(0.0, 0.5 * ROOT, across=ROOT), (0.0, 0.0, 0.0)
    ),
    "schwarz_d": SheetName(
        3.8387, 0.7939, Cut(0.125, 0.25), Cut(0.0, 0.25 * ROOT, across=ROOT), (0.125, 0.375, 0.125)
    ),
}
"""By the name in `lattice.kind`."""
BLOCK = 0.5  # periods: the sides of a block are whole numbers of it
