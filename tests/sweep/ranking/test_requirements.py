"""Requirements: who meets them, of a specimen or a panel, and how near the others come."""

import numpy as np
import pytest

from sweep.ranking.rank import RankError, rank, ranked
from sweep.ranking.requirements import MEASURES, limits, measured
from tests.support.specimens import designs, ids, summary

NAN = float("nan")
PANEL = ("130 mm", "50 mm")  # 50 specimens
SCENE = "crushed to 50 %, glued platens"
CRUSHED = summary(
    *designs([1.0, 2.0, 3.0], [0.10, 0.18, 0.40], packing_strain=0.5, peak_strain=0.5)
).assign(peak_force_until_packed_N=[20.0, 30.0, 80.0], packing_strain=[0.5, 0.4, 0.3])
"""1, 2 and 3 g absorb 100, 180 and 400 mJ at 20, 30 and 80 N in 6.1, 4.88 and 3.66 mm."""


def struck(force, deceleration=500.0, energy=1.5, **other):
    """A row of a design under a striker of 50 g."""
    hit = {"loading_mode": "impact", "stroke_m": NAN, "striker_mass_g": 50.0}
    speed = {"striker_speed_m_per_s": (2e3 * energy / 50.0) ** 0.5, "impact_energy_J": energy}
    peaks = {"peak_force_N": force, "peak_deceleration_filtered_m_per_s2": deceleration}
    return hit | speed | peaks | {"absorbed_energy_J": energy, "peak_strain": 0.5} | other


ONE_BY_ONE = {
    ("max_force", "30 N"): [0, 1],
    ("max_force", 20.0): [0],
    ("max_mass", "2 g"): [0, 1],
    ("min_absorbed", "180 mJ"): [1, 2],
    ("max_stroke", "5 mm"): [1, 2],
}


@pytest.mark.parametrize(("name", "limit"), ONE_BY_ONE)
def test_only_what_meets_a_requirement_has_a_place(name, limit):
    ranking = ranked(CRUSHED, require={name: limit})
    assert sorted(ids(ranking.table)) == ONE_BY_ONE[name, limit]
    outcome = ranking.outcomes[SCENE]
    assert (outcome.designs, outcome.fulfil) == (3, len(ranking.table))
    assert outcome.failed == {name: 3 - len(ranking.table)}
    assert outcome.unknown == {name: 0}


def test_a_panel_bears_the_force_of_all_its_specimens():
    of_panel = {"max_force": "1.5 kN", "max_mass": "100 g", "min_absorbed": "9 J"}
    ranking = ranked(CRUSHED, panel=PANEL, require=of_panel, per="panel")
    assert ids(ranking.table) == [1]
    assert list(ranking.table["panel_specimens"]) == [50]
    assert list(ranking.table["panel_force_N"]) == [1500.0]
    assert ranking.outcomes[SCENE].failed == {"max_force": 1, "max_mass": 1, "min_absorbed": 1}
    of_specimen = {"max_force": "30 N", "max_mass": "2 g", "min_absorbed": "180 mJ"}
    assert ids(rank(CRUSHED, panel=PANEL, require=of_specimen)) == [1]


def test_panel_has_whole_specimens():
    table = rank(CRUSHED, panel=("131 mm", "54.9 mm"))
    assert set(table["panel_specimens"]) == {50}
    np.testing.assert_allclose(table["panel_mass_g"], 50.0 * table["mass_g"])
    np.testing.assert_allclose(table["panel_width_m"], 10 * 0.013 + 9 * 0.4e-3)
    np.testing.assert_allclose(table["panel_depth_m"], 0.05)
    assert set(rank(CRUSHED, panel=("141 mm", "55 mm"))["panel_specimens"]) == {11 * 6}
    with pytest.raises(RankError, match="smaller than half of a specimen"):
        rank(CRUSHED, panel=("6 mm", "10 mm"))


def test_budget_and_requirement_hold_together():
    ranking = ranked(CRUSHED, budget=["2 g", "9 g"], require={"min_absorbed": "150 mJ"})
    found = ranking.table.groupby("budget_g")["case_id"].agg(list)
    assert [[int(i, 16) for i in of] for of in found] == [[1], [2, 1]]
    assert ranking.lightest_g == {SCENE: 1.0}


def test_front_is_that_of_the_designs_that_meet_the_requirements():
    lightest_fails = summary(*designs([1.0, 2.0, 3.0], [0.3, 0.2, 0.25], peak_force_N=10.0))
    lightest_fails["peak_force_until_packed_N"] = [90.0, 10.0, 10.0]
    assert list(rank(lightest_fails, by="mass_g")["pareto"]) == [True, False, False]
    kept = rank(lightest_fails, by="mass_g", require={"max_force": "10 N"})
    assert list(kept["pareto"]) == [True, True]


def test_missing_values_meet_nothing_and_are_counted():
    table = summary(struck(60.0, 400.0), struck(50.0, NAN), struck(50.0, 900.0))
    ranking = ranked(table, require={"max_deceleration": "50 g0"})
    assert ids(ranking.table) == [0]
    (outcome,) = ranking.outcomes.values()
    assert (outcome.failed, outcome.unknown) == ({"max_deceleration": 2}, {"max_deceleration": 1})
    assert outcome.best == {"max_deceleration": 400.0}


def test_least_stroke_is_that_of_a_rectangle():
    """1.5 J at 60 N: 25 mm, for a specimen and for a panel of 50 alike."""
    table = summary(struck(76.0), struck(90.0))
    (outcome,) = ranked(table, require={"max_force": "60 N"}).outcomes.values()
    assert (outcome.fulfil, outcome.best, outcome.energy) == (0, {"max_force": 76.0}, 1.5)
    assert outcome.stroke == pytest.approx(25e-3)
    assert outcome.height == 12.2e-3
    asked = ranked(table, panel=PANEL, require={"max_force": "3 kN"}, per="panel")
    (outcome,) = asked.outcomes.values()
    assert (outcome.energy, outcome.best) == (75.0, {"max_force": 3800.0})
    assert outcome.stroke == pytest.approx(25e-3)


def test_least_stroke_of_a_crush_is_of_the_energy_that_is_asked_for():
    alone = ranked(CRUSHED, require={"max_force": "10 N"}).outcomes[SCENE]
    assert np.isnan(alone.stroke)
    both = ranked(CRUSHED, require={"max_force": "10 N", "min_absorbed": "0.2 J"}).outcomes[SCENE]
    assert both.stroke == pytest.approx(20e-3)


def test_an_impact_is_judged_by_the_force_on_its_support():
    row = struck(76.0) | {"peak_force_until_packed_N": 40.0}
    table = summary(row, struck(50.0)).assign(absorbed_energy_at_50N_J=0.1)
    ranking = ranked(table, require={"max_force": "60 N"}, allowed_force="50 N")
    assert ids(ranking.table) == [1]


def test_crushes_are_not_asked_for_a_deceleration():
    table = summary(struck(60.0, 400.0), {}, {"loading_mode": "force", "force_N": 5.0})
    ranking = ranked(table, require={"max_deceleration": "50 g0"})
    left_out = [outcome.left_out for outcome in ranking.outcomes.values()]
    assert left_out == [(), ("max_deceleration",), ("max_deceleration",)]
    assert sorted(ids(ranking.table)) == [0, 1, 2]
    with pytest.raises(RankError, match="max_deceleration needs a striker"):
        rank(CRUSHED, require={"max_deceleration": "500 m/s^2"})


def test_stroke_is_that_of_the_counted_energy():
    whole = rank(CRUSHED, by="absorbed_energy_J").sort_values("case_id")
    np.testing.assert_allclose(whole["counted_stroke_m"], 0.5 * 12.2e-3)
    packed = rank(CRUSHED).sort_values("case_id")
    np.testing.assert_allclose(packed["counted_stroke_m"], [6.1e-3, 4.88e-3, 3.66e-3])
    up_to = CRUSHED.assign(absorbed_energy_at_50N_J=0.1)
    with pytest.raises(RankError, match="rank the file itself"):
        rank(up_to, allowed_force="50 N", require={"max_stroke": "5 mm"})


@pytest.mark.parametrize(
    ("asked", "words"),
    [
        ({"require": {"max_forse": "3 N"}}, "unknown requirement max_forse; .* max_force"),
        ({"require": {"max_mass": "-1 g"}}, "above zero"),
        ({"per": "piece"}, 'per = "piece"; allowed: specimen or panel'),
        ({"per": "panel"}, "needs a panel"),
        ({"per": "panel", "panel": PANEL, "allowed_force": "1 N"}, "rank the file itself"),
    ],
)
def test_what_cannot_be_asked_is_refused(asked, words):
    with pytest.raises(RankError, match=words):
        rank(CRUSHED, **asked)


def test_limits_are_si_and_those_that_are_none_are_left_out():
    given = dict.fromkeys(MEASURES) | {"max_mass": "2 oz", "max_deceleration": "10 g0"}
    assert limits(given) == pytest.approx({"max_deceleration": 98.0665, "max_mass": 0.05669904625})
    assert limits(None) == {}


def test_what_is_measured_of_a_panel_is_that_of_its_specimens_together():
    ranking = ranked(CRUSHED, panel=PANEL)
    names = type("Names", (), {"mass": ranking.mass, "energy": ranking.energy})
    one, all_of = (measured(ranking.table, names, per) for per in ("specimen", "panel"))
    for name, measure in MEASURES.items():
        factor = 50.0 if measure.shared else 1.0
        np.testing.assert_allclose(all_of[name], factor * one[name])
    assert list(one["max_mass"] * 1e3) == pytest.approx(list(ranking.table["mass_g"]))
