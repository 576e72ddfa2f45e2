"""Requirements in sentences and columns."""

import pytest

from sweep.ranking.rank import ranked
from sweep.report.requirement_notes import quantity, required
from sweep.report.sheets import legend, ranking_sheets
from tests.support.specimens import designs, summary

NAN = float("nan")
PANEL = ("130 mm", "50 mm")  # 50 specimens
CRUSHED = summary(*designs([1.0, 2.0, 3.0], [0.10, 0.18, 0.40], height_m=12.5e-3)).assign(
    peak_force_until_packed_N=[20.0, 30.0, 80.0]
)
HIT = {"loading_mode": "impact", "stroke_m": NAN, "striker_mass_g": 50.0, "height_m": 12.5e-3}
STRUCK = summary(
    *(
        HIT | {"peak_force_N": force, "impact_energy_J": 1.5, "peak_strain": 0.5}
        for force in (76.0, 90.0)
    )
).assign(peak_deceleration_filtered_m_per_s2=[500.0, NAN])


def notes(table, **question):
    """Notes below the only table of a ranking."""
    (sheet,) = ranking_sheets(ranked(table, **question), table)
    return sheet.notes


def test_none_passes_less():
    assert notes(STRUCK, require={"max_force": "60 N"}) == (
        "No design has a place here.",
        "Required of a specimen: force at most 60 N.",
        "0 of 2 designs fulfil this; 2 fail: max_force (2).",
        "None passes less than 60 N; the best is 76 N.",
        "1.50 J at 60 N needs at least 25.0 mm of stroke, if the force is constant:\n"
        "energy / force, a rectangle, which no real curve is. The lattice is 12.5 mm high.",
    )


def test_designs_are_counted_by_what_they_fail():
    asked = {"max_force": "1 kN", "max_mass": "0.2 kg", "min_absorbed": "6 J"}
    assert notes(CRUSHED, require=asked, panel=PANEL, per="panel") == (
        "No design has a place here.",
        "Required of a panel: force at most 1000 N, mass at most 200 g, absorbed energy at least"
        " 6.00 J.",
        "0 of 3 designs fulfil this; 3 fail: max_force (2), min_absorbed (1).",
        "6.00 J at 1000 N needs at least 6.00 mm of stroke, if the force is constant:\n"
        "energy / force, a rectangle, which no real curve is. The lattice is 12.5 mm high.",
        "The nearest to all of this is case 0000000000000000: force 1000 N, mass 50 g, absorbed"
        " energy 5.00 J.",
    )
    several = notes(CRUSHED, require={"max_force": "20 N", "max_mass": "1 g"})
    assert several[-1] == (
        "1 of 3 designs fulfil this; 2 fail: max_force (2), max_mass (2); some fail several."
    )
    assert notes(CRUSHED, require={"max_mass": "9 g"})[-1] == "All designs (3) fulfil this."


NONE = {
    ("max_mass", "0.5 g"): "None weighs less than 0.5 g; the lightest weighs 1 g.",
    ("min_absorbed", "1 J"): "None absorbs as much as 1.00 J; the most is 400 mJ.",
    ("max_stroke", "1 mm"): "None needs less stroke than 1 mm; the least is 6.75 mm.",
}


@pytest.mark.parametrize(("name", "limit"), NONE)
def test_how_near_the_best_comes_to_each_requirement(name, limit):
    assert notes(CRUSHED, require={name: limit})[-1] == NONE[name, limit]


def test_what_has_no_filtered_deceleration_is_said():
    told = notes(STRUCK, require={"max_deceleration": "40 g0"})
    assert told[3:] == (
        "1 without a value for max_deceleration: rows are too far apart for loading.filter_class,"
        " or older than the filter.",
        "None stops the striker with less than 40 g0; the best needs 51 g0.",
    )
    both = summary(*STRUCK.to_dict("records"), {})
    *_, sheet = ranking_sheets(ranked(both, require={"max_deceleration": "40 g0"}), both)
    assert sheet.notes[-1] == "max_deceleration is not asked for here: there is no striker."


def test_a_budget_that_only_failing_designs_keep_is_told():
    told = notes(CRUSHED, budget=["1 g", "2 g"], require={"min_absorbed": "150 mJ"})
    assert told[-1] == "None of these weighs 1 g or less."


def test_nothing_is_said_where_nothing_is_required():
    assert notes(CRUSHED) == ()
    assert required(ranked(CRUSHED)) == ""


def test_what_is_required_is_shown():
    (sheet,) = ranking_sheets(ranked(STRUCK, require={"max_deceleration": 600.0}), STRUCK)
    assert sheet.rows[0][sheet.heads.index("decel. g0")] == "51.0"
    (sheet,) = ranking_sheets(ranked(CRUSHED, require={"max_stroke": "7 mm"}), CRUSHED)
    assert {row[sheet.heads.index("stroke mm")] for row in sheet.rows} == {"6.75"}


@pytest.mark.parametrize(("table", "head"), [(CRUSHED, "peak N"), (STRUCK, "force N")])
def test_force_of_the_panel_stands_beside_that_of_the_specimen(table, head):
    ranking = ranked(table, panel=PANEL)
    (sheet,) = ranking_sheets(ranking, table)
    assert "panel N" in sheet.heads
    for row in sheet.rows:
        one, all_of = (float(row[sheet.heads.index(name)]) for name in (head, "panel N"))
        assert all_of == 50.0 * one
    assert "panel N: force of the 50 specimens of a panel together." in legend(ranking)
    assert "panel N" not in legend(ranked(table))


def test_number_of_specimens_is_a_range_if_designs_differ_in_width():
    table = CRUSHED.assign(outer_width_m=[13e-3, 13e-3, 14e-3])
    assert "of the 45 to 50 specimens of a panel" in legend(ranked(table, panel=PANEL))


def test_quantities_are_those_of_a_maker():
    assert quantity("max_deceleration", 80 * 9.80665) == "80 g0"
    assert quantity("max_mass", 0.0567) == "56.7 g"
    assert quantity("max_force", 12345.6, digits=3) == "12300 N"


def test_stroke_of_an_allowed_force_is_told_too():
    """5 J at 10 N: 500 mm."""
    table = CRUSHED.assign(absorbed_energy_at_10N_J=0.1)
    found = notes(table, require={"min_absorbed": "5 J"}, allowed_force="10 N")
    assert "None absorbs as much as 5.00 J; the most is 100 mJ." in found
    assert "5.00 J at 10 N needs at least 500 mm of stroke, if the force is constant:\n" in "".join(
        line for line in found if "rectangle" in line
    )
