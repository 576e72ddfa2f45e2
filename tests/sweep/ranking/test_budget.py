"""Which mass a budget limits, and which designs are within it."""

import pytest

from sweep.ranking.rank import rank, ranked
from sweep.report.tables.legend import legend
from sweep.report.tables.sheets import ranking_sheets
from tests.support.results.specimens import designs, ids, summary

PANEL = ("130 mm", "50 mm")


def test_a_design_that_weighs_just_the_budget_is_within_it():
    """Round-off, which no scale would show, does not count; in the notes of the table neither."""
    table = summary(*designs([25.0000000000012, 25.000001], [0.1, 0.2]))
    ranking = ranked(table, budget="25 g")
    assert ids(ranking.table) == [0]
    (sheet,) = ranking_sheets(ranking, table)
    assert sheet.notes == ()


def test_budget_limits_the_panel_not_the_specimen():
    table = summary(*designs([1.0, 2.0], [0.1, 0.3]))
    assert ids(rank(table, budget="60 g", panel=PANEL)) == [0]
    assert ids(rank(table, budget="4 oz", panel=PANEL)) == [1, 0]  # 113.4 g


def test_budgets_count_what_is_extruded():
    """0.3 J in 2.5 g as extruded, 0.1 J in 1 g without a slicer."""
    table = summary(*designs([2.0], [0.3], printed_mass_g=2.5), *designs([1.0, 2.4], [0.1, 0.2]))
    ranking = ranked(table)
    assert ids(ranked(table, budget="2.4 g").table) == [2, 1]
    assert list(ranking.table[ranking.mass]) == [2.5, 1.0, 2.4]
    (sheet,) = ranking_sheets(ranking, table)
    at = sheet.heads.index("print g")
    shown = [row[at - 1 : at + 1] for row in sheet.rows]
    assert shown == [["2.00", "2.50"], ["1.00", "–"], ["2.40", "–"]]
    assert "print g: mass as the slicer extrudes it" in legend(ranking)
    found = ranked(table, panel=PANEL).table.set_index("mass_g").loc[[2.0, 1.0]]
    assert list(found["panel_mass_g"]) == pytest.approx([50.0 * 2.5, 50.0])
    assert list(found["specific_absorption_until_packed_J_per_g"]) == pytest.approx([0.12, 0.1])
    unsliced = table.assign(printed_mass_g=float("nan"))
    (sheet,) = ranking_sheets(ranked(unsliced), unsliced)
    assert ranked(unsliced).mass == "mass_g"
    assert "print g" not in sheet.heads
