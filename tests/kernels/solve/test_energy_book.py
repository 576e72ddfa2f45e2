"""The energy book: closed in every kind of scene, and true by measures that are not its own."""

import numpy as np
import pytest

from sweep.config.case import Case
from sweep.design.network import mass
from sweep.scene.lattice import build_scene
from tests.studies.verify import MATERIAL
from tests.support.designs.scenes import (
    HEAVY,
    SEED,
    UNDAMPED,
    VISCOUS,
    is_sound,
    loaded,
    pressed,
    run,
    slopes,
    summed,
    trapezoid,
)
from tests.support.designs.tables import lattice_with

DAMPINGS = pytest.mark.parametrize(
    "damping", [UNDAMPED, SEED, VISCOUS], ids=["none", "rayleigh", "kelvin_voigt"]
)
FRICTIONS = pytest.mark.parametrize("friction", [0.0, 0.3])
RECOVERABLE = ("kinetic_J", "stretch_J", "bend_J", "contact_J")
FRICTION = 1e-4  # of it: as normal forces lag, what counts an end twice and once less may differ
PHYSICAL = ("dissipated_material_J", "dissipated_friction_J")


def moved(damping, friction, platen="contact"):
    """Pressed to one half and let up again at 0.1 m/s."""
    return run(pressed(3, 0.5, 100, platen, friction, unload=True, speed=0.1, damping=damping))


def check_book(result, damping, friction):
    history = result.history
    round_off = 1e-10 * history["work_in_J"].max()
    assert is_sound(result)
    assert abs(result.summary["energy_residual_J"]) < 1e-6 * history["work_in_J"].max()
    for name, acts in zip(PHYSICAL, (damping.get("model") != "none", friction > 0.0), strict=True):
        assert np.diff(history[name]).min() >= -round_off - FRICTION * history[name][-1]
        assert (history[name][-1] > 0.0) == acts
    assert all(history[name].min() >= -round_off for name in RECOVERABLE)
    assert not history["injected_by_projection_J"].any()


@DAMPINGS
@FRICTIONS
def test_book_of_a_dead_load(damping, friction):
    check_book(run(loaded(20.0, "contact", friction, damping=damping)), damping, friction)


@DAMPINGS
@FRICTIONS
def test_book_of_a_moving_platen(damping, friction):
    check_book(moved(damping, friction), damping, friction)


def test_summary_agrees_with_the_book():
    result = moved(SEED, 0.3)
    history, summary = result.history, result.summary
    lost = summed(history, (*PHYSICAL, "dissipated_integrator_J"))[-1]
    kept = summed(history, RECOVERABLE)[-1]
    assert summary["dissipated_energy_J"] == pytest.approx(lost, rel=1e-12)
    taken = summary["absorbed_energy_J"] - summary["returned_energy_J"]
    assert taken == pytest.approx(lost + kept, rel=1e-6)


def test_a_dead_load_works_by_its_way():
    history = run(loaded(5.0)).history
    held = history["time_s"] < 0.1375
    way = history["top_displacement_m"]
    np.testing.assert_allclose(history["work_in_J"][held], 5.0 * way[held], rtol=1e-9)
    np.testing.assert_allclose(np.ptp(history["work_in_J"][~held]), 0.0, atol=1e-15)


def test_stretching_energy_of_the_stored_shapes():
    """1/2 Y A / l0 (l - l0)^2 of every element, from the frames alone: the strain of the chord."""
    result = run(pressed(3, 0.5, 100, "contact", 0.3, solver={"element": "classical"}))
    frames, history = result.frames, result.history
    ends = frames["position_m"][:, frames["edges"]]
    length = np.linalg.norm(ends[:, :, 1] - ends[:, :, 0], axis=-1)
    area = lattice_with().depth * frames["edge_thickness_m"]
    energy = 0.5 * MATERIAL.modulus * area / length[0] * (length - length[0]) ** 2
    rows = np.searchsorted(history["strain"], frames["strain"] - 1e-9)
    np.testing.assert_allclose(
        energy.sum(axis=1), history["stretch_J"][rows], rtol=1e-9, atol=1e-15
    )


@pytest.mark.parametrize("cells", [2, 3, 5])
@pytest.mark.parametrize("elements", [1, 4])
def test_lumped_masses_sum_to_the_mass(cells, elements):
    lattice = lattice_with(cells_x=cells, cells_y=3, nodes_per_wall=elements - 1)
    scene = build_scene(Case.of(lattice=lattice, material=MATERIAL))
    expected = mass(scene.network, lattice.depth, MATERIAL.density)
    n = 2 * len(scene.mesh.points)
    assert scene.terms.coordinates.mass[0:n:2].sum() == pytest.approx(expected, rel=1e-12)
    assert scene.terms.coordinates.mass[1:n:2].sum() == pytest.approx(expected, rel=1e-12)
    assert not scene.terms.coordinates.mass[n:].any()


def test_mass_of_the_summary_is_that_of_the_drawing():
    """(n p + t)^2 - n^2 (p - t)^2, x depth x density."""
    pitch, t = 12.5 / 3, 0.8
    area = (3 * pitch + t) ** 2 - 9 * (pitch - t) ** 2
    assert run(loaded(5.0)).summary["mass_g"] == pytest.approx(area * 12 * 1190e-6, rel=1e-9)


def shortfalls(cases):
    """Area under the curve less stored energy and dissipation of material and friction, J."""
    histories = [run(case).history for case in cases]
    kept = [summed(history, (*RECOVERABLE, *PHYSICAL))[-1] for history in histories]
    return np.array([trapezoid(past) for past in histories]) - kept


def test_area_under_a_static_curve_is_what_is_stored():
    cases = [pressed(3, 0.3, steps) for steps in (200, 400, 800)]
    left = shortfalls(cases)
    np.testing.assert_allclose(slopes(left), 2.0, atol=0.1)
    assert abs(left[-1]) < 1e-5 * run(cases[-1]).history["work_in_J"][-1]


@pytest.mark.parametrize("model", ["rayleigh", "kelvin_voigt"])
@pytest.mark.parametrize(("platen", "friction"), [("glued", 0.0), ("contact", 0.3)])
def test_area_under_a_dynamic_curve_is_what_is_stored_and_dissipated(model, platen, friction):
    """Slowly enough that the shock of the first touch counts for nothing."""
    damping = {
        "rayleigh": HEAVY | {"stiffness": 0.02},
        "kelvin_voigt": VISCOUS | {"relaxation_time": 0.02},
    }[model]
    cases = [
        pressed(3, 0.1, steps, platen, friction, speed=0.02, damping=damping)
        for steps in (100, 200, 400)
    ]
    left = shortfalls(cases)
    np.testing.assert_allclose(slopes(left), 1.0, atol=0.05)
    assert abs(left[-1]) < 2e-3 * run(cases[-1]).history["work_in_J"][-1]


def test_measured_curve_closes_too():
    case = pressed(3, 0.5, 50, "contact", 0.3)
    tables = {name: getattr(case, name) for name in ("lattice", "loading", "contact", "solver")}
    result = run(Case.of(material=dict(name="ninjaflex"), **tables))
    assert is_sound(result)
