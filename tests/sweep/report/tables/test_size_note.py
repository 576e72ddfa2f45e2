"""The note on parts of different size."""

from sweep.report.tables.size_note import size_note
from tests.support.results.specimens import summary

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
