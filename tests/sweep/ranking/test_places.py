"""Ties: places that error bars cannot tell apart, in rankings, tables and on the command line."""

import io
import json

import numpy as np
import pandas as pd
import pytest

from sweep.__main__ import main
from sweep.ranking.places import shared_places
from sweep.ranking.rank import rank, ranked
from sweep.report.tables.legend import TIED, legend
from sweep.report.tables.sheets import ranking_sheets
from tests.support.results.specimens import designs, ids, summary, write

NAN = float("nan")


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


@pytest.mark.parametrize(
    ("values", "corrections", "places"),
    [
        ([10.0, 9.0, 8.0], None, [1, 2, 3]),
        ([10.0, 10.0, 8.0], None, [1, 1, 3]),
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


def test_errors_that_all_designs_share_make_no_ties():
    """Two designs tie if their values differ by no more than their corrections do."""
    table = summary(*with_bars([10.0, 9.5, 8.0, 7.9], [0.9] * 4))
    table["correction_absorbed_energy_until_packed_J"] = [1e-3] * 4
    assert list(ranked(table).table["place"]) == [1, 2, 3, 4]
    table["correction_absorbed_energy_until_packed_J"] = [1e-3, 1e-3, -1e-3, -0.8e-3]
    assert list(ranked(table, panel=(0.1, 0.05)).table["place"]) == [1, 2, 2, 2]
    assert list(ranked(table).table["tied"]) == [False, True, True, True]


def test_ties_are_marked_also_where_the_other_is_not_shown():
    table = summary(*with_bars([10.0, 9.0, 8.0, 7.9], [0.6, 0.6, 0.16, 0.1]))
    ranking = ranked(table, top=3)
    places = ranking.table
    assert list(places["absorbed_energy_J"]) == pytest.approx([0.010, 0.009, 0.008])
    assert list(places["place"]) == [1, 1, 3]
    assert list(places["tied"]) == [True, True, True]
    assert list(places["ranked_error"]) == pytest.approx([6e-4, 6e-4, 1.6e-4])
    assert list(places.columns[:8]) == [
        *("budget_g", "scene", "place", "tied", "pareto", "case_id", "ranked_by", "ranked_error")
    ]
    (sheet,) = ranking_sheets(ranking, table)
    assert [row[0] for row in sheet.rows] == ["1=*", "1= ", "3= "]
    assert sheet.notes == ("1 more tied for place 3.", not_shown("1 more", 4))
    assert (sheet.heads[-1], [row[-1] for row in sheet.rows]) == ("± %", ["6.0", "6.7", "2.0"])
    assert legend(ranking).endswith(TIED)


def test_an_error_too_small_for_its_digits_is_not_zero():
    table = summary(*with_bars([10.0, 8.0, 6.0], [0.004, 0.006, 0.0]))
    (sheet,) = ranking_sheets(ranked(table), table)
    assert (sheet.heads[-1], [row[-1] for row in sheet.rows]) == ("± %", ["< 0.1", "0.1", "0.0"])


def test_ties_that_are_cut_off_are_counted_for_each_budget():
    table = summary(*with_bars([10.0, 9.9, 9.8, 9.7], [0.5] * 4))
    table["mass_g"] = [3.0, 1.0, 1.0, 1.0]

    def notes(**asked):
        (sheet,) = ranking_sheets(ranked(table, by="absorbed_energy_J", **asked), table)
        return tuple(note for note in sheet.notes if "tied for" in note)

    assert notes(top=1) == ("3 more tied for place 1.",)
    assert notes(top=4) == notes(top=None) == ()
    several = notes(top=2, budget=["1 g", "2 g", "3 g"])
    assert several == (
        "Up to 1-2 g, 1 more tied for place 1.",
        "Up to 3 g, 2 more tied for place 1.",
    )
    assert notes(top=1, budget=["0.1 g", "3 g"])[0] == "Up to 3 g, 3 more tied for place 1."
    assert list(rank(table, by="absorbed_energy_J", top=2)["sharing"]) == [4, 4]


def test_without_error_bars_nothing_speaks_of_them():
    table = summary(*designs([1.0, 1.0], [0.1, 0.1]))
    ranking = ranked(table)
    assert not {"tied", "ranked_error"} & set(ranking.table)
    assert TIED not in legend(ranking)
    assert ranking.without_bar == 0
    (sheet,) = ranking_sheets(ranking, table)
    assert [row[0] for row in sheet.rows] == ["1*", "1*"]


def test_missing_error_bar_hides_nothing_and_is_counted():
    table = summary(*with_bars([10.0, 9.9], [0.01, NAN]))
    ranking = ranked(table)
    assert list(ranking.table["place"]) == [1, 2]
    assert ranking.without_bar == 1
    (sheet,) = ranking_sheets(ranking, table)
    assert [row[-1] for row in sheet.rows] == ["0.1", "?"]


def test_error_bars_follow_into_what_is_derived():
    table = summary(*with_bars([100.0, 80.0], [5.0, 2.0], returned_energy_J=0.01))
    table["mass_g"] = [2.0, 1.0]
    per_gram = rank(table)
    assert list(per_gram["place"]) == [1, 2]  # 0.080 ± 0.002 and 0.050 ± 0.0025 J/g
    assert list(per_gram["ranked_error"]) == pytest.approx([2e-3, 2.5e-3])
    panel = rank(table, panel=("130 mm", "50 mm"))
    factor = 0.130 * 0.050 / (13e-3 * 10e-3)
    assert panel.loc[0, "ranked_error"] == pytest.approx(factor * 5e-3)
    assert list(panel["error_passed_on_N"]) == [0.5, 0.5]
    assert list(panel["error_panel_force_N"]) == [25.0, 25.0]
    assert list(rank(table, by="passed_on_N")["ranked_error"]) == [0.5, 0.5]


def test_budgets_share_a_section_only_where_their_ties_are_alike():
    table = summary(*with_bars([10.0, 9.9], [0.01, 0.2]))
    table["mass_g"] = [1.0, 3.0]
    ranking = ranked(table, budget=["1 g", "2 g", "3 g"], top=1)
    (sheet,) = ranking_sheets(ranking, table)
    assert [row[:2] for row in sheet.rows] == [["1-2", "1*"], ["3", "1=*"]]
    more = not_shown("1 more up to 3 g", 2)
    assert sheet.notes == ("Up to 3 g, 1 more tied for place 1.", more)


def test_what_is_not_shown_is_counted_for_each_budget():
    table = summary(*designs([1.0, 2.0, 2.5, 3.0], [0.4, 0.3, 0.2, 0.1]))

    def notes(**asked):
        ranking = ranked(table, **asked)
        (sheet,) = ranking_sheets(ranking, table)
        return list(ranking.table["contenders"].unique()), sheet.notes

    assert notes() == ([4], ())
    assert notes(top=3) == ([4], (not_shown("1 more", 4),))
    assert notes(top=1, budget="2 g") == ([2], (not_shown("1 more", 2),))
    of, told = notes(top=2, budget=["1 g", "2 g", "2.5 g", "3 g"])
    assert of == [1, 2, 3, 4]
    assert told == (not_shown("1 more up to 2.5 g, 2 more up to 3 g", 4),)


def not_shown(count, all_of_them):
    """The note below a table that does not show them all."""
    return f"Not shown: {count}; with --top {all_of_them}, rank lists all."


def test_command_line_tells_ties_and_what_has_no_bar(capsys, tmp_path, monkeypatch):
    monkeypatch.setenv("COLUMNS", "80")
    rows = with_bars([10.0, 9.0, 1.0], [0.6, 0.6, NAN])
    file = write(tmp_path / "trial.h5", summary(*rows))
    question = ["rank", file, "--panel", "100 mm", "50 mm", "--budget", "400 g"]
    assert main(question) == 0
    text = capsys.readouterr().out
    assert "1=*" in text
    assert TIED in text
    assert "1 ranked case has no error bar: placed by value alone." in text
    assert max(len(line) for line in text.splitlines()) <= 100

    main([*question, "--csv"])
    table = pd.read_csv(io.StringIO(capsys.readouterr().out))
    assert list(table["tied"]) == [True, True, False]
    assert {"ranked_error", "error_absorbed_energy_J", "error_panel_energy_J"} <= set(table)
    main([*question, "--json"])
    records = json.loads(capsys.readouterr().out)
    assert [record["place"] for record in records] == [1, 1, 3]
    assert records[2]["ranked_error"] is None
    main([*question, "--markdown"])
    assert "| 1=*" in capsys.readouterr().out


def test_energies_that_stand_for_a_range_tie_where_their_ranges_meet():
    """The energy per gram of the second is 0.15 or 0.42 J/g, as its efficiency has two maxima."""
    column = "absorbed_energy_at_densification_J"
    rows = summary(*designs([1.0, 1.0, 1.0], [0.4, 0.3, 0.2]))
    ranged = rows.assign(
        **{f"lowest_{column}": [0.4, 0.15, 0.2], f"highest_{column}": [0.4, 0.42, 0.2]}
    )
    table = rank(ranged)
    assert list(table["place"]) == [1, 1, 3]
    assert list(table["tied"]) == [True, True, False]
    assert list(rank(ranged, panel=("130 mm", "50 mm"))["place"]) == [1, 1, 3]
    assert "tied" not in rank(rows)
    assert list(rank(ranged, by="absorbed_energy_J")["place"]) == [1, 2, 3]
    ranged.loc[1, f"highest_{column}"] = 0.35
    assert list(rank(ranged)["place"]) == [1, 2, 2]
    ranged.loc[1, f"lowest_{column}"], ranged.loc[0, f"lowest_{column}"] = 0.3, 0.32
    assert list(rank(ranged)["place"]) == [1, 1, 3]


def test_doubtful_designs_come_last_and_tie_with_none_that_is_not():
    rows = with_bars([12.0, 11.0, 11.5, 10.0], [1.0] * 4)
    for row in rows[:2]:
        row["max_crossings"] = 1
    table = summary(*rows)
    assert ids(rank(table)) == [2, 3, 0, 1]
    assert list(rank(table)["place"]) == [1, 1, 3, 3]
    assert list(rank(table)["passed_over"]) == [1, 2, 0, 0]
    assert list(rank(table)["pareto"]) == [True, False, False, False]
