"""Estimates compared with values of whole models."""

import pytest
from pandas import Series

from sweep.ranking.question import Question
from sweep.report.tables.screen_sheets import screen_sheets
from tests.support.results.specimens import designs, summary


def sheet(count, factors=(1.0, 1.0, 1.0)):
    """The sheet of three designs, the first `count` of which ran as a whole, at these factors."""
    estimates = summary(*designs([1.0, 2.0, 3.0], [0.3, 0.4, 0.3]))
    full = estimates.head(count).copy()
    energies = [name for name in full if name.endswith(("_J", "_J_per_g"))]
    full[energies] = full[energies].mul(
        Series(factors[:count], index=full.index, dtype=float), axis=0
    )
    (found,) = screen_sheets(estimates, full, Question())
    return found


def test_what_is_only_estimated_has_no_full_value():
    found = sheet(1, factors=(0.5, 1.0, 1.0))
    assert found.title.startswith("Estimates of specific_absorption")
    assert found.heads[-3:] == ["estimate", "full", "full / estimate"]
    assert sorted(row[-1] for row in found.rows) == ["0.500", "–", "–"]
    assert [row[-2] for row in found.rows].count("–") == 2
    assert found.notes[-1] == "1 of 3 designs ran as a whole: full / estimate 0.50 to 0.50."


@pytest.mark.parametrize(
    ("factors", "text"),
    [((1.0, 1.0, 1.0), "1.00 to 1.00, rank correlation 1.00."), ((0.1, 1.0, 9.0), "correlation -")],
)
def test_agreement_is_told(factors, text):
    assert text in sheet(3, factors).notes[-1]
    assert len(sheet(0).notes) == 1  # without whole models
