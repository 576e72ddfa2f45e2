"""The sheets that can be printed: how much surface they have, and where a panel may be cut.

A panel ends where the surface meets its faces steeply, so that the sheet can be held there: at
whole numbers of `Cut.step` from `Cut.start`. No numpy here, as every config reads this.
"""

from math import sqrt
from typing import NamedTuple

ROOT = sqrt(2.0)


class Cut(NamedTuple):
    """Faces of a panel. start: of the lower one; step: of others above it; across, along: periods
    in its plane; all in periods of the surface. turned: whether its axes are the diagonals (1, -1,
    0), z and (1, 1, 0) of the surface, as slicers turn it by 45 degrees, or x, y and z.
    """

    start: float
    step: float
    across: float = 1.0
    along: float = 1.0
    turned: bool = False


class SheetName(NamedTuple):
    """A sheet. In a period, from a net of 24 quads: area, in units of the
    squared period; steep: mean of |n_xy|, n its unit normal. cuts: by `loading.direction`.
    """

    area: float
    steep: float
    cuts: dict[str, Cut]


SHEETS = {
    "gyroid": SheetName(
        3.0915,
        0.7953,
        {
            "out_of_plane": Cut(0.0, 0.25),
            "in_plane": Cut(0.125 * ROOT, 0.25 * ROOT, ROOT, 1.0, True),
        },
    ),
    "schwarz_p": SheetName(
        2.3517,
        0.8017,
        {"out_of_plane": Cut(0.0, 0.5), "in_plane": Cut(0.0, 0.5 * ROOT, ROOT, 1.0, True)},
    ),
    "schwarz_d": SheetName(
        3.8387,
        0.7939,
        {"out_of_plane": Cut(0.125, 0.25), "in_plane": Cut(0.0, 0.25 * ROOT, ROOT, 1.0, True)},
    ),
}
"""By the name in `lattice.kind`."""
