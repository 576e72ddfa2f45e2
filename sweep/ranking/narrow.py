"""Finds rankings that mix patterns in narrow lattices, which favour some patterns over others."""

from pandas import DataFrame

from sweep.loading_modes import has

WIDE = 8
"""Cells across from which free sides count for little."""


def narrow_patterns(rows: DataFrame) -> tuple[str, ...]:
    """The patterns of one scene that have fewer than `WIDE` cells between free sides.

    Empty if all rows are of one pattern, as their order then says nothing about patterns.
    """
    across = rows[(rows["direction"] == "in_plane") & (rows["sides"] == "free")]
    if across["lattice_kind"].nunique() < 2:
        return ()
    few = across[(across["cells_x"] < WIDE) & ~has(across, "probed")]
    return tuple(few["lattice_kind"].drop_duplicates())
