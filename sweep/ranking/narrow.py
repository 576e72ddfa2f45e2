"""Finds rankings that mix patterns in narrow lattices, which favour some patterns over others."""

from pandas import DataFrame

from sweep.columns import ALONG
from sweep.loading_modes import has

WIDE = 8
"""Cells across from which free sides count for little."""


def narrow_patterns(rows: DataFrame) -> tuple[str, ...]:
    """The patterns of one scene that have fewer than `WIDE` cells between free sides.

    Empty if all rows are of one pattern, as their order then says nothing about patterns.
    """
    free = rows[rows["sides"] == "free"]
    if free["lattice_kind"].nunique() < 2:
        return ()
    between = free["cells_x"].where(
        free["direction"] != ALONG, free[["cells_x", "cells_y"]].min(axis=1)
    )
    few = free[(between < WIDE) & ~has(free, "probed")]
    along = few["direction"] == ALONG
    names = few["lattice_kind"].where(~along, few["lattice_kind"] + " along the cells")
    return tuple(names.drop_duplicates())
