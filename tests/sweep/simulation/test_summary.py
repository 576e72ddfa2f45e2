"""The measures of a crush on curves whose values are known by hand."""

import numpy as np
import pytest
from scipy.integrate import cumulative_trapezoid

from sweep.config.case import Case
from sweep.scene.loading import CycleRows
from sweep.simulation.summary import (
    OF_A_CRUSH,
    crush_columns,
    lost_columns,
    printed_mass,
    returned,
    stretch_over_curve,
    transmitted,
)
from tests.support.converged import converged
from tests.support.designs.tables import material_with

LATTICE = dict(width=9e-3, wall_thickness=1e-3, height=10e-3, depth=10e-3)  # area 1 cm^2
AREA, HEIGHT = 1e-4, 10e-3
STEP = 1e-3  # strain of a row


def worked(strain, force):
    """Work (J) of the trapezoidal rule, (rows,)."""
    return cumulative_trapezoid(force, HEIGHT * strain, initial=0.0)


def crushed(strains, forces):
    """Strain, force (N) and work (J) of a curve that is straight between its corners."""
    strain = np.linspace(0.0, strains[-1], round(strains[-1] / STEP) + 1)
    force = np.interp(strain, strains, forces)
    return strain, force, worked(strain, force)


def curve(strain, force, work, **columns):
    """Columns of a history in which both platens bear the same force."""
    history = {"strain": strain, "work_in_J": work, "reaction_top_N": force}
    history["top_displacement_m"] = HEIGHT * np.asarray(strain)
    return history | {"reaction_bottom_N": force} | columns


def measured(strain, force, work, /, **loading):
    """Columns of a crush, or of another loading."""
    case = Case.of(lattice=LATTICE, loading=loading or dict(strain=0.6))
    return crush_columns(case, curve(strain, force, work))


FOAM = crushed([0.0, 0.1, 0.5, 0.6], [0.0, 10.0, 10.0, 50.0])
"""Rises to 10 N at 10 %, yields at 10 N to 50 %, then 4 N for each percent."""


def test_plateau_of_a_foam():
    found = measured(*FOAM)
    assert found["densification_strain"] == pytest.approx(0.5)
    # 0.5 x 10 N x 1 mm + 10 N x 4 mm = 45 mJ; stress 0.1 MPa; over 5 to 50 %: 45 - 1.25 mJ.
    assert found["efficiency"] == pytest.approx(45e-3 / (AREA * HEIGHT) / 0.1e6)
    assert found["plateau_stress_Pa"] == pytest.approx(43.75e-3 / (AREA * HEIGHT) / 0.45)


def test_energy_and_force_until_packed():
    found = measured(*FOAM, strain=0.6, allowed_forces=(20.0,))
    assert found["absorbed_energy_at_densification_J"] == pytest.approx(45e-3)
    assert found["peak_force_at_densification_N"] == pytest.approx(10.0)
    # 20 N at 52.5 %: 45 mJ + 15 N x 0.25 mm
    assert found["absorbed_energy_at_20N_J"] == pytest.approx(48.75e-3)


def test_the_greatest_force_so_far_counts_even_where_the_curve_falls():
    """A peak of 20 N at 10 %, then 10 N: at 50 % 0.5 x 20 + 15 x 1 + 10 x 3 = 55 mJ."""
    found = measured(*crushed([0.0, 0.1, 0.2, 0.5, 0.6], [0, 20, 10, 10, 60]))
    # 20 N are met again at 52 %: 55 mJ + 15 N x 0.2 mm
    assert found["densification_strain"] == pytest.approx(0.52)
    assert found["absorbed_energy_at_densification_J"] == pytest.approx(58e-3)
    assert found["efficiency"] == pytest.approx(58e-3 / 20.0 / HEIGHT)


@pytest.mark.parametrize(
    ("strains", "forces"),
    [([0.0, 0.4], [0.0, 8.0]), ([0.0, 0.1, 0.4], [0.0, 10.0, 10.0]), ([0.0, 0.2], [9.0, 1.0])],
    ids=["rising", "level", "falling"],
)
def test_what_is_still_gaining_at_the_stroke_has_not_packed(strains, forces):
    strain, force, work = crushed(strains, forces)
    case = Case.of(lattice=LATTICE, loading=dict(strain=0.5))
    found = crush_columns(case, curve(strain, force, work))
    assert np.isnan(found["densification_strain"])
    assert found["efficiency"] == pytest.approx(work[-1] / max(forces) / HEIGHT)
    assert found["absorbed_energy_at_densification_J"] == pytest.approx(work[-1])
    assert found["peak_force_at_densification_N"] == pytest.approx(max(forces))
    early = min(0.05, 0.5 * strains[-1])
    mean = (work[-1] - np.interp(early, strain, work)) / (strains[-1] - early)
    assert found["plateau_stress_Pa"] == pytest.approx(mean / (AREA * HEIGHT))


def test_a_short_crush_averages_from_half_of_it():
    found = measured(*crushed([0.0, 0.04], [0.0, 8.0]))
    assert found["plateau_stress_Pa"] == pytest.approx(6.0 / AREA)


def test_mean_over_greatest_force_until_packed_and_in_the_whole_loading():
    """10 N up to 50 %, packed at 47 % after 42.3 mJ (test_densification); 45 + 30 mJ, 50 N, 6 mm.

    Ideality and cushion factor as by Miltz & Gruenbaum: their product is 1 / strain.
    """
    found = measured(*FOAM)
    assert found["ideality"] == pytest.approx(42.3 / (10.06 * 4.72), rel=5e-3)
    assert found["cushion_factor"] == pytest.approx(10.06 * 10.0 / 42.3, rel=5e-3)
    assert found["ideality"] * found["cushion_factor"] * found["packing_strain"] == pytest.approx(1)
    assert found["crush_force_efficiency"] == pytest.approx(75.0 / (50.0 * 6.0))


def test_a_striker_has_a_mean_force_but_a_dead_load_has_none():
    struck = dict(mode="impact", striker_mass=0.1, striker_speed=1.0)
    for loading, share in ((struck, 0.25), (dict(force=50.0), np.nan)):
        found = measured(*FOAM, **loading)
        assert found["crush_force_efficiency"] == pytest.approx(share, nan_ok=True)
        assert np.isnan([found["ideality"], found["cushion_factor"]]).all()


def test_nothing_is_measured_on_one_row_or_without_force():
    still = np.zeros(1)
    found = measured(still, still, still)
    assert np.isnan([found["plateau_stress_Pa"], found["densification_strain"]]).all()
    assert found["efficiency"] == 0.0
    found = measured(*crushed([0.0, 0.3], [0.0, 0.0]))
    assert np.isnan(found["densification_strain"])
    assert (found["plateau_stress_Pa"], found["efficiency"]) == (0.0, 0.0)


def test_a_dead_load_has_no_plateau():
    found = measured(*FOAM, force=50.0)
    assert np.isnan([found[name] for name in OF_A_CRUSH]).all()
    for point in ("at_densification", "until_packed"):
        assert found[f"absorbed_energy_{point}_J"] == pytest.approx(FOAM[2][-1])
        assert found[f"peak_force_{point}_N"] == pytest.approx(50.0)


def test_work_is_split_where_the_platen_turns():
    """45 mJ down to 50 %, 10 mJ of which a force of 2 N returns on the way up."""
    strain, force = (column[:501] for column in FOAM[:2])
    there_and_back = np.append(strain, strain[-2::-1])
    history = {"work_in_J": worked(there_and_back, np.append(force, np.full(500, 2.0)))}
    turned = returned(Case.of(loading=dict(strain=0.5)), history, CycleRows(0, 500, 500, 1000))
    # The force falls from 10 to 2 N in the first step up: 6 N x 10 um, less 2 N x 10 um.
    assert turned == pytest.approx(10e-3 + 4.0 * STEP * HEIGHT)
    again = {"work_in_J": np.append(history["work_in_J"], np.full(1000, 7.0))}
    twice = Case.of(loading=dict(strain=0.5, cycles=2))
    assert returned(twice, again, CycleRows(0, 500, 500, 1000)) == turned


def test_what_does_not_come_back_is_lost():
    crushed_once = lost_columns(0.5, 0.2, 2.0)
    assert list(crushed_once.values()) == pytest.approx([0.2, 0.3, 0.6, 0.15])
    pulled = lost_columns(0.4, -0.1, 2.0)
    assert list(pulled.values()) == pytest.approx([-0.1, 0.4, 1.0, 0.2])
    assert np.isnan(lost_columns(0.5, np.nan, 2.0)["lost_share"])
    assert np.isnan(lost_columns(0.0, 0.0, 2.0)["lost_share"])


@pytest.mark.parametrize(
    ("loading", "rows"),
    [
        (dict(strain=0.5, unload=False), CycleRows(0, 600, 600, 600)),
        (dict(strain=0.5), CycleRows(0, 600, 600, 1200)),
        (dict(strain=0.5), CycleRows(0, 700, 700, 1400)),
        (dict(force=5.0), CycleRows(0, 300, 300, 600)),
    ],
    ids=["not let up", "stopped as it turns", "not even pressed", "dead load"],
)
def test_nothing_comes_back_where_no_platen_moves_back(loading, rows):
    assert len(FOAM[2]) == 601
    assert np.isnan(returned(Case.of(loading=loading), {"work_in_J": FOAM[2]}, rows))


def test_stretch_is_compared_with_the_end_of_the_measured_curve():
    curve = {"curve_strain": (-0.9, 0.01, 0.1, 0.4), "curve_stress": (-9e6, 1e5, 1e6, 3e6)}
    given = curve | {"name": "mine", "modulus": 1e7, "density": 1200.0}
    along, surface = np.array([[0.0, 0.1], [-0.8, 0.2]]), np.array([[0.0, 0.3], [0.5, 0.2]])
    strains = along, along, surface
    assert stretch_over_curve(material_with(**given), strains) == pytest.approx(0.5 / 0.4)
    taut = material_with(**given, bend="linear")
    assert stretch_over_curve(taut, strains) == pytest.approx(0.2 / 0.4)
    assert np.isnan(stretch_over_curve(material_with(modulus=1e7, density=1200.0), strains))


def test_the_greater_of_both_platens_or_what_a_support_bears_is_passed_on():
    history = {"reaction_top_N": np.array([1.0, 5.0]), "reaction_bottom_N": np.array([2.0, 4.0])}
    assert list(transmitted(Case.of(), history)) == [2.0, 5.0]
    assert list(transmitted(Case.of(loading=dict(mode="impact")), history)) == [2.0, 4.0]


def test_printed_mass_is_what_a_slicer_extrudes():
    block = dict(slicer="prusa", pattern="grid", width=20e-3, height=20e-3, mass=2.5e-3)
    assert printed_mass(Case.of(lattice=block)) == pytest.approx(2.5)
    sheet = dict(slicer="orca", pattern="gyroid", infill=0.2, height=6e-3, depth=6e-3)
    case = Case.of(lattice=sheet)
    grams = 1e3 * case.material.density * case.lattice.extruded
    assert printed_mass(case) == pytest.approx(grams)
    assert np.isnan(printed_mass(Case.of(lattice=LATTICE)))


def moved(step, **loading):
    """Squares that a platen crushes at 5 m/s."""
    loading = {"speed": 5.0, "strain": 0.4, "allowed_forces": (120.0,)} | loading
    solver = {"integrator": "bdf2", "time_step": step}
    return converged(Case.of(lattice=dict(cells_x=2, cells_y=2), loading=loading, solver=solver))


@pytest.mark.parametrize("platen", ["glued", "contact"])
def test_forces_of_a_crush_with_a_speed_have_a_limit(platen):
    """Unfiltered, the first blow of a platen at full speed grows as the steps get shorter."""
    coarse, fine = (moved(step, platen=platen) for step in (8e-6, 1e-6))
    names = ("peak_force_N", "peak_force_until_packed_N", "absorbed_energy_at_120N_J")
    for name in names:
        assert fine.summary[name] == pytest.approx(coarse.summary[name], rel=0.01)
    assert fine.summary["integrator_share"] < 0.01  # the platen's sudden return does not count


def test_what_follows_a_loading_with_a_speed_does_not_change_its_curve():
    back, held = moved(8e-6), moved(8e-6, unload=False)
    rows = len(held.history["reaction_top_N"])
    for name in ("reaction_top_N", "reaction_bottom_N"):
        np.testing.assert_allclose(back.history[name][:rows], held.history[name], rtol=1e-9)
    assert back.summary["peak_force_until_packed_N"] == held.summary["peak_force_until_packed_N"]


def test_the_peak_of_steps_that_are_too_long_is_unknown():
    """Usual steps are at most 0.1 ms long, or a thousandth of a slow stroke."""
    names = ("peak_force_N", "peak_force_until_packed_N", "peak_force_at_densification_N")
    for speed, step, is_known in ((0.2, 5e-4, False), (0.2, None, True), (1e-3, None, True)):
        loading = {"speed": speed, "strain": 0.3, "unload": False}
        solver = {} if step is None else {"time_step": step}
        case = Case.of(lattice=dict(cells_x=2, cells_y=2), loading=loading, solver=solver)
        summary = converged(case).summary
        assert [np.isfinite(summary[name]) for name in names] == [is_known] * 3
        assert np.isfinite(summary["absorbed_energy_J"])
