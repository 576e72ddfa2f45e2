"""Ranges that meet, and by how much others miss."""

import pytest

from sweep.ranking.comparison import Comparison, Range, inside


@pytest.mark.parametrize(
    ("predicted", "measured", "off"),
    [
        ((1.0, 2.0), (2.0, 3.0), 0.0),
        ((1.0, 4.0), (2.0, 3.0), 0.0),
        ((1.0, 1.5), (2.0, 3.0), -0.2),
        ((3.5, 9.0), (2.0, 3.0), 0.2),
    ],
)
def test_a_miss_is_the_distance_to_the_nearest_end(predicted, measured, off):
    row = Comparison("", "", "", Range(*predicted), Range(*measured))
    assert row.off == pytest.approx(off)


def test_only_rows_with_both_ranges_count():
    near, far = Range(1.0, 2.0), Range(5.0, 6.0)
    pairs = [(near, near), (near, far), (None, near), (near, None)]
    rows = [Comparison("", "", "", *pair) for pair in pairs]
    assert inside(rows) == (1, 2)
    assert rows[2].off is rows[3].off is None
