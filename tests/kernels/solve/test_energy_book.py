"""The energy book: closed in every kind of scene, and true by measures that are not its own."""

import numpy as np
import pytest

from tests.support.designs.scenes import (
    HEAVY,
    SEED,
    VISCOUS,
    pressed,
    run,
    slopes,
    summed,
    trapezoid,
)

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
