"""Requirements in sentences and columns."""

import pytest

from sweep.ranking.rank import ranked
from sweep.report.tables.legend import legend
from sweep.report.tables.requirement_notes import quantity, required
from sweep.report.tables.sheets import ranking_sheets
from tests.support.results.specimens import designs, summary

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


CASE = "case 000000000000000"


def notes(table, **question):
    """Notes below the only table of a ranking."""
    (sheet,) = ranking_sheets(ranked(table, **question), table)
    return sheet.notes


def test_none_passes_less():
    assert notes(STRUCK, require={"max_force": "60 N"}) == (
        "No design is ranked here.",
        "Required of a specimen: force at most 60 N.",
        "0 of 2 designs fulfil this; 2 fail: max_force (2).",
        f"Nearest: {CASE}0, ninjaflex: force 76 N, 27 % too much.",
        "Absorbing 1.50 J at no more than 60 N takes a stroke of at least 25.0 mm "
        "(energy / force);\nthe lattice is 12.5 mm high.",
    )


def test_designs_are_counted_by_what_they_fail():
    asked = {"max_force": "1 kN", "max_mass": "0.2 kg", "min_absorbed": "6 J"}
    assert notes(CRUSHED, require=asked, panel=PANEL, per="panel") == (
        "No design is ranked here.",
        "Required of a panel: force at most 1000 N, mass at most 200 g, absorbed energy at least"
        " 6.00 J.",
        "0 of 3 designs fulfil this; 3 fail: max_force (2), min_absorbed (1).",
        f"Nearest: {CASE}0, ninjaflex: absorbed energy 5.00 J, 17 % too little.",
        "Absorbing 6.00 J at no more than 1000 N takes a stroke of at least 6.00 mm "
        "(energy / force);\n"
        "the lattice is 12.5 mm high.",
    )
    several = notes(CRUSHED, require={"max_force": "20 N", "max_mass": "1 g"})
    assert several[-1] == (
        "1 of 3 designs fulfil this; 2 fail: max_force (2), max_mass (2); some fail several."
    )
    assert notes(CRUSHED, require={"max_mass": "9 g"})[-1] == "All designs (3) fulfil this."


NEAREST = {
    ("max_mass", "0.5 g"): "0, ninjaflex: mass 1 g, 100 % too much.",
    ("min_absorbed", "1 J"): "2, ninjaflex: absorbed energy 400 mJ, 60 % too little.",
    ("max_stroke", "6.747 mm"): "0, ninjaflex: stroke 6.75 mm, less than 0.1 % too much.",
}


@pytest.mark.parametrize(("name", "limit"), NEAREST)
def test_how_near_the_nearest_comes_to_each_requirement(name, limit):
    assert notes(CRUSHED, require={name: limit})[-1] == f"Nearest: {CASE}{NEAREST[name, limit]}"


def test_what_no_design_fulfils_is_told_where_the_nearest_is_not_the_best_in_it():
    told = notes(CRUSHED, require={"max_force": "10 N", "min_absorbed": "0.35 J"})
    assert told[3] == (
        f"Nearest: {CASE}0, ninjaflex: force 20 N, 100 % too much; absorbed energy 100 mJ, 71 %"
        "\ntoo little."
    )
    told = notes(CRUSHED, require={"max_force": "10 N", "min_absorbed": "0.5 J"})
    assert told[4] == "None absorbs as much as 500 mJ; the most is 400 mJ."


def test_counts_and_nearest_are_those_of_each_budget():
    told = notes(CRUSHED, budget=["1 g", "2 g", "3 g"], require={"min_absorbed": "0.38 J"})
    assert told == (
        "Required of a specimen: absorbed energy at least 380 mJ.",
        "0 of 1 designs up to 1 g fulfil this; 1 fail: min_absorbed (1).",
        "0 of 2 designs up to 2 g fulfil this; 2 fail: min_absorbed (2).",
        "1 of 3 designs up to 3 g fulfil this; 2 fail: min_absorbed (2).",
        f"Nearest up to 1 g: {CASE}0, ninjaflex: absorbed energy 100 mJ, 74 % too little.",
        f"Nearest up to 2 g: {CASE}1, ninjaflex: absorbed energy 180 mJ, 53 % too little.",
    )
    told = notes(CRUSHED, budget=["1 g", "1.5 g", "2 g"], require={"min_absorbed": "0.38 J"})
    assert told[5:] == (
        f"Nearest up to 1 g, 1.5 g: {CASE}0, ninjaflex: absorbed energy 100 mJ, 74 % too little.",
        f"Nearest up to 2 g: {CASE}1, ninjaflex: absorbed energy 180 mJ, 53 % too little.",
        f"The lightest design that fulfils this weighs 3 g: {CASE}2, ninjaflex.",
    )


def test_a_doubtful_design_is_never_the_best_without_a_word():
    worse = STRUCK.assign(stroke_left_m=[-1e-3, 0.0], peak_force_N=[76.0, 90.0])
    told = notes(worse, require={"max_force": "60 N"})
    assert told[3] == f"Nearest: {CASE}1, ninjaflex: force 90 N, 50 % too much."
    told = notes(worse[:1], require={"max_force": "60 N"})
    assert told[3] == (
        "Nearest: case 0000, ninjaflex (marked !: do not trust it): force 76 N, 27 % too much."
    )
    told = notes(worse, require={"max_force": "80 N"})
    assert "1 of 2 designs fulfil this, 1 of them marked ! or x; 1 fail: max_force (1)." in told
    assert told[3] == f"Nearest: {CASE}1, ninjaflex: force 90 N, 12 % too much."


def test_what_a_longer_crush_may_fulfil_is_told():
    rising = CRUSHED.assign(densification_strain=NAN)
    told = notes(rising, require={"min_absorbed": "0.42 J"})
    assert told[3:] == (
        "3 of them may fulfil min_absorbed in a longer crush: this one ended before densification.",
        f"Nearest: {CASE}2, ninjaflex: absorbed energy at least 400 mJ, at most 4.8 % too\nlittle.",
    )
    up_to = CRUSHED.assign(absorbed_energy_at_90N_J=0.1)
    told = notes(up_to, allowed_force="90 N", require={"min_absorbed": "0.2 J"})
    assert "ended before the allowed force was reached." in told[3]


def test_what_has_no_filtered_deceleration_is_said():
    told = notes(STRUCK, require={"max_deceleration": "40 g0"})
    assert told[3:] == (
        "1 without a value for max_deceleration: rows are too far apart for loading.filter_class.",
        f"Nearest: {CASE}0, ninjaflex: deceleration 50.99 g0, 27 % too much.",
    )


def test_what_a_loading_is_not_asked_for_is_said_once():
    load = {"loading_mode": "force", "peak_strain": 0.2}
    table = summary(
        *STRUCK.to_dict("records"), {}, load | {"force_N": 5.0}, load | {"force_N": 9.0}
    )
    asked = {"max_deceleration": "60 g0", "max_force": "90 N", "min_absorbed": "1 mJ"}
    hit, crush, first, second = ranking_sheets(ranked(table, require=asked), table)
    assert hit.notes[0] == "Required of a specimen: force at most 90 N, deceleration at most 60 g0."
    assert hit.notes[-1] == (
        "Not applied to an impact, whose striker sets the energy: min_absorbed."
    )
    assert crush.notes[-1] == "Not applied to a crush, which has no striker: max_deceleration."
    assert first.notes == (
        "Not applied to a dead load, which sets force and energy itself: max_force, "
        "max_deceleration, min_absorbed.",
    )
    assert second.notes == ()


def test_nothing_is_said_where_nothing_is_required():
    assert notes(CRUSHED) == ()
    assert required(ranked(CRUSHED), ["displacement"]) == ""


def test_what_is_required_is_shown():
    (sheet,) = ranking_sheets(ranked(STRUCK, require={"max_deceleration": 600.0}), STRUCK)
    assert sheet.rows[0][sheet.heads.index("decel. g0")] == "51.0"
    ranking = ranked(STRUCK, by="peak_deceleration_filtered_m_per_s2")
    (sheet,) = ranking_sheets(ranking, STRUCK)
    assert sheet.heads[-1] == "decel. g0"
    assert "decel.: greatest deceleration of the striker, filtered" in legend(ranking)


@pytest.mark.parametrize("asked", [{"max_stroke": "7 mm"}, {"max_force": "70 N"}])
def test_stroke_is_shown_where_it_or_the_force_is_limited(asked):
    ranking = ranked(CRUSHED, require=asked)
    (sheet,) = ranking_sheets(ranking, CRUSHED)
    assert {row[sheet.heads.index("stroke mm")] for row in sheet.rows} == {"6.75"}
    assert "stroke: over which the counted energy is absorbed" in legend(ranking)
    (sheet,) = ranking_sheets(ranked(CRUSHED), CRUSHED)
    assert "stroke mm" not in sheet.heads


def test_stroke_up_to_an_allowed_force_is_shown_if_the_curves_are_known():
    table = CRUSHED.assign(absorbed_energy_at_50N_J=0.1)
    (sheet,) = ranking_sheets(ranked(table, allowed_force="50 N"), table)
    assert "stroke mm" not in sheet.heads
    table["stroke_at_allowed_m"] = 3e-3
    (sheet,) = ranking_sheets(ranked(table, allowed_force="50 N"), table)
    assert {row[sheet.heads.index("stroke mm")] for row in sheet.rows} == {"3.00"}


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
    assert found[-2].endswith("absorbed energy 100 mJ, 98 % too little.")
    assert found[-1] == (
        "Absorbing 5.00 J at no more than 10 N takes a stroke of at least 500 mm "
        "(energy / force);\nthe lattice is 12.5 mm high."
    )
