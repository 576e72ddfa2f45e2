"""The steps of a case: as requested, as fit, and as allowed; the integrators."""

from math import pi

import pytest

from sweep.config.case import Case

MOST = "at most 1,000,000 steps"


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ('[solver]\ntime_step = "1e-12 s"', MOST),
        ('[loading]\nspeed = "1 mm/s"\n[solver]\ntime_step = "1e-29 s"', MOST),
        ("[loading]\nstrain = 0.5\nload_steps = 500001", MOST),
        (
            "[loading]\nstrain = 0.5\n[material]\nloss = 0.3\n"
            "[solver]\naccuracy = 0.001\nload_steps = 15626",
            "at most 31,250 steps in all, 31,252 here",
        ),
        (
            '[loading]\nstrain = 0.5\n[solver]\nstep_error = "1 um"',
            "no effect, as the crush is",
        ),
        (
            '[loading]\nstrain = 0.5\n[material]\nbend = "none"',
            '"section" or "fibres" if',
        ),
    ],
)
def test_what_does_not_fit_is_refused(last_refused, text, words):
    assert last_refused(text, words)


def test_a_step_by_default_is_called_one(refused):
    key = "solver.time_step = 0.0001 s by default"
    assert refused('[loading]\nduration = "1000 s"', key, MOST)


def usual_step(**loading):
    """The usual step of an impact on 12.5 x 12.5 x 12 mm of 15 MPa."""
    material = {"modulus": 15e6, "density": 1200.0}
    return Case.of(material=material, loading={"mode": "impact"} | loading).solver.time_step


def test_steps_of_an_impact_are_a_share_of_its_contact():
    """The passage of a fast striker; pi sqrt(m / k) of a slow one, k = 180 kN/m of the block; no
    longer than the filter of forces allows.
    """
    assert usual_step(striker_speed=2.0) == pytest.approx(12.5e-3 / 2.0 / 1000)
    contact = pi * (0.05 / 180e3) ** 0.5
    for speed in (0.01, 0.1):
        assert usual_step(striker_speed=speed) == pytest.approx(contact / 20)
    slow = {"striker_speed": 0.01, "striker_mass": 0.2}
    assert usual_step(**slow, filter_class=600) == pytest.approx(contact / 10)
    assert usual_step(**slow) == 1.0 / (10 * 1000) < contact / 10
    equal = usual_step(striker_speed=0.01, target_mass=0.05)  # half the mass, as both move
    assert equal == pytest.approx(contact / 20 / 2**0.5)
    assert usual_step(striker_speed=1e-3, striker_mass=5e-4) == pytest.approx(125.0 / 1e6)


def test_time_step_under_a_speed_makes_a_whole_number_of_steps():
    loading = dict(mode="displacement", speed=1e-3, stroke=5e-3)
    case = Case.of(loading=loading, solver=dict(time_step=0.03))
    assert case.solver.load_steps == 167
    assert case.solver.time_step == pytest.approx(5.0 / 167)
    assert Case.of(loading=loading, solver=dict(time_step=0.02)).solver.load_steps == 250


def test_a_striker_on_walls_moved_apart_goes_by_backward_euler():
    made = Case.of(loading=dict(mode="impact"), contact=dict(model="position_based"))
    assert made.solver.integrator == "backward_euler"
