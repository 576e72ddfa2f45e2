"""A note for rankings of parts of different size, as energies and forces refer to each part."""

from collections.abc import Iterator
from textwrap import fill

from pandas import DataFrame

from sweep.numbers import in_unit, significant

SIDES = ["width_m", "height_m", "depth_m"]
SAME = 0.01  # relative difference of a side
WIDTH = 80  # most letters in a line
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
        yield fill(UNLIKE.format(*words), WIDTH)
