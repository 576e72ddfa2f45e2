"""Which rankings mix patterns in narrow lattices."""

from sweep.ranking.narrow import narrow_patterns
from sweep.ranking.rank import ranked
from tests.support.results.specimens import summary

HEX = {"lattice_kind": "hex", "cells_x": 12}


def test_patterns_with_few_cells_are_named_where_patterns_are_compared():
    assert narrow_patterns(summary({}, HEX)) == ("square",)
    assert narrow_patterns(summary({}, HEX | {"cells_x": 7})) == ("square", "hex")


def test_wide_lattices_and_those_of_one_pattern_are_not():
    assert narrow_patterns(summary({}, {"cells_x": 4})) == ()
    assert narrow_patterns(summary({"cells_x": 8}, HEX)) == ()


def test_sides_that_are_not_free_or_not_at_the_side_do_not_count():
    assert narrow_patterns(summary({}, HEX).assign(sides="tied, fixed period")) == ()
    assert narrow_patterns(summary({}, HEX).assign(direction="out_of_plane")) == ()


def test_each_scene_is_judged_by_all_of_its_designs():
    rows = summary({"mass_g": 9.0}, HEX, {"platen": "contact"})
    ranking = ranked(rows, budget="2 g", top=1)
    assert list(ranking.narrow.values()) == [("square",), ()]
