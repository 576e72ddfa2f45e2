"""Rankings: which designs are compared, by which column, and which are left out."""

import re

import pandas as pd
import pytest

from sweep.columns import COLUMNS
from sweep.ranking.question import RankError
from sweep.ranking.rank import USUAL, rank, ranked
from sweep.report.tables.sheets import ranking_sheets
from tests.support.readme import QUOTED
from tests.support.results.specimens import designs, ids, summary

NAN = float("nan")


def test_best_per_gram_comes_first_and_equal_values_share_a_place():
    table = summary(*designs([2.0, 1.0, 4.0, 1.0], [0.5, 0.25, 1.0, 0.125]))
    ranking, backwards = ranked(table), rank(table.iloc[::-1])
    assert ids(ranking.table) == [1, 0, 2, 3]
    assert list(ranking.table["place"]) == [1, 1, 1, 4]
    assert [ids(lightest) for lightest in ranking.lightest.values()] == [[1]]
    assert ranking.by == "specific_absorption_until_packed_J_per_g"
    assert set(ranking.table["ranked_by"]) == {ranking.by}
    pd.testing.assert_frame_equal(ranking.table, backwards)


def test_a_ranking_can_be_ranked_again():
    table = summary(*designs([2.0, 1.0, 4.0], [0.5, 0.25, 1.0]))
    once = rank(table, budget="3 g")
    pd.testing.assert_frame_equal(rank(once, budget="3 g"), once)
    assert ids(rank(once, budget="1.5 g")) == [1]


def test_budget_is_spent_on_energy_not_on_energy_per_gram():
    table = summary(*designs([1.0, 2.0, 4.0], [0.10, 0.18, 0.40]))
    ranking = ranked(table, budget=["2 g", 2e-3])
    assert ids(ranking.table) == [1, 0]
    assert list(ranking.table["budget_g"]) == [2.0, 2.0]
    assert ranked(table, budget=["2 g", 2e-3, "1 g"]).budgets_g == (2.0, 1.0)


def periods(masses, energies, widths):
    rows = designs(masses, energies, depth_m=0.01, sides="tied, fixed period")
    return [row | {"outer_width_m": width} for row, width in zip(rows, widths, strict=True)]


def test_pareto_compares_periods_of_panels_per_area():
    """All are as heavy per area, so that the one that absorbs most per area is best."""
    table = summary(*periods([4.0, 1.0, 2.0], [0.4, 0.11, 0.19], [0.04, 0.01, 0.02]))
    assert dict(rank(table)[["mass_g", "pareto"]].to_numpy()) == {4.0: False, 1.0: True, 2.0: False}
    assert rank(table.assign(sides="free"))["pareto"].all()


def test_budgets_are_refused_for_periods_without_a_panel():
    part, period = designs([4.0, 1.0], [0.4, 0.1])
    mixed = summary(part, period | {"sides": "tied, fixed period"})
    with pytest.raises(RankError, match="allowed with a panel"):
        rank(mixed, budget="5 g")
    assert len(rank(mixed)) == 2


def test_a_period_is_compared_with_a_part_per_area():
    """The part is heavier and absorbs less per area, though it is lighter as a whole."""
    part, period = periods([1.0, 3.0], [0.1, 0.4], [0.01, 0.04])
    assert rank(summary(part | {"sides": "free"}, period))["pareto"].tolist() == [True, False]
    heavy = summary(part | {"sides": "free", "mass_g": 1.0}, period | {"mass_g": 3.9})
    assert dict(rank(heavy)[["mass_g", "pareto"]].to_numpy()) == {1.0: False, 3.9: True}


@pytest.mark.parametrize(
    "limit",
    [
        {"require": {"max_force": "9 kN"}},
        {"require": {"min_absorbed": "1 mJ"}},
        {"by": "absorbed_energy_J"},
        {"by": "mass_g", "panel": ("100 mm", "50 mm")},
    ],
)
def test_forces_and_energies_of_unequal_periods_are_not_compared(limit):
    table = summary(*periods([4.0, 2.0], [0.4, 0.2], [0.04, 0.02]))
    with pytest.raises(RankError, match=r"periods .* differ in area"):
        rank(table, **limit)
    assert len(rank(table.assign(outer_width_m=0.02), **limit)) == 2
    assert len(rank(table.assign(sides="free"), **limit)) == 2


def test_panels_of_unequal_periods_are_compared():
    table = summary(*periods([4.0, 2.0], [0.4, 0.2], [0.04, 0.02]))
    panel = {"panel": ("100 mm", "50 mm"), "per": "panel"}
    assert len(rank(table, require={"min_absorbed": "1 J"}, **panel)) == 2
    assert len(rank(table, by="panel_energy_J", **panel)) == 2


def test_periods_fill_a_panel_in_parts():
    """A period of twice the area is twice as heavy: both panels weigh and absorb the same."""
    table, panel = summary(*periods([4.0, 2.0], [0.4, 0.2], [0.04, 0.02])), ("100 mm", "50 mm")
    ranking = rank(table, panel=panel, budget=["49 g", "51 g"]).sort_values("case_id")
    assert list(ranking["budget_g"]) == [51.0, 51.0]
    assert list(ranking["panel_specimens"]) == pytest.approx([12.5, 25.0])
    assert list(ranking["panel_mass_g"]) == pytest.approx([50.0, 50.0])
    assert list(ranking["panel_energy_J"]) == pytest.approx([5.0, 5.0])
    assert list(ranking["panel_width_m"]) == pytest.approx([0.1, 0.1])
    lighter = rank(table.assign(mass_g=[4.0, 1.9]), panel=panel)
    assert ids(lighter[lighter["pareto"]]) == [1]


def test_pareto_looks_at_all_rows_of_the_scene():
    table = summary(*designs([1.0, 2.0, 3.0], [0.3, 0.2, 0.6]))
    assert list(rank(table, by="mass_g", top=2)["pareto"]) == [True, False]


def test_failed_and_unmeasured_cases_have_no_place_and_are_counted():
    versions = [{"model_version": version} for version in (3, 1, 3)]
    stopped = {"model_version": 2, "status": "timed_out"}
    unmeasured = {"model_version": 3, "absorbed_energy_until_packed_J": NAN}
    ranking = ranked(summary(*versions, unmeasured, stopped))
    assert ids(ranking.table) == [0, 1, 2]
    assert (ranking.cases, ranking.failed, ranking.unranked) == (5, 1, 1)
    assert ranking.versions == {1: 1, 3: 3}


def test_nothing_finished_is_an_empty_ranking():
    table = summary({"status": "stopped"})
    ranking = ranked(table)
    assert ranking.table.empty
    assert {"place", "scene", "pareto", "budget_g"} <= set(ranking.table)
    assert ids(ranking.with_unfinished) == [0]
    (sheet,) = ranking_sheets(ranking, table)
    assert (sheet.rows, len(sheet.notes)) == ([], 2)
    assert "Unfinished: " in sheet.notes[1]


def test_cases_of_a_scene_without_a_ranked_design_are_named():
    """Their rows follow the table, as those of any other scene do."""
    rows = [{"platen": "glued"}, {"platen": "loose", "status": "stopped", "loaded": 0}]
    table = summary(*rows)
    ranking = ranked(table)
    assert ids(ranking.with_unfinished) == [0, 1]
    assert ranking.unfinished["scene"].tolist() == list(ranking.lost)
    _, lost = ranking_sheets(ranking, table)
    assert "Unfinished: " in lost.notes[1]


GENTLE = ["peak_force_N", "peak_deceleration_m_per_s2", "rebound_share", "rebound_speed_m_per_s"]
GENTLE += ["passed_on_N", "greatest_element_strain", "max_crossings", "error_absorbed_energy_J"]
STRONG = ["efficiency", "stroke_left_m", "least_element_strain", "absorbed_energy_at_12.5N_J"]


@pytest.mark.parametrize("by", GENTLE + STRONG)
def test_a_column_knows_what_is_better(by):
    source = "peak_force_N" if by == "passed_on_N" else by
    assert ids(rank(summary({source: 40.0}, {source: 30.0}), by=by)) == (
        [1, 0] if by in GENTLE else [0, 1]
    )


def test_what_makes_no_design_better_is_not_sorted_by():
    for by in (name for name, of in COLUMNS.items() if of.units and not of.better):
        with pytest.raises(RankError, match=f'"{by}": neither more nor less of it makes a'):
            rank(summary({}), by=by)


LOAD = {"loading_mode": "force", "force_N": 5.0, "stroke_m": NAN, "returned_energy_J": NAN}


def test_under_a_dead_load_the_least_sink_wins():
    rows = designs([1.0, 2.0, 3.0], [0.3, 0.2, 0.1], **LOAD)
    table = summary(*rows, {"absorbed_energy_J": 0.2})
    table["peak_strain"] = [0.6, 0.002, 0.004, 0.0]
    ranking = ranked(table, budget="5 g")
    assert ids(ranking.table) == [1, 2, 0, 3]
    assert list(ranking.table["pareto"]) == [True, False, True, True]
    assert list(ranking.table["ranked_by"]) == ["peak_strain"] * 3 + [ranking.energy]
    assert (ranking.by, ranked(table.head(3)).by) == (ranking.energy, "peak_strain")
    loaded, crushed = ranking_sheets(ranking, table)
    assert loaded.title == "dead load of 5 N, glued platens: smallest strain first"
    assert crushed.title == "crushed to 50 %, glued platens"
    assert loaded.heads == ["#", "mass g", "strain %"]
    assert [row[-1] for row in loaded.rows] == ["0.200", "0.400", "60.0"]
    by_mass = ranked(table.head(3), by="mass_g")
    assert ids(by_mass.table) == [0, 1, 2]
    (sheet,) = ranking_sheets(by_mass, table)
    assert sheet.title == "dead load of 5 N, glued platens"


def test_a_column_that_is_not_there_is_refused_with_its_neighbours_and_the_usual_ones():
    with pytest.raises(RankError) as refused:
        rank(summary({}), by="peak_forse_N")
    first, second = str(refused.value).splitlines()
    assert 'by "peak_forse_N": no such column; the nearest are peak_force_N, ' in first
    usual, count = re.fullmatch(r"allowed: (.*) and (\d+) others: .*", second).groups()
    assert (usual, int(count) > 30) == (", ".join(USUAL), True)
    for by, words in {
        "status": "the nearest is steps\n",
        "cells_x": "neither more nor less of it makes a design better",
        "nosuch": '"nosuch": no such column\nallowed: absorbed',
        "material": "cannot sort by",
    }.items():
        with pytest.raises(RankError, match=words):
            rank(summary({}), by=by)


def test_the_usual_columns_are_those_of_the_pages():
    assert {*USUAL} <= QUOTED
    assert len(USUAL) == 12


def test_a_column_that_is_missing_is_named():
    with pytest.raises(RankError, match=r"no height_m; needed: all columns of a summary"):
        rank(summary({}).drop(columns="height_m"))


def test_forces_of_the_table_are_named_where_another_is_asked_for():
    table = summary({"absorbed_energy_at_50N_J": 0.1, "absorbed_energy_at_200N_J": 0.2})
    with pytest.raises(RankError, match="up to 60 N in this table; allowed: 50 N, 200 N; other"):
        rank(table, allowed_force="60 N")
