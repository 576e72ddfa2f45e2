"""Counted values: energy up to a force or until densification, of a panel; striker forces."""

import re

import pytest

from sweep.ranking.merit import AT_DENSIFICATION, WHOLE_CRUSH
from sweep.ranking.rank import rank, ranked
from sweep.report.tables.legend import legend
from sweep.report.tables.sheets import ranking_sheets
from tests.support.results.specimens import designs, ids, summary

NAN = float("nan")


def struck(force, energy, **other):
    hit = {"loading_mode": "impact", "stroke_m": NAN, "striker_mass_g": 50.0}
    speed = {"striker_speed_m_per_s": (2e3 * energy / 50.0) ** 0.5, "impact_energy_J": energy}
    return hit | speed | {"peak_force_N": force, "absorbed_energy_J": energy} | other


def test_under_a_striker_the_least_force_wins():
    """Every design takes all the energy, to a little more or less."""
    table = summary(
        struck(60.0, 0.1, mass_g=1.0, stroke_left_m=2e-3, rebound_share=0.4),
        struck(40.0, 0.1, mass_g=1.2),
        struck(70.0, 0.1, mass_g=1.4),
        struck(90.0, 0.2, mass_g=1.0),
    )
    ranking = ranked(table)
    scene, other = ranking.table["scene"].unique()
    assert scene == "struck by 50 g at 2 m/s (100 mJ), glued platens"
    assert other == "struck by 50 g at 2.828 m/s (200 mJ), glued platens"
    assert ids(ranking.table) == [1, 0, 2, 3]
    assert list(ranking.table["pareto"]) == [True, True, False, True]
    assert set(ranking.table["ranked_by"]) == {ranking.by} == {"peak_force_N"}
    first, _ = ranking_sheets(ranking, table)
    assert first.title.endswith("least force first")
    assert first.heads[2:] == ["force N", "strain %", "left mm", "rebound %"]
    assert first.rows[1][1:] == ["1.00", "60.0", "0", "2.00", "40"]
    assert "rebound: energy" in legend(ranking)


def test_what_is_pressed_into_less_than_its_solid_is_marked():
    """A striker that has used up more than the voids, a dead load on the ground."""
    struck = {"loading_mode": "impact", "striker_mass_g": 50.0, "peak_force_N": 9.0}
    table = summary(struck | {"stroke_left_m": -1e-4}, struck | {"stroke_left_m": 1e-4})
    ranking = rank(table)
    assert (ids(ranking), list(ranking["beyond_model"])) == ([1, 0], [False, True])
    held = {"loading_mode": "force", "force_N": 5.0}
    free = held | {"stroke_left_m": NAN}
    table = summary(free | {"peak_strain": 0.99}, free | {"peak_strain": 1.03})
    assert list(rank(table)["beyond_model"]) == [False, True]
    table = summary(held | {"stroke_left_m": -1e-4}, held | {"stroke_left_m": 1e-4})
    assert list(rank(table)["beyond_model"]) == [False, True]


@pytest.mark.parametrize("by", WHOLE_CRUSH)
def test_what_the_whole_crush_decides_is_trusted_as_far_as_all_of_it(by):
    energies = {"absorbed_energy_until_packed_J": 1.0, "absorbed_energy_within_model_J": 1.5}
    table = summary(energies | {"absorbed_energy_J": 2.0}, energies | {"absorbed_energy_J": 1.4})
    table["lost_energy_J"] = table["lost_energy_J_per_g"] = table["peak_base_pressure_Pa"] = 1.0
    assert not rank(table)["beyond_model"].any()
    for force in (None, "50 N"):
        ranking = rank(table.assign(absorbed_energy_at_50N_J=1.0), by=by, allowed_force=force)
        assert (ids(ranking), list(ranking["beyond_model"])) == ([1, 0], [False, True])


def test_energy_counts_up_to_the_allowed_force():
    table = summary(*designs([2.0, 2.0], [0.9, 0.5])).assign(absorbed_energy_at_50N_J=[0.1, 0.2])
    ranking = ranked(table, allowed_force="50 N")
    assert ids(ranking.table) == [1, 0]
    assert ranking.table.loc[0, "specific_absorption_at_50N_J_per_g"] == pytest.approx(0.1)
    assert list(ranking.table["pareto"]) == [True, False]
    assert list(ranking.table["passed_on_N"]) == [20.0, 20.0]
    (sheet,) = ranking_sheets(ranking, table)
    assert sheet.heads == ["#", "mass g", "usable mJ", "J/g", "peak N"]
    assert not re.search("^(dens.|returned):", legend(ranking), re.MULTILINE)
    packed = ranked(table, by="densification_strain", allowed_force="50 N")
    (sheet,) = ranking_sheets(packed, table)
    assert sheet.heads[-1] == "densification_strain"
    strong = table.assign(peak_force_N=80.0, peak_force_until_packed_N=30.0)
    assert list(rank(strong, allowed_force="50 N")["passed_on_N"]) == [50.0, 50.0]


@pytest.mark.parametrize("by", AT_DENSIFICATION)
def test_energy_counts_until_the_greatest_efficiency_if_asked(by):
    row = {"absorbed_energy_at_densification_J": 0.1, "peak_force_at_densification_N": 7.0}
    ranking = ranked(summary(row | {"absorbed_energy_within_model_J": 0.1}, {}), by=by)
    assert (ranking.by, ranking.energy) == (by, "absorbed_energy_at_densification_J")
    assert ranking.until == "up to the strain of greatest efficiency"
    assert ids(ranking.table) == [0, 1]
    assert list(ranking.table["passed_on_N"]) == [7.0, 20.0]
