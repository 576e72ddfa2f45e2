"""Marks of what is not to be trusted, or not the whole of it."""

from sweep.ranking.rank import rank, ranked
from sweep.report.sheets import BEYOND, CROSSED, EARLY, ranking_sheets
from tests.support.specimens import CRUSHED_SOLID, SPARSE, summary

NAN = float("nan")


def test_energy_of_the_whole_crush_is_marked_where_the_model_does_not_hold_it():
    table = summary(CRUSHED_SOLID, SPARSE)
    ranking = ranked(table, by="absorbed_energy_J")
    assert [int(case_id) for case_id in ranking.table["case_id"]] == [0, 1]
    assert list(ranking.table["passed_on_N"]) == [900.0, 25.0]
    assert list(ranking.table["beyond_model"]) == [True, False]
    (sheet,) = ranking_sheets(ranking, table)
    assert [row[0] for row in sheet.rows] == ["1*!", "2 "]
    assert sheet.notes == (BEYOND,)
    (sheet,) = ranking_sheets(ranked(table), table)
    assert sheet.notes == ()


def test_a_crush_that_ends_below_the_allowed_force_absorbs_at_least_so_much():
    given = {"absorbed_energy_at_50N_J": 0.2, "loading.allowed_forces": 50.0}
    table = summary(CRUSHED_SOLID | given, SPARSE | given)
    (sheet,) = ranking_sheets(ranked(table, allowed_force=50.0), table)
    energy = sheet.heads.index("absorbs mJ")
    assert sorted(row[energy] for row in sheet.rows) == ["200", "> 200"]
    assert EARLY in sheet.notes
    (sheet,) = ranking_sheets(ranked(table), table)
    assert not any(text.startswith(">") for row in sheet.rows for text in row[:energy])


def test_what_is_pressed_into_less_than_its_solid_is_marked():
    """A striker that has used up more than the voids, a dead load on the ground."""
    struck = {"loading_mode": "impact", "striker_mass_g": 50.0, "peak_force_N": 9.0}
    table = summary(struck | {"stroke_left_m": -1e-4}, struck | {"stroke_left_m": 1e-4})
    assert list(rank(table)["beyond_model"]) == [True, False]
    held = {"loading_mode": "force", "force_N": 5.0, "stroke_left_m": NAN}
    table = summary(held | {"peak_strain": 0.99}, held | {"peak_strain": 1.03})
    assert list(rank(table)["beyond_model"]) == [False, True]


def test_walls_that_pass_through_one_another_are_marked():
    table = summary(CRUSHED_SOLID, SPARSE | {"contact_model": "none", "max_crossings": 3})
    ranking = ranked(table, by="absorbed_energy_J")
    assert list(ranking.table["crossed"]) == [False, True]
    (sheet,) = ranking_sheets(ranking, table)
    assert [row[0] for row in sheet.rows] == ["1*!", "2 x"]
    assert sheet.notes == (BEYOND, CROSSED)
