"""A panel: whole specimens in a rectangle, as it is ranked, searched and exported.

Specimens stand side by side along the first length of the panel, with a gap of `BESIDE`, and one
behind the other along the second: without a gap, so that walls go on in depth, or with the same gap
if they are pressed along their cells and so show their drawing from above. In each direction their
number is chosen so that the rectangle comes nearest to the requested length. It may exceed that
length, by less than half a specimen.

A panel in one piece, of which one period was computed, has exactly the requested length, and its
edges count as its middle.
"""

from typing import Any, NamedTuple

import numpy as np

from sweep.numbers import text_in

BESIDE = 0.4e-3  # m: gap between two specimens; closer ones would be printed as one

BEHIND = {"in_plane": 0.0, "out_of_plane": BESIDE}
"""Gap (m) between two specimens one behind the other, by the direction in which they are
pressed.
"""


class Panel(NamedTuple):
    """Numbers of specimens side by side and one behind the other, and the true lengths (m).

    Floats, arrays or columns, as the arguments of `panel_of` are.
    """

    across: Any
    behind: Any
    width: Any
    depth: Any

    @property
    def specimens(self) -> Any:
        """Number of specimens; 0 where less than half of one fits."""
        return self.across * self.behind


def panel_of(sides: tuple[float, float], width: Any, depth: Any, gap: Any = 0.0) -> Panel:
    """The panel nearest to `sides` (m), of specimens of outer `width` x `depth` (m).

    gap: of `BEHIND`, m; NaN for periods of a panel in one piece, whose parts count, too.
    """
    piece = np.isnan(gap)
    across = np.where(piece, sides[0] / width, _nearest((sides[0] + BESIDE) / (width + BESIDE)))
    behind = np.where(piece, sides[1] / depth, _nearest((sides[1] + gap) / (depth + gap)))
    lengths = across * (width + BESIDE) - BESIDE, behind * (depth + gap) - gap
    return Panel(across, behind, *(np.where(piece, sides[k], lengths[k]) for k in (0, 1)))


def too_small(side: float, specimen: float) -> str:
    """Why a panel is refused whose length ``side`` (m) has no room for half a specimen (m)."""
    return (
        f"a panel of {text_in(side, 'mm', 6)} is smaller than half of a specimen of "
        f"{text_in(specimen, 'mm')}; allowed: a larger one, first its length along the width, then "
        "along the depth"
    )


def _nearest(count: Any) -> Any:
    """The nearest whole number, a half upwards, as in the page of `crumple report`."""
    return np.floor(count + 0.5)
