"""The energy book, by a measure that is not its own: the area under a curve."""

import numpy as np
import pytest

from tests.support.designs.scenes import (
    HEAVY,
    STORED,
    VISCOUS,
    pressed,
    run,
    slopes,
    summed,
    trapezoid,
)

KEPT = (*STORED, "dissipated_material_J", "dissipated_friction_J")
FIRST = {"integrator": "backward_euler"}


def shortfalls(cases):
    """Area under the curve less stored energy and dissipation of material and friction, J."""
    histories = [run(case).history for case in cases]
    kept = [summed(history, KEPT)[-1] for history in histories]
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
