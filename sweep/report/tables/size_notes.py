"""Notes for rankings of parts of different size, as energies and forces refer to each part, and of
narrow lattices of several patterns: for the terminal, the page and files.
"""

from collections.abc import Collection, Iterator
from textwrap import fill

from pandas import DataFrame

from sweep.numbers import in_unit, significant
from sweep.ranking.narrow import WIDE
from sweep.report.tables.requirement_notes import WIDTH

NARROW = (
    f"Some lattices have fewer than {WIDE} cells between free sides, which favours some patterns: "
    "a wide part may be ranked in another order."
)
BESIDE = (
    "Energy per gram of 3 cells between free sides, beside the middle of a wide panel, between "
    "glued / loose platens (to 50 %, walls a tenth of a cell): {}."
)
OF_THREE = {
    "brick": (12, 0),
    "circle": (-26, -39),
    "diamond": (-41, -50),
    "hex": (-24, -25),
    "kagome": (-20, -23),
    "reentrant": (-15, -22),
    "square": (5, -1),
    "triangle": (-10, -23),
}
"""Change in %, between glued and loose platens, as `make sides` measures it."""


def narrow_note(patterns: Collection[str]) -> Iterator[str]:
    """The known effect of narrow lattices on these patterns; nothing if there are none."""
    if not patterns:
        return
    gains = [
        f"{kind} {glued:+d} / {loose:+d} %"
        for kind, (glued, loose) in OF_THREE.items()
        if kind in patterns
    ]
    beside = [BESIDE.format(", ".join(gains))] if gains else []
    yield fill(" ".join([NARROW, *beside]), WIDTH)


SIDES = ["width_m", "height_m", "depth_m"]
SAME = 0.01  # relative difference of a side
TERMINAL = 80  # most letters in a line that any terminal shows whole
UNLIKE = "The parts differ in size, from {} to {} mm: energy, force and mass are of each as it is."


def size_note(rows: DataFrame) -> Iterator[str]:
    """The smallest and the greatest of the parts of one scene; nothing if all have the same size.

    Periods are no parts, and specimens of a panel are counted so that they fill it.
    """
    parts = rows[rows["sides"] == "free"].dropna(subset=SIDES)
    if "panel_specimens" in rows:
        parts = parts[parts["panel_specimens"].isna()]
    sizes = parts[SIDES]
    if (sizes.max() > (1.0 + SAME) * sizes.min()).any():
        place = sizes.prod(axis=1)
        ends = (sizes.loc[place.idxmin()], sizes.loc[place.idxmax()])
        words = (" x ".join(significant(in_unit(side, "mm"), 3) for side in end) for end in ends)
        yield fill(UNLIKE.format(*words), TERMINAL)
