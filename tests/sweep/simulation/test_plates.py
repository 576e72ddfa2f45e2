"""Crushes along the cells from a case to its result; tubes of few quads, pressed a little."""

from importlib import import_module

import numpy as np
import pytest

from sweep.columns import COLUMNS, HISTORY_COLUMNS
from sweep.config.case import Case
from sweep.scene.plates.scene import build_scene
from sweep.simulation.plate_shapes import plate_frames
from sweep.simulation.simulate import simulate
from sweep.simulation.summary import shape_columns
from tests.support.designs.tables import material_with

LINEAR = material_with(name="ultimaker_tpu95a", stretch="linear")
SIDE = 4e-3


def tube(platen="glued", steps=6, **lattice):
    """A square tube of 4 x 4 x 8 mm with walls of 0.4 mm, pressed by 6 %."""
    size = {"width": SIDE, "height": SIDE, "depth": 2 * SIDE, "wall_thickness": 0.4e-3}
    box = {"cells_x": 1, "cells_y": 1, "nodes_per_wall": 3, "imperfection": 0.05}
    return Case.of(
        lattice=size | box | lattice,
        material=LINEAR,
        loading=dict(direction="out_of_plane", strain=0.06, platen=platen, unload=False),
        contact=dict(friction=0.2),
        solver=dict(load_steps=steps),
    )


@pytest.fixture(scope="module")
def pressed():
    return simulate(tube())


def test_all_columns_are_filled(pressed):
    assert pressed.status == "converged"
    assert not set(COLUMNS) - {"cpu_s"} - set(pressed.summary)
    assert set(HISTORY_COLUMNS) <= set(pressed.history)
    assert pressed.summary["direction"] == "out_of_plane"
    assert pressed.summary["max_crossings"] == 0
    assert pressed.summary["least_element_strain"] < -0.01
    assert pressed.summary["greatest_fibre_strain"] > pressed.summary["greatest_element_strain"]


def test_stroke_force_and_mass_are_those_of_the_extruded_tube(pressed):
    summary, history = pressed.summary, pressed.history
    assert summary["height_m"] == 2 * SIDE
    assert summary["stroke_m"] == pytest.approx(0.12 * SIDE)
    assert history["strain"][-1] == pytest.approx(0.06)
    assert summary["mass_g"] == pytest.approx(1.22 * (4.4**2 - 3.6**2) * 8e-3, rel=1e-9)
    assert summary["relative_density"] == pytest.approx(1.0 - 3.6**2 / 4.4**2)
    assert summary["solid_strain"] == pytest.approx(3.6**2 / 4.4**2)
    assert summary["residual_strain"] == pytest.approx(0.06)
    assert history["reaction_top_N"] == pytest.approx(history["reaction_bottom_N"], rel=1e-4)


def test_energies_balance_and_are_the_area_below_the_curve(pressed):
    history = pressed.history
    work = np.trapezoid(history["reaction_top_N"], history["top_displacement_m"])
    assert history["work_in_J"][-1] == pytest.approx(work, rel=2e-2)
    assert abs(pressed.summary["energy_residual_J"]) < 1e-6 * pressed.summary["absorbed_energy_J"]
    stored = sum(history[name][-1] for name in ("stretch_J", "bend_J", "contact_J"))
    assert stored == pytest.approx(history["work_in_J"][-1], rel=2e-2)


def test_walls_buckle_at_the_load_of_plates(pressed):
    """Long plates with hinged sides have k = 4: 4 pi^2 D / l^2 of 16 mm of walls, 13 N; the
    force goes on, but at half the stiffness or less.
    """
    force = pressed.history["reaction_top_N"]
    critical = 4.0 * np.pi**2 * LINEAR.modulus * 0.4e-3**3 / (12.0 * 0.75) / SIDE**2 * 4.0 * SIDE
    first, last = np.diff(force)[[0, -1]]
    assert last < 0.5 * first
    assert force[-1] == pytest.approx(critical, rel=0.35)


def test_quarter_is_the_whole(pressed):
    quarter = simulate(tube(symmetry="quarter"))
    assert quarter.frames["position_m"].shape == pressed.frames["position_m"].shape
    for name in ("reaction_top_N", "reaction_bottom_N", "work_in_J", "bend_J", "stretch_J"):
        np.testing.assert_allclose(quarter.history[name], pressed.history[name], rtol=2e-2)
    assert quarter.summary["mass_g"] == pressed.summary["mass_g"]


def test_clamped_ends_are_stiffer_and_loose_ones_weaker(pressed):
    peaks = [simulate(tube(platen)).summary["peak_force_N"] for platen in ("contact", "clamped")]
    assert peaks[0] < pressed.summary["peak_force_N"] < peaks[1]


@pytest.mark.parametrize(("stroke", "within"), [(0.6, 1.2), (0.9, 2.0 * 3.6**2 / 4.4**2)])
def test_energy_within_the_model_ends_where_walls_fill_the_area(stroke, within):
    """At a work of 2 J for the whole height, evenly; the tube fills its area at 67 % strain."""
    scene = build_scene(tube())
    x, flat = np.tile(scene.x_rest, (2, 1)), np.zeros((2, len(scene.mesh.quads)))
    frames = plate_frames(x, np.zeros(2), np.zeros(2), scene)
    strain = np.linspace(0.0, stroke, 50)
    loading = {"strain": strain, "work_in_J": 2.0 * strain}
    columns = shape_columns(tube(), scene, frames, (flat, flat, flat), loading)
    assert columns["absorbed_energy_within_model_J"] == pytest.approx(within)


def test_damping_is_no_advice_as_it_is_refused(monkeypatch):
    module = import_module("sweep.simulation.simulate")
    monkeypatch.setattr(module._Run, "_creates_energy", lambda run, rows: True)
    loading = dict(direction="out_of_plane", striker_mass=5e-3, striker_speed=0.3, duration=1e-4)
    steps = dict(integrator="newmark", time_step=2e-5)
    found = simulate(
        Case.of(lattice=tube().lattice, material=LINEAR, loading=loading, solver=steps)
    )
    advice = 'try smaller steps or solver.integrator "backward_euler"'
    assert found.message == f"the time integration gained energy; {advice}"


def test_a_striker_is_stopped_and_thrown_back():
    case = tube(symmetry="quarter", nodes_per_wall=2)
    loading = dict(direction="out_of_plane", striker_mass=5e-3, striker_speed=0.3)
    struck = Case.of(
        lattice=case.lattice, material=LINEAR, loading=loading, contact=dict(friction=0.0),
        solver=dict(time_step=2e-5),
    )  # fmt: skip
    result = simulate(struck)
    summary = result.summary
    assert result.status == "converged"
    assert summary["impact_energy_J"] == pytest.approx(0.5 * 5e-3 * 0.3**2)
    assert summary["absorbed_energy_J"] == pytest.approx(summary["impact_energy_J"], rel=0.02)
    assert 0.5 < summary["rebound_share"] < 1.0
    assert summary["stroke_left_m"] < 2 * SIDE * (3.6 / 4.4) ** 2
