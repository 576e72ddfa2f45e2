"""Which mass a budget limits, and which designs are within it."""

import pytest

from sweep.ranking.rank import rank, ranked
from sweep.report.tables.legend import legend
from sweep.report.tables.sheets import ranking_sheets
from tests.support.results.specimens import designs, ids, summary


def test_a_design_that_weighs_just_the_budget_is_within_it():
    """Round-off, which no scale would show, does not count; in the notes of the table neither."""
    table = summary(*designs([25.0000000000012, 25.000001], [0.1, 0.2]))
    ranking = ranked(table, budget="25 g")
    assert ids(ranking.table) == [0]
    (sheet,) = ranking_sheets(ranking, table)
    assert sheet.notes == ()


def test_budget_limits_the_panel_not_the_specimen():
    table = summary(*designs([1.0, 2.0], [0.1, 0.3]))
    panel = ("130 mm", "50 mm")
    assert ids(rank(table, budget="60 g", panel=panel)) == [0]
    assert ids(rank(table, budget="4 oz", panel=panel)) == [1, 0]  # 113.4 g


def test_budgets_count_what_is_extruded():
    """0.3 J in 2.5 g as extruded, 0.1 J in 1 g without a slicer."""
    table = summary(*designs([2.0], [0.3], printed_mass_g=2.5), *designs([1.0, 2.4], [0.1, 0.2]))
    ranking = ranked(table, budget="2.4 g")
    assert ranking.mass == "counted_mass_g"
    assert ids(ranking.table) == [2, 1]
    assert list(ranked(table).table["counted_mass_g"]) == [2.5, 1.0, 2.4]
    (sheet,) = ranking_sheets(ranked(table), table)
    at = sheet.heads.index("print g")
    assert [row[at - 1 : at + 1] for row in sheet.rows] == [
        ["2.00", "2.50"],
        ["1.00", "–"],
        ["2.40", "–"],
    ]
    assert "print g: mass as the slicer extrudes it" in legend(ranked(table))
    found = ranked(table, panel=(0.130, 0.050)).table.set_index("mass_g")
    assert found.loc[2.0, "panel_mass_g"] == pytest.approx(50.0 * 2.5)
    per_gram = found["specific_absorption_until_packed_J_per_g"]
    assert per_gram[2.0] == pytest.approx(0.12)
    assert per_gram[1.0] == pytest.approx(0.1)


def test_without_a_slicer_nothing_is_said_of_extruding():
    table = summary(*designs([1.0, 2.0], [0.1, 0.2]))
    ranking = ranked(table)
    (sheet,) = ranking_sheets(ranking, table)
    assert ranking.mass == "mass_g"
    assert "print g" not in sheet.heads
    assert "counted_mass_g" not in ranking.table
