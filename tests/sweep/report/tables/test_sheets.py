"""Rankings as tables of text: notes, and budgets that share a section."""

import pytest

from sweep.ranking.rank import ranked
from sweep.report.tables.design_text import design_labels, design_text
from sweep.report.tables.legend import legend
from sweep.report.tables.sheets import OPEN, ranking_sheets
from tests.support.results.specimens import CRUSHED_SOLID, SPARSE, designs, summary

NAN = float("nan")
UPRIGHT = {"direction": "out_of_plane", "solid_strain": 0.7, "peak_strain": 0.6}


@pytest.mark.parametrize(("energy", "is_open"), [(0.1, True), (0.3, False)])
def test_a_first_place_is_open_if_a_longer_crush_may_change_it(energy, is_open):
    given = {"loading.allowed_forces": 50.0, "mass_g": 1.0}
    ended = SPARSE | given | {"absorbed_energy_at_50N_J": energy}
    table = summary(CRUSHED_SOLID | given | {"absorbed_energy_at_50N_J": 0.2}, ended)
    (sheet,) = ranking_sheets(ranked(table, allowed_force=50.0), table)
    assert (OPEN in sheet.notes) == is_open


def test_a_scene_in_which_nothing_has_a_place_is_named():
    failed = [{"status": "stopped", "loaded": 0, "platen": "contact"}] * 2
    table = summary(CRUSHED_SOLID, *failed, {"platen": "x", "densification_strain": NAN})
    first, unmeasured, lost = ranking_sheets(ranked(table, by="densification_strain"), table)
    assert (len(first.rows), unmeasured.heads, lost.rows) == (1, [], [])
    assert unmeasured.notes == ("No design is ranked here.",)
    assert "contact platens" in lost.title
    assert lost.notes[0] == "No design is ranked here: all cases failed (2)."
    assert [note.split(":")[0] for note in lost.notes[1:]] == ["Unfinished", "Unfinished"]


def test_a_budget_below_all_designs_is_one_sentence_and_no_table():
    rows = designs([1.0, 2.0], [0.4, 0.5]) + designs([3.0], [0.5], platen="contact")
    table = summary(*rows)

    def nothing(budget, lightest, number):
        start = f"No design weighs {budget} g or less; the lightest weighs {lightest} g, "
        return f"{start}case {number:016x}, ninjaflex."

    (sheet,) = ranking_sheets(ranked(table, budget=["0.5 g", "0.7 g"]), table)
    assert (sheet.title, sheet.heads, sheet.rows) == ("", [], [])
    assert sheet.notes == (nothing(0.5, 1, 0), nothing(0.7, 1, 0))
    glued, loose = ranking_sheets(ranked(table, budget=["0.5 g", "2 g"]), table)
    assert (len(glued.rows), glued.notes) == (2, (nothing(0.5, 1, 0),))
    assert (loose.title, loose.heads) == ("crushed to 50 %, contact platens", [])
    assert loose.notes == (nothing(0.5, 3, 2), nothing(2, 3, 2))


def test_unfinished_cases_stand_below_their_scene_if_all_designs_are_too_heavy():
    lost = {"status": "stopped", "loaded": 0, "platen": "contact", "mass_g": 0.4}
    table = summary(*designs([1.0, 2.0], [0.4, 0.5]), lost)
    heavy, failed = ranking_sheets(ranked(table, budget="0.5 g"), table)
    assert [note[:16] for note in heavy.notes] == ["No design weighs"]
    assert "contact platens" in failed.title
    assert [note[:10] for note in failed.notes] == ["No design ", "Unfinished"]


def test_what_comes_back_and_what_has_not_packed_is_told():
    nowhere = {"densification_strain": NAN, "packing_strain": NAN, "peak_strain": NAN}
    table = summary(CRUSHED_SOLID, SPARSE, SPARSE | nowhere)
    ranking = ranked(table)
    assert list(ranking.table["returned_share"]) == pytest.approx([0.95, 0.95, 0.9])
    (sheet,) = ranking_sheets(ranking, table)
    assert sheet.heads[-2:] == ["dens. %", "returned %"]
    assert [row[-2:] for row in sheet.rows] == [["> 50", "95"], ["–", "95"], ["54", "90"]]


def test_behaviour_of_walls_is_shown_where_it_differs():
    table = summary({}, {"material_memory": "softens"})
    (sheet,) = ranking_sheets(ranked(table), table)
    assert sorted(sheet.columns[sheet.heads.index("behaviour")]) == ["elastic", "softens"]
    (sheet,) = ranking_sheets(ranked(table[:1]), table[:1])
    assert "behaviour" not in sheet.heads


def test_the_sorted_column_is_never_spare():
    table = summary({"second_cycle_share": 0.7}, {"second_cycle_share": 0.8})
    heads = {None: "J/g", "second_cycle_share": "cycle 2 %", "returned_share": "returned %"}
    for by, head in heads.items():
        (sheet,) = ranking_sheets(ranked(table, by=by), table)
        assert head not in sheet.spare
        others = {"cycle 2 %", "returned %", "dens. %", "peak N", "mass g"} - {head}
        assert others <= set(sheet.spare) < set(sheet.heads)
        assert sorted(sheet.columns[sheet.heads.index("cycle 2 %")]) == ["70", "80"]


@pytest.mark.parametrize(
    ("budgets", "head", "cells"),
    [
        (["1 g", "3 g", "5 g", "9 g"], "up to g", [["1-5", "1*"], ["9", "1*"]]),
        (["0.1 oz", "0.4 oz"], "up to oz", [["0.1", "1*"], ["0.4", "1*"]]),
    ],
)
def test_budgets_with_the_same_places_share_a_section(budgets, head, cells):
    table = summary(*designs([1.0, 2.0, 9.0], [0.3, 0.1, 0.9]))
    sheet = next(ranking_sheets(ranked(table, budget=budgets, top=1), table))
    assert sheet.heads[0] == head
    assert [row[:2] for row in sheet.rows] == cells


def test_both_directions_stand_side_by_side_in_one_ranking():
    """The direction belongs to the design, also as a key of the grid."""
    across = {"absorbed_energy_J": 0.1, "loading.direction": "in_plane"}
    along = {"absorbed_energy_J": 1.8, "loading.direction": "out_of_plane"} | UPRIGHT
    along |= {"depth_m": 13e-3}  # of the plan
    table = summary(across, along)
    (sheet,) = ranking_sheets(ranked(table), table)
    assert sheet.heads[:2] == ["#", "pressed"]
    assert [row[1] for row in sheet.rows] == ["along", "across"]
    assert design_labels(table, table) == ["pressed across", "pressed along"]
    assert "pressed" not in design_text(table.iloc[:1], table.iloc[:1])


def test_a_structure_of_a_file_has_its_work_and_no_columns_of_a_crush():
    table = summary({"loading_mode": "custom", "peak_strain": 0.3, "densification_strain": NAN})
    ranking = ranked(table)
    (sheet,) = ranking_sheets(ranking, table)
    assert sheet.heads == ["#", "mass g", "absorbed mJ", "J/g"]
    assert "absorbed: work done" in legend(ranking)
