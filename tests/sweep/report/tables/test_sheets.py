"""Rankings as tables of text: notes, and budgets that share a section."""

import pytest

from sweep.ranking.rank import ranked
from sweep.report.tables.design_text import design_labels, design_text
from sweep.report.tables.markdown import markdown
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


def test_a_scene_in_which_all_cases_failed_is_named():
    stopped = {"status": "stopped", "loaded": 0, "platen": "contact"}
    table = summary(CRUSHED_SOLID, stopped, stopped)
    first, lost = ranking_sheets(ranked(table), table)
    assert (len(first.rows), lost.rows) == (1, [])
    assert "contact platens" in lost.title
    assert lost.notes == ("No design is ranked here: all cases failed (2).",)


def test_a_budget_below_all_designs_is_one_sentence_and_no_table():
    rows = designs([1.0, 2.0], [0.4, 0.5]) + designs([3.0], [0.5], platen="contact")
    table = summary(*rows)
    nothing = (
        "No design weighs {} g or less; the lightest weighs {} g, "
        "case 000000000000000{}, ninjaflex."
    )
    (sheet,) = ranking_sheets(ranked(table, budget=["0.5 g", "0.7 g"]), table)
    assert (sheet.title, sheet.heads, sheet.rows) == ("", [], [])
    assert sheet.notes == (nothing.format(0.5, 1, 0), nothing.format(0.7, 1, 0))
    assert markdown([sheet]) == "\n".join([*sheet.notes, ""])
    glued, loose = ranking_sheets(ranked(table, budget=["0.5 g", "2 g"]), table)
    assert (len(glued.rows), glued.notes) == (2, (nothing.format(0.5, 1, 0),))
    assert (loose.title, loose.heads) == ("crushed to 50 %, contact platens", [])
    assert loose.notes == (nothing.format(0.5, 3, 2), nothing.format(2, 3, 2))
    assert markdown([loose]).splitlines()[::2] == [f"### {loose.title}", loose.notes[0]]


def test_a_scene_in_which_nothing_has_a_place_says_so():
    table = summary({}, {"platen": "contact", "densification_strain": NAN})
    _, sheet = ranking_sheets(ranked(table, by="densification_strain"), table)
    assert (sheet.heads, sheet.notes) == ([], ("No design is ranked here.",))


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
    behaviour = sorted(row[sheet.heads.index("behaviour")] for row in sheet.rows)
    assert behaviour == ["elastic", "softens"]
    table = summary({}, {})
    (sheet,) = ranking_sheets(ranked(table), table)
    assert "behaviour" not in sheet.heads


def test_the_sorted_column_is_never_spare():
    table = summary({"second_cycle_share": 0.7}, {"second_cycle_share": 0.8})
    heads = {None: "J/g", "second_cycle_share": "cycle 2 %", "returned_share": "returned %"}
    for by, head in heads.items():
        (sheet,) = ranking_sheets(ranked(table, by=by), table)
        assert head not in sheet.spare
        others = {"cycle 2 %", "returned %", "dens. %", "peak N", "mass g"} - {head}
        assert others <= set(sheet.spare) < set(sheet.heads)


@pytest.mark.parametrize("by", ["lost_energy_J", "lost_share", "lost_energy_J_per_g"])
def test_what_is_lost_ranks_designs(by):
    table = summary({by: 0.1}, {by: 0.3}, {by: NAN})
    ranking = ranked(table, by=by)
    assert [int(case_id) for case_id in ranking.table["case_id"]] == [1, 0]
    (sheet,) = ranking_sheets(ranking, table)
    assert sheet.heads[-1] == by


def test_budgets_with_the_same_places_share_a_section():
    table = summary(*designs([1.0, 2.0], [0.3, 0.1]), {"mass_g": 9.0, "absorbed_energy_J": 0.9})
    ranking = ranked(table, budget=["1 g", "3 g", "5 g", "9 g"], top=1)
    sheet = next(ranking_sheets(ranking, table))
    assert [row[:2] for row in sheet.rows] == [["1-5", "1*"], ["9", "1*"]]


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


def test_budgets_come_back_in_ounces():
    table = summary(CRUSHED_SOLID, SPARSE)
    (sheet,) = ranking_sheets(ranked(table, budget=["1 oz", "1.5 oz"]), table)
    assert sheet.heads[0] == "up to oz"
    assert sheet.rows[0][0] == "1-1.5"
