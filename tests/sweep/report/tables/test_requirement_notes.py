"""Requirements in sentences and columns."""

import pytest

from sweep.ranking.rank import ranked
from sweep.report.tables.legend import legend
from sweep.report.tables.requirement_notes import quantity
from sweep.report.tables.sheets import ranking_sheets
from tests.support.results.specimens import CRUSHES, IMPACTS

NAN = float("nan")
PANEL = ("130 mm", "50 mm")  # 50 specimens


def test_what_is_required_is_shown():
    (sheet,) = ranking_sheets(ranked(IMPACTS, require={"max_deceleration": 600.0}), IMPACTS)
    assert sheet.rows[0][sheet.heads.index("decel. g0")] == "51.0"
    ranking = ranked(IMPACTS, by="peak_deceleration_filtered_m_per_s2")
    (sheet,) = ranking_sheets(ranking, IMPACTS)
    assert sheet.heads[-1] == "decel. g0"
    assert "decel.: greatest deceleration of the striker, filtered" in legend(ranking)


@pytest.mark.parametrize("asked", [{"max_stroke": "7 mm"}, {"max_force": "70 N"}])
def test_stroke_is_shown_where_it_or_the_force_is_limited(asked):
    ranking = ranked(CRUSHES, require=asked)
    (sheet,) = ranking_sheets(ranking, CRUSHES)
    assert {row[sheet.heads.index("stroke mm")] for row in sheet.rows} == {"6.75"}
    assert "stroke: over which the energy counts" in legend(ranking)
    (sheet,) = ranking_sheets(ranked(CRUSHES), CRUSHES)
    assert "stroke mm" not in sheet.heads


def test_stroke_up_to_an_allowed_force_is_shown_if_the_curves_are_known():
    table = CRUSHES.assign(absorbed_energy_at_50N_J=0.1)
    (sheet,) = ranking_sheets(ranked(table, allowed_force="50 N"), table)
    assert "stroke mm" not in sheet.heads
    table["stroke_at_allowed_m"] = 3e-3
    (sheet,) = ranking_sheets(ranked(table, allowed_force="50 N"), table)
    assert {row[sheet.heads.index("stroke mm")] for row in sheet.rows} == {"3.00"}


@pytest.mark.parametrize(("table", "head"), [(CRUSHES, "peak N"), (IMPACTS, "force N")])
def test_force_of_the_panel_stands_beside_that_of_the_specimen(table, head):
    ranking = ranked(table, panel=PANEL)
    (sheet,) = ranking_sheets(ranking, table)
    assert "panel N" in sheet.heads
    for row in sheet.rows:
        one, all_of = (float(row[sheet.heads.index(name)]) for name in (head, "panel N"))
        assert all_of == 50.0 * one
    assert "panel N: force of the 50 separate specimens of a panel together." in legend(ranking)
    assert "panel N" not in legend(ranked(table))


def test_number_of_specimens_is_a_range_if_designs_differ_in_width():
    table = CRUSHES.assign(outer_width_m=[13e-3, 13e-3, 14e-3])
    assert "of the 45 to 50 separate specimens of a panel" in legend(ranked(table, panel=PANEL))


def test_quantities_are_those_of_a_maker():
    assert quantity("max_deceleration", 80 * 9.80665) == "80 g0"
    assert quantity("max_mass", 0.0567) == "56.7 g"
    assert quantity("max_force", 12345.6, digits=3) == "12300 N"


@pytest.mark.parametrize(
    ("asked", "told"),
    [
        (("130 mm", "50 mm"), ""),
        (("130 mm", "56 mm"), "7 % from the 130 x 56 mm"),
        (("130 mm", "54 mm"), "7 % from the 130 x 54 mm"),
    ],
)
def test_a_panel_of_another_size_than_that_of_the_question_is_told(asked, told):
    words = legend(ranked(CRUSHES, panel=asked))
    assert ("of the question" in words) == bool(told)
    assert f"make a panel whose sides differ by up to {told}" in words or not told


def test_a_panel_of_one_specimen_has_no_neighbours():
    table = CRUSHES.assign(outer_width_m=50e-3, depth_m=50e-3)
    words = legend(ranked(table, panel=("50 mm", "50 mm")))
    assert "which is one specimen of" in words
    assert "neighbours" not in words


def test_masses_of_tied_sides_are_of_one_period():
    words = legend(ranked(CRUSHES.assign(sides="tied, fixed period")))
    assert "mass: of one period" in words
    assert "of the part" not in words


def test_along_the_cells_it_is_said_that_walls_are_at_their_first_loading():
    assert "at their first loading" in legend(ranked(CRUSHES.assign(direction="out_of_plane")))
    assert "first loading" not in legend(ranked(CRUSHES))
    sheets = legend(ranked(CRUSHES.assign(lattice_kind="gyroid")))
    assert "of sheets are of walls as drawn, at their first loading" in sheets
    assert "long the cells" not in sheets


def test_the_base_pressure_that_sorts_is_shown_once():
    struck = IMPACTS.assign(peak_base_pressure_Pa=[2e5, 3e5])
    (sheet,) = ranking_sheets(ranked(struck, by="peak_base_pressure_Pa"), struck)
    assert sheet.heads[-1] == "base kPa"
    assert "peak_base_pressure_Pa" not in sheet.heads
