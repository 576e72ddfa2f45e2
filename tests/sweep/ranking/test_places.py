"""Ties: places that error bars cannot tell apart, in rankings, tables and on the command line."""

import json

import numpy as np
import pandas as pd
import pytest

from sweep.ranking.places import shared_places
from sweep.ranking.rank import rank, ranked
from sweep.report.tables.legend import EQUAL, TIED, legend
from sweep.report.tables.sheets import ranking_sheets
from tests.support.command import crumple
from tests.support.results.specimens import designs, ids, summary, write

NAN = float("nan")
PANEL = ("130 mm", "50 mm")


def with_bars(energies, errors, **common):
    """Designs of 1 g with these energies (mJ) and error bars; their corrections (mJ) differ by the
    sum of the errors of neighbours.
    """
    rows = designs([1.0] * len(energies), [1e-3 * energy for energy in energies], **common)
    corrections = np.cumsum([0.0, *np.add(errors[1:], errors[:-1])])
    for row, error, correction in zip(rows, errors, corrections, strict=True):
        for name in ("absorbed_energy_J", "absorbed_energy_until_packed_J"):
            row |= {f"error_{name}": 1e-3 * error, f"correction_{name}": 1e-3 * correction}
        for name in ("peak_force_until_packed_N", "peak_force_N"):
            row |= {f"error_{name}": 0.5, f"correction_{name}": 0.0}
    return rows


def not_shown(count, all_of_them):
    return f"Not shown: {count}; with --top {all_of_them}, rank lists all."


@pytest.mark.parametrize(
    ("values", "corrections", "places"),
    [
        ([10.0, 9.0, 8.0], None, [1, 2, 3]),
        ([10.0, 10.0, 8.0], [0.0, 0.0, 0.0], [1, 1, 3]),
        ([10.0, 9.0, 8.0], [-0.5, 0.5, 0.4], [1, 1, 3]),  # the limits of both may be equal
        ([10.0, 9.5, 9.0], [-0.3, 0.3, -0.3], [1, 1, 3]),  # the third ties with the second only
        ([10.0, 9.0, 8.0, 1.0], [0.1, -0.1, 2.0, 0.1], [1, 2, 2, 4]),  # not the first above all
        ([1.0, 1.2, 2.0], [0.2, NAN, 0.1], [1, 1, 3]),  # least is best; a missing one is 0
        ([5.0, 4.5, 4.4], [NAN, 0.3, -0.6], [1, 2, 2]),
        ([1.0, 1.2, 2.0], [NAN, NAN, NAN], [1, 2, 3]),
    ],
)
def test_values_share_the_place_of_the_first_that_their_corrections_reach(
    values, corrections, places
):
    corrections = None if corrections is None else pd.Series(corrections)
    assert list(shared_places(pd.Series(values), corrections)) == places


def test_values_share_a_place_if_one_of_them_is_known_far_less_well():
    """Its corrections by mesh and by steps may cancel."""
    values, errors = pd.Series([10.0, 9.7, 9.5, 9.0]), pd.Series([0.1, 0.5, 0.3, NAN])
    assert list(shared_places(values, None, errors)) == [1, 1, 3, 4]
    assert list(shared_places(values, 0.0 * errors, 0.0 * errors + 0.9)) == [1, 2, 3, 4]


def test_large_errors_need_not_be_common():
    values, none = pd.Series([10.0, 9.0, 8.5]), pd.Series([0.0, 0.0, 0.0])
    assert list(shared_places(values, none, none + 1.2)) == [1, 1, 3]
    assert list(shared_places(values, none, pd.Series([1.2, 0.4, 1.2]))) == [1, 2, 2]


def test_errors_that_all_designs_share_make_no_ties():
    table = summary(*with_bars([10.0, 9.5, 8.0, 7.9], [0.7] * 4))
    correction = "correction_absorbed_energy_until_packed_J"
    assert list(rank(table.assign(**{correction: 1e-3}))["place"]) == [1, 2, 3, 4]
    apart = table.assign(**{correction: [1e-3, 1e-3, -1e-3, -0.8e-3]})
    assert list(rank(apart, panel=PANEL)["place"]) == [1, 2, 2, 2]
    assert list(rank(apart)["tied"]) == [False, True, True, True]


def test_ties_are_marked_also_where_the_other_is_not_shown():
    table = summary(*with_bars([10.0, 9.0, 8.0, 7.9], [0.6, 0.6, 0.16, 0.1]))
    ranking = ranked(table, top=3)
    places = ranking.table
    assert ids(places) == [0, 1, 2]
    assert list(places["place"]) == [1, 1, 3]
    assert places["tied"].all()
    assert list(places["ranked_error"]) == pytest.approx([6e-4, 6e-4, 1.6e-4])
    assert list(places.columns[:8]) == [
        *("budget_g", "scene", "place", "tied", "pareto", "case_id", "ranked_by", "ranked_error")
    ]
    (sheet,) = ranking_sheets(ranking, table)
    assert [row[0] for row in sheet.rows] == ["1=*", "1= ", "3= "]
    assert sheet.notes == ("1 more tied for place 3.", not_shown("1 more", 4))
    assert (sheet.heads[-1], [row[-1] for row in sheet.rows]) == ("± %", ["6.0", "6.7", "2.0"])
    assert legend(ranking).endswith(TIED)


def test_missing_bars_hide_nothing_and_small_ones_are_not_zero():
    table = summary(*with_bars([10.0, 9.9, 8.0, 6.0], [0.004, NAN, 0.006, 0.0]))
    ranking = ranked(table)
    assert (list(ranking.table["place"]), ranking.without_bar) == ([1, 2, 3, 4], 1)
    (sheet,) = ranking_sheets(ranking, table)
    assert [row[-1] for row in sheet.rows] == ["< 0.1", "?", "0.1", "0.0"]


@pytest.mark.parametrize(
    ("asked", "told"),
    [
        ({"top": 1}, ["3 more tied for place 1.", not_shown("3 more", 4)]),
        ({"top": 4}, []),
        ({"top": None}, []),
        (
            {"top": 2, "budget": ["1 g", "2 g", "3 g"]},
            [
                "Up to 1-2 g, 1 more tied for place 1.",
                "Up to 3 g, 2 more tied for place 1.",
                not_shown("1 more up to 1 g, 1 more up to 2 g, 2 more up to 3 g", 4),
            ],
        ),
    ],
)
def test_what_is_cut_off_is_counted_for_each_budget(asked, told):
    table = summary(*with_bars([10.0, 9.9, 9.8, 9.7], [0.5] * 4))
    table["mass_g"] = [3.0, 1.0, 1.0, 1.0]
    ranking = ranked(table, by="absorbed_energy_J", **asked)
    (sheet,) = ranking_sheets(ranking, table)
    assert list(sheet.notes) == told
    within = {1.0: 3, 2.0: 3}
    counts = [within.get(budget, 4) for budget in ranking.table["budget_g"]]
    assert list(ranking.table["contenders"]) == list(ranking.table["sharing"]) == counts


@pytest.mark.parametrize("by", [None, "peak_strain"])
def test_without_error_bars_equal_values_are_tied_and_nothing_speaks_of_errors(by):
    table = summary(*designs([1.0, 1.0], [0.1, 0.1]), dict(mass_g=3.0, peak_strain=0.01))
    ranking = ranked(table, by=by)
    assert "ranked_error" not in ranking.table
    assert (TIED in legend(ranking), ranking.without_bar) == (False, 0)
    assert EQUAL in legend(ranking)
    (sheet,) = ranking_sheets(ranking, table)
    assert [row[0] for row in sheet.rows] == ["1=*", "1=*", "3 "]


def test_error_bars_follow_into_what_is_derived():
    table = summary(*with_bars([100.0, 80.0], [5.0, 2.0], returned_energy_J=0.01))
    table["mass_g"] = [2.0, 1.0]
    per_gram = rank(table)  # 0.080 ± 0.002 and 0.050 ± 0.0025 J/g
    assert list(per_gram["ranked_error"]) == pytest.approx([2e-3, 2.5e-3])
    panel = rank(table, panel=PANEL)
    factor = 0.130 * 0.050 / (13e-3 * 10e-3)
    assert panel.loc[0, "ranked_error"] == pytest.approx(factor * 5e-3)
    assert list(panel["error_panel_force_N"]) == [25.0, 25.0]
    assert list(rank(table, by="passed_on_N")["ranked_error"]) == [0.5, 0.5]


def test_command_line_tells_ties_and_what_has_no_bar(capsys, tmp_path, monkeypatch):
    monkeypatch.setenv("COLUMNS", "100")
    file = write(tmp_path / "trial.h5", summary(*with_bars([10.0, 9.0, 1.0], [0.6, 0.6, NAN])))
    text = crumple(capsys, "rank", file, "--panel", "100 mm", "50 mm")[1]
    assert all(words in text for words in ("1=*", TIED, "1 ranked case has no error bar: "))
    records = json.loads(crumple(capsys, "rank", file, "--json")[1])
    assert [(row["place"], row["tied"]) for row in records] == [(1, True), (1, True), (3, False)]
    assert records[2]["ranked_error"] is None


@pytest.mark.parametrize(
    ("lowest", "highest", "places"),
    [
        ([0.4, 0.15, 0.2], [0.4, 0.42, 0.2], [1, 1, 3]),
        ([0.4, 0.15, 0.2], [0.4, 0.35, 0.2], [1, 2, 2]),
        ([0.32, 0.3, 0.2], [0.4, 0.35, 0.2], [1, 1, 3]),
    ],
)
def test_energies_that_stand_for_a_range_tie_where_their_ranges_meet(lowest, highest, places):
    """As the efficiency of a design has two maxima."""
    column = "absorbed_energy_at_densification_J"
    rows = summary(*designs([1.0, 1.0, 1.0], [0.4, 0.3, 0.2]))
    ranged = rows.assign(**{f"lowest_{column}": lowest, f"highest_{column}": highest})
    for panel in (None, PANEL):
        table = rank(ranged, panel=panel)
        assert list(table["place"]) == places
        assert list(table["tied"]) == [places.count(place) > 1 for place in places]
    assert list(rank(ranged, by="absorbed_energy_J")["place"]) == [1, 2, 3]


def test_doubtful_designs_come_last_and_tie_with_none_that_is_not():
    table = summary(*with_bars([12.0, 11.0, 11.5, 10.0], [1.0] * 4))
    table = rank(table.assign(max_crossings=[1, 1, 0, 0]))
    assert ids(table) == [2, 3, 0, 1]
    assert list(table["place"]) == [1, 1, 3, 3]
    assert list(table["passed_over"]) == [1, 2, 0, 0]
    assert list(table["pareto"]) == [True, False, False, False]
