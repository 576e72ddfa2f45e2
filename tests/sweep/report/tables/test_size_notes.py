"""The notes on parts of different size and on narrow lattices."""

import re
from pathlib import Path

from sweep.report.tables.size_notes import OF_THREE, narrow_note, size_note
from tests.support.results.specimens import summary

DOCS = Path(__file__).parents[4] / "docs" / "accuracy.md"
ROW = re.compile(r"\| (\w+) \| (glued|loose) \|(?: [\d.]+ \|){3} ([+-][\d.]+) / ")


def test_only_the_patterns_of_the_ranking_are_told_with_their_numbers():
    (words,) = narrow_note(("diamond", "wavy"))
    assert "fewer than 8 cells" in words
    glued, loose = OF_THREE["diamond"]
    assert f"diamond {glued} / {loose} %" in words
    assert "hex" not in words


def test_the_numbers_are_those_of_the_table_of_make_sides():
    found = {}
    for kind, platen, change in ROW.findall(DOCS.read_text("utf-8")):
        found.setdefault(kind, {})[platen] = float(change)
    assert found.keys() == OF_THREE.keys()
    for kind, (glued, loose) in OF_THREE.items():
        assert abs(found[kind]["glued"] - glued) <= 0.51
        assert abs(found[kind]["loose"] - loose) <= 0.51


WIDE = {"width_m": 24.4e-3, "depth_m": 5e-3}


def test_the_smallest_and_the_greatest_part_are_named():
    (words,) = size_note(summary({}, WIDE, {"width_m": 30e-3}))
    assert words.split(":")[0] == (
        "The parts differ in size, from 12.2 x 12.2 x 10 to 30 x 12.2 x 10 mm"
    )


def test_nothing_is_said_of_equal_parts_of_periods_and_of_panels():
    for rows in (
        summary({}, {"width_m": 12.3e-3}),
        summary({}, WIDE).assign(sides="tied, fixed period"),
        summary({}, WIDE).assign(panel_specimens=4.0),
    ):
        assert list(size_note(rows)) == []
