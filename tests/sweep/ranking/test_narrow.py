"""Which rankings mix patterns in narrow lattices."""

import pytest

from sweep.ranking.narrow import narrow_patterns
from sweep.ranking.rank import ranked
from tests.support.results.specimens import summary

HEX = {"lattice_kind": "hex", "cells_x": 12}


@pytest.mark.parametrize(
    ("table", "named"),
    [
        (summary({}, HEX), ("square",)),
        (summary({}, HEX | {"cells_x": 7}), ("square", "hex")),
        (summary({}, {"cells_x": 4}), ()),  # one pattern
        (summary({"cells_x": 8}, HEX), ()),
        (summary({}, HEX).assign(sides="tied, fixed period"), ()),
        (
            summary({}, HEX | {"cells_y": 12}).assign(direction="out_of_plane"),
            ("square along the cells",),
        ),
        (
            summary(
                {"cells_x": 9, "cells_y": 9}, HEX | {"cells_y": 2, "direction": "out_of_plane"}
            ),
            ("hex along the cells",),
        ),
    ],
)
def test_patterns_with_few_cells_between_free_sides_are_named(table, named):
    assert narrow_patterns(table) == named


def test_each_scene_is_judged_by_all_of_its_designs():
    rows = summary({"mass_g": 9.0}, HEX, {"platen": "contact"})
    ranking = ranked(rows, budget="2 g", top=1)
    assert list(ranking.narrow.values()) == [("square",), ()]
