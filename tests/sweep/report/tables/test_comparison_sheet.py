"""Predictions and measured values, as text."""

import pytest

from sweep.ranking.comparison import Comparison, Range
from sweep.report.tables.comparison_sheet import comparison_sheet, span


def test_rows_tell_ranges_and_misses():
    rows = [
        Comparison("Ding", "plateau, MPa", "cells", Range(0.06611, 0.09034), Range(0.078, 0.081)),
        Comparison("Ding", "energy, J/g", "", Range(0.3, 0.4), Range(0.2, 0.2)),
        Comparison("Haid", "modulus", "loss", Range(1.0, 2.0), None),
    ]
    sheet = comparison_sheet(rows)
    assert sheet.rows == [
        ["Ding", "plateau, MPa", "cells", "0.0661..0.0903", "0.078..0.081", "yes"],
        ["", "energy, J/g", "–", "0.3..0.4", "0.2", "+50 %"],
        ["Haid", "modulus", "loss", "1..2", "–", "–"],
    ]
    assert sheet.opens == {2}
    assert sheet.notes[0].startswith("1 of 2 inside; 1 waits for a value.\n")


@pytest.mark.parametrize(
    ("values", "text"),
    [((0.82264, 0.82261), "0.823"), ((1.9, 3.363), "1.9..3.36"), ((3000.0, 4e4), "3000..40000")],
)
def test_ranges_have_three_digits(values, text):
    assert span(Range(*values)) == text
