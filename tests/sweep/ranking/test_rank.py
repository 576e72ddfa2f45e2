"""Rankings: which designs are compared, by which column, and which are left out."""

import pandas as pd
import pytest

from sweep.columns import COLUMNS
from sweep.ranking.question import RankError
from sweep.ranking.rank import USUAL, rank, ranked
from sweep.report.tables.sheets import ranking_sheets
from tests.support.readme import QUOTED
from tests.support.results.specimens import designs, ids, summary

NAN = float("nan")


def test_best_per_gram_comes_first():
    ranking = ranked(summary(*designs([1.0, 2.0, 4.0], [0.10, 0.30, 0.40])))
    assert ids(ranking.table) == [1, 0, 2]
    assert list(ranking.table["place"]) == [1, 2, 2]
    assert ranking.by == "specific_absorption_until_packed_J_per_g"
    assert set(ranking.table["ranked_by"]) == {ranking.by}


def test_budget_is_spent_on_energy_not_on_energy_per_gram():
    ranking = rank(summary(*designs([1.0, 2.0, 4.0], [0.10, 0.18, 0.40])), budget="2 g")
    assert ids(ranking) == [1, 0]
    assert list(ranking["budget_g"]) == [2.0, 2.0]


def test_pareto_compares_periods_of_panels_per_area():
    """All are as heavy per area, so that the one that absorbs most per area is best."""
    rows = designs([4.0, 1.0, 2.0], [0.4, 0.11, 0.19], depth_m=0.01, sides="tied, fixed period")
    for row, width in zip(rows, (0.04, 0.01, 0.02), strict=True):
        row["outer_width_m"] = width
    table = rank(summary(*rows)).set_index("mass_g")
    assert dict(table["pareto"]) == {4.0: False, 1.0: True, 2.0: False}
    free = rank(summary(*(row | {"sides": "free"} for row in rows)))
    assert free["pareto"].all()


def test_budgets_are_refused_for_periods_without_a_panel():
    part, period = designs([4.0, 1.0], [0.4, 0.1])
    mixed = summary(part, period | {"sides": "tied, fixed period"})
    with pytest.raises(RankError, match="allowed with a panel"):
        rank(mixed, budget="5 g")
    assert len(rank(mixed)) == 2


def test_periods_fill_a_panel_in_parts():
    """A period of twice the area is twice as heavy: both panels weigh and absorb the same."""
    rows = designs([4.0, 2.0], [0.4, 0.2], depth_m=0.01, sides="tied, fixed period")
    for row, width in zip(rows, (0.04, 0.02), strict=True):
        row["outer_width_m"] = width
    ranking = rank(summary(*rows), panel=("100 mm", "50 mm"), budget=["49 g", "51 g"])
    assert list(ranking["budget_g"]) == [51.0, 51.0]
    assert dict(zip(ranking["mass_g"], ranking["panel_specimens"], strict=True)) == pytest.approx(
        {4.0: 12.5, 2.0: 25.0}
    )
    assert list(ranking["panel_mass_g"]) == pytest.approx([50.0, 50.0])
    assert list(ranking["panel_energy_J"]) == pytest.approx([5.0, 5.0])
    assert list(ranking["panel_width_m"]) == pytest.approx([0.1, 0.1])
    lighter = [rows[0], rows[1] | {"mass_g": 1.9}]
    front = rank(summary(*lighter), panel=("100 mm", "50 mm")).set_index("mass_g")["pareto"]
    assert dict(front) == {4.0: False, 1.9: True}


def test_pareto_looks_at_all_rows_of_the_scene():
    table = summary(*designs([1.0, 2.0, 3.0], [0.3, 0.2, 0.6]))
    ranking = rank(table, by="mass_g", top=2)
    assert list(ranking["pareto"]) == [True, False]


def test_equal_values_share_a_place_whatever_the_order_of_rows():
    table = summary(*designs([2.0, 1.0, 4.0, 1.0], [0.5, 0.25, 1.0, 0.125]))
    forwards, backwards = rank(table), rank(table.iloc[::-1])
    assert ids(forwards) == [1, 0, 2, 3]
    assert list(forwards["place"]) == [1, 1, 1, 4]
    pd.testing.assert_frame_equal(forwards, backwards)


def test_failed_and_unmeasured_cases_have_no_place_and_are_counted():
    rows = designs([1.0, 1.0, 1.0], [0.1, NAN, 0.3])
    rows[2] |= {"status": "timed_out"}
    ranking = ranked(summary(*rows))
    assert ids(ranking.table) == [0]
    assert (ranking.cases, ranking.failed, ranking.unranked) == (3, 1, 1)


def test_nothing_finished_is_an_empty_ranking():
    ranking = ranked(summary({"status": "stopped"}))
    assert ranking.table.empty
    assert {"place", "scene", "pareto", "budget_g"} <= set(ranking.table)
    (sheet,) = ranking_sheets(ranking, summary({"status": "stopped"}))
    assert (sheet.rows, sheet.notes) == ([], ("No design is ranked here: all cases failed (1).",))


GENTLE = ["peak_force_N", "peak_deceleration_m_per_s2", "rebound_share", "rebound_speed_m_per_s"]
GENTLE += ["passed_on_N", "greatest_element_strain", "max_crossings", "error_absorbed_energy_J"]
STRONG = ["efficiency", "stroke_left_m", "least_element_strain", "absorbed_energy_at_12.5N_J"]


@pytest.mark.parametrize("by", GENTLE + STRONG)
def test_a_column_knows_what_is_better(by):
    sources = {"passed_on_N": "peak_force_N"}
    values = [{sources.get(by, by): value} for value in (40.0, 30.0)]
    assert ids(rank(summary(*values), by=by)) == ([1, 0] if by in GENTLE else [0, 1])


def test_what_makes_no_design_better_is_not_sorted_by():
    table = summary({})
    for by in (name for name, of in COLUMNS.items() if of.units and not of.better):
        with pytest.raises(
            RankError, match=f'"{by}": neither more nor less of it makes a design b'
        ):
            rank(table, by=by)


def test_a_budget_given_twice_is_one():
    table = summary(*designs([1.0, 2.0], [0.4, 0.5]))
    assert ranked(table, budget=["2 g", 2e-3, "1 g"]).budgets_g == (2.0, 1.0)


def test_under_a_dead_load_the_least_sink_wins():
    load = {"loading_mode": "force", "force_N": 5.0, "stroke_m": NAN, "returned_energy_J": NAN}
    rows = designs([1.0, 2.0, 3.0], [0.3, 0.2, 0.1], **load)
    for row, sink in zip(rows, [0.6, 0.002, 0.004], strict=True):
        row["peak_strain"] = sink
    table = summary(*rows, {"absorbed_energy_J": 0.2})
    ranking = ranked(table, budget="5 g")
    assert ids(ranking.table) == [1, 2, 0, 3]
    assert list(ranking.table["pareto"]) == [True, False, True, True]
    assert list(ranking.table["ranked_by"]) == ["peak_strain"] * 3 + [ranking.energy]
    assert ranking.by == ranking.energy
    loaded, crushed = ranking_sheets(ranking, table)
    assert (loaded.title, crushed.title) == (
        "dead load of 5 N, glued platens: smallest strain first",
        "crushed to 50 %, glued platens",
    )
    assert loaded.heads == ["#", "mass g", "strain %"]
    assert [row[-1] for row in loaded.rows] == ["0.200", "0.400", "60.0"]
    assert ranked(table.head(3)).by == "peak_strain"


def test_a_column_that_is_asked_for_sorts_dead_loads_too():
    load = {"loading_mode": "force", "force_N": 5.0, "stroke_m": NAN}
    table = summary(*designs([2.0, 1.0], [0.3, 0.2], **load))
    ranking = ranked(table, by="mass_g")
    assert ids(ranking.table) == [1, 0]
    (sheet,) = ranking_sheets(ranking, table)
    assert sheet.title == "dead load of 5 N, glued platens"


def test_table_without_a_column_is_refused():
    table = summary({}).drop(columns="absorbed_energy_within_model_J")
    with pytest.raises(RankError, match="no absorbed_energy_within_model_J; needed: all columns"):
        rank(table)


def test_versions_of_the_model_are_counted():
    rows = [{"model_version": version} for version in (3, 1, 3)]
    rows.append({"model_version": 2, "status": "stopped"})
    table = summary(*rows)
    assert ranked(table).versions == {1: 1, 3: 2}


def test_a_column_that_is_not_there_is_refused_with_its_neighbours_and_the_usual_ones():
    with pytest.raises(RankError) as refused:
        rank(summary({}), by="peak_forse_N")
    first, second = str(refused.value).splitlines()
    assert first.startswith(
        'cannot sort by "peak_forse_N": no such column; the nearest are peak_force_N, '
    )
    start, _, end = second.partition(" and ")
    assert start == f"allowed: {', '.join(USUAL)}"
    count, _, where = end.partition(" others: ")
    assert int(count) > 30
    assert where == "the first line of rank --csv has all, docs/results.md explains most"
    with pytest.raises(RankError, match="the nearest is steps\n"):
        rank(summary({}), by="status")
    with pytest.raises(RankError, match="neither more nor less of it makes a design better"):
        rank(summary({}), by="cells_x")
    with pytest.raises(RankError, match='"nosuch": no such column\nallowed: absorbed'):
        rank(summary({}), by="nosuch")


def test_the_usual_columns_are_those_of_the_pages():
    assert {*USUAL} <= QUOTED
    assert len(USUAL) == 12


def test_refusals_name_what_is_allowed():
    table = summary({"absorbed_energy_at_50N_J": 0.1, "absorbed_energy_at_200N_J": 0.2})
    with pytest.raises(RankError, match="cannot sort by"):
        rank(table, by="material")
    with pytest.raises(RankError, match="up to 60 N in this table; allowed: 50 N, 200 N; other"):
        rank(table, allowed_force="60 N")
    with pytest.raises(RankError, match=r"panel = .*; allowed: two lengths, such as"):
        rank(table, panel=("0.1 m",))
