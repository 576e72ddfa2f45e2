"""The energy book: closed in every kind of scene, and true by measures that are not its own."""

import numpy as np
import pytest

from tests.studies.verify import MATERIAL
from tests.support.designs.scenes import (
    HEAVY,
    SEED,
    VISCOUS,
    loaded,
    pressed,
    run,
    slopes,
    summed,
    trapezoid,
)
from tests.support.designs.tables import lattice_with

RECOVERABLE = ("kinetic_J", "stretch_J", "bend_J", "contact_J")
PHYSICAL = ("dissipated_material_J", "dissipated_friction_J")


def test_summary_agrees_with_the_book():
    result = run(pressed(3, 0.5, 100, "contact", 0.3, unload=True, speed=0.1, damping=SEED))
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


def test_mass_of_the_summary_is_that_of_the_drawing():
    """(n p + t)^2 - n^2 (p - t)^2, x depth x density."""
    pitch, t = 12.5 / 3, 0.8
    area = (3 * pitch + t) ** 2 - 9 * (pitch - t) ** 2
    assert run(loaded(5.0)).summary["mass_g"] == pytest.approx(area * 12 * 1190e-6, rel=1e-9)


FIRST = {"integrator": "backward_euler"}


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
        pressed(3, 0.1, steps, platen, friction, speed=0.02, damping=damping, solver=FIRST)
        for steps in (100, 200, 400)
    ]
    left = shortfalls(cases)
    np.testing.assert_allclose(slopes(left), 1.0, atol=0.05)
    assert abs(left[-1]) < 2e-3 * run(cases[-1]).history["work_in_J"][-1]
