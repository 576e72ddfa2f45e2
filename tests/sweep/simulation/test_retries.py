"""Retries of a case that stops: which are tried, which result counts, and the text of its row."""

from dataclasses import replace

import numpy as np
import pytest

from sweep.config.case import Case
from sweep.numbers import with_unit
from sweep.result import Status, failed_result
from sweep.simulation import retries
from sweep.simulation.retries import simulate_again
from sweep.simulation.simulate import simulate
from tests.studies.stability.draw import scene

CRUSH = Case.of(loading={"mode": "displacement", "strain": 0.1})
FAST = Case.of(loading={"mode": "displacement", "strain": 0.1, "speed": 1.0})
LOAD = Case.of(loading={"mode": "force", "force": 1.0})
STRIKE = Case.of(loading={"mode": "impact"}, solver={"time_step": 1e-3})
WHY = "stopped here: try more"
limits = []  # the seconds that each simulation may take


def answers(monkeypatch, *outcomes, curable=True, why=WHY):
    """Let `simulate` end in these ways, one after another; return the cases that it is given."""
    asked, left = [], list(outcomes)

    def simulate(case, stop=None, seconds=None):
        asked.append(case)
        limits.append(seconds)
        status, loaded = left.pop(0)
        message = "" if status is Status.CONVERGED else why
        made = failed_result(case, status, message)
        summary = made.summary | {"case_id": case.case_id, "loaded": loaded, "cpu_s": 1.0}
        return replace(made, summary=summary, curable=curable and status not in retries.ENDED)

    limits.clear()
    monkeypatch.setattr(retries, "simulate", simulate)
    return asked


STOPS, LOADS, ENDS = (Status.STOPPED, 0), (Status.STOPPED, 1), (Status.CONVERGED, 1)
COARSE = (Status.UNRESOLVED, 0)
SLIPS = (Status.SLIPPED, 0)


def test_a_case_that_converges_is_simulated_once(monkeypatch):
    asked = answers(monkeypatch, ENDS)
    result = simulate_again(CRUSH)
    assert (len(asked), result.summary["retry"], result.status) == (1, "", Status.CONVERGED)


def test_the_first_retry_has_shorter_steps_and_gives_the_row_its_numbers(monkeypatch):
    asked = answers(monkeypatch, STOPS, ENDS)
    result = simulate_again(CRUSH)
    assert asked[1].solver.load_steps == retries.SHORTER * CRUSH.solver.load_steps
    assert result.case is CRUSH
    assert result.summary["case_id"] == CRUSH.case_id
    assert result.summary["retry"] == f"solver.load_steps = {asked[1].solver.load_steps}"
    assert (result.status, result.message, result.summary["cpu_s"]) == (Status.CONVERGED, "", 2.0)


def test_the_last_retry_has_another_imperfection_and_the_steps_asked_for(monkeypatch):
    asked = answers(monkeypatch, *[STOPS] * 2, ENDS)
    result = simulate_again(CRUSH)
    assert asked[-1].solver.load_steps == CRUSH.solver.load_steps
    assert asked[-1].lattice.imperfection == 1.5 * CRUSH.lattice.imperfection
    assert result.summary["retry"] == "lattice.imperfection = 0.015"


def test_a_case_whose_loading_was_complete_is_not_given_up_for_one_that_slipped(monkeypatch):
    asked = answers(monkeypatch, LOADS, SLIPS, STOPS)
    result = simulate_again(CRUSH)
    assert len(asked) == 3
    assert (result.status, result.summary["loaded"]) == (Status.STOPPED, 1)
    assert result.summary["retry"] == ""
    asked = answers(monkeypatch, STOPS, SLIPS)
    assert (simulate_again(CRUSH).status, len(asked)) == (Status.SLIPPED, 2)


def test_a_case_that_stops_in_spite_of_them_says_what_was_tried(monkeypatch):
    answers(monkeypatch, *[STOPS] * 3)
    result = simulate_again(CRUSH)
    tried = "solver.load_steps = 1600; lattice.imperfection = 0.015"
    assert result.message == result.summary["message"] == f"{WHY} (tried without success: {tried})"
    assert result.summary["retry"] == ""


@pytest.mark.parametrize(
    ("advice", "kept"),
    [("; try more solver.load_steps", ""), ("; try a larger solver.max_iterations", None)],
)
def test_advice_that_was_followed_is_not_given(monkeypatch, advice, kept):
    answers(monkeypatch, *[STOPS] * 3, why=f"stopped here{advice}")
    message = simulate_again(CRUSH).message
    assert message.startswith(f"stopped here{advice if kept is None else kept} (tried without")


def test_a_retry_that_completes_the_loading_counts_if_none_converges(monkeypatch):
    answers(monkeypatch, STOPS, LOADS, STOPS)
    result = simulate_again(CRUSH)
    assert (result.summary["loaded"], result.summary["retry"]) == (1, "solver.load_steps = 1600")
    assert result.message.endswith("(tried without success: lattice.imperfection = 0.015)")


@pytest.mark.parametrize(
    ("case", "words"),
    [(FAST, "solver.load_steps = 800"), (LOAD, "solver.time_step = 25 us")],
)
def test_steps_in_time_are_shorter_too(monkeypatch, case, words):
    asked = answers(monkeypatch, STOPS, ENDS)
    result = simulate_again(case)
    assert result.summary["retry"] == words
    assert asked[1].solver.time_step == pytest.approx(case.solver.time_step / retries.SHORTER)


@pytest.mark.parametrize(
    ("case", "curable", "stop"),
    [
        (CRUSH.changed(solver={"retry": False}), True, 0),
        (CRUSH, False, 0),
        (CRUSH, True, 1),
    ],
)
def test_no_retry_if_it_is_off_would_not_help_or_is_interrupted(monkeypatch, case, curable, stop):
    asked = answers(monkeypatch, STOPS, curable=curable)
    result = simulate_again(case, np.array([stop, 0]))
    assert (len(asked), result.message) == (1, WHY)


def test_all_together_keep_the_time_limit(monkeypatch):
    clock = iter((0.0, 40.0, 61.0))
    answers(monkeypatch, STOPS, STOPS)
    monkeypatch.setattr(retries.time, "monotonic", lambda: next(clock))
    limited = CRUSH.changed(solver={"time_limit": 60.0})
    result = simulate_again(limited)
    assert limits == [60.0, 20.0]
    assert result.message.endswith("(tried without success: solver.load_steps = 1600)")


def test_the_switch_is_no_part_of_the_id():
    assert CRUSH.changed(solver={"retry": False}).case_id == CRUSH.case_id


def test_a_lattice_that_tips_over_in_long_steps_is_retried_in_shorter_ones():
    case = scene(404)[1].changed(solver={"time_limit": 300.0})
    assert simulate(case).status == Status.SLIPPED
    result = simulate_again(case)
    assert (result.status, result.summary["retry"]) == (Status.CONVERGED, "solver.load_steps = 168")
    assert result.summary["absorbed_energy_J"] > 100 * simulate(case).summary["absorbed_energy_J"]


def test_a_drawn_scene_that_gained_energy_in_few_steps_takes_shares_of_them():
    case = scene(269)[1].changed(solver={"time_limit": 300.0})  # compilation may be part of it
    result = simulate_again(case)
    assert (result.status, result.summary["retry"]) == (Status.SLIPPED, "")  # it tips over
    assert result.summary["steps"] > case.solver.load_steps


def test_an_unresolved_impact_is_retried_from_its_usual_step_on(monkeypatch):
    asked = answers(monkeypatch, *[COARSE] * 2, ENDS)
    result = simulate_again(STRIKE)
    usual = STRIKE.loading.contact_step(STRIKE.pressed, STRIKE.material.modulus)
    steps = [case.solver.time_step for case in asked]
    assert steps == pytest.approx([1e-3, usual, usual / 4.0])
    assert result.summary["retry"] == f"solver.time_step = {with_unit(usual / 4.0, 's')}"


def test_an_impact_is_retried_with_its_usual_integrator_too(monkeypatch):
    asked = answers(monkeypatch, *[COARSE] * 2, ENDS)
    result = simulate_again(STRIKE.changed(solver={"integrator": "newmark"}))
    assert [case.solver.integrator for case in asked] == ["newmark", "bdf2", "bdf2"]
    assert result.summary["retry"].endswith('us, solver.integrator = "bdf2"')


def test_a_motion_of_second_order_is_retried_by_backward_euler(monkeypatch):
    asked = answers(monkeypatch, *[STOPS] * 2, ENDS)
    swinging = LOAD.changed(solver={"integrator": "newmark"})
    result = simulate_again(swinging)
    assert asked[2].solver.time_step == swinging.solver.time_step
    assert asked[2].solver.integrator == "backward_euler"
    assert result.summary["retry"] == 'solver.integrator = "backward_euler"'


@pytest.mark.parametrize(
    ("integrator", "step", "tried"),
    [("newmark", 1e-3, 2), ("newmark", 4e-4, 1), ("backward_euler", 1e-3, 1)],
)
def test_a_swing_in_steps_that_take_too_long_leaves_time_for_backward_euler(
    monkeypatch, integrator, step, tried
):
    """Not in steps of up to four times the usual ones, nor where that integrator took too long."""
    asked = answers(monkeypatch, (Status.TIMED_OUT, 0), ENDS, curable=False)
    solver = {"integrator": integrator, "time_step": step, "time_limit": 40.0}
    simulate_again(LOAD.changed(solver=solver))
    assert len(asked) == tried
    assert limits[0] == (10.0 if tried == 2 else 40.0)
    assert asked[-1].solver.time_step == step


def test_another_imperfection_is_no_advice_for_steps_that_are_too_long(monkeypatch):
    asked = answers(monkeypatch, *[COARSE] * (1 + retries.TIMES))
    result = simulate_again(STRIKE)
    assert (result.status, len(asked)) == (Status.UNRESOLVED, 1 + retries.TIMES)
    assert "imperfection" not in result.message


def test_an_impact_in_steps_that_take_too_long_leaves_time_for_the_usual_ones(monkeypatch):
    asked = answers(monkeypatch, (Status.TIMED_OUT, 0), ENDS)
    case = STRIKE.changed(solver={"time_limit": 40.0})
    result = simulate_again(case)
    assert result.status is Status.CONVERGED
    assert limits[0] == 10.0
    assert limits[1] == pytest.approx(40.0, abs=1.0)
    assert asked[1].solver.time_step == case.loading.contact_step(
        case.pressed, case.material.modulus
    )


def test_a_drawn_impact_in_steps_that_are_too_long_is_resolved_in_shorter_ones():
    """In steps of 1.07 ms the integrator takes 99 % of the energy."""
    case = scene(24)[1]
    alone, result = simulate(case), simulate_again(case)
    assert (alone.status, result.status) == (Status.UNRESOLVED, Status.CONVERGED)
    assert result.summary["retry"] == 'solver.time_step = 30.94 us, solver.integrator = "bdf2"'


def test_an_impact_of_far_too_many_steps_is_followed_until_the_striker_is_back():
    """A light striker that bounces off one wall, whose usual duration is a million steps."""
    loading = dict(mode="impact", striker_mass=3e-6, striker_speed=0.05, duration=40.0)
    solver = dict(integrator="bdf2", time_step=0.05)
    result = simulate_again(Case.of(loading=loading, solver=solver))
    assert result.status is Status.CONVERGED
    assert result.summary["retry"]
    assert result.history["time_s"][-1] < 1.0


@pytest.mark.parametrize(
    ("status", "ratio"), [(Status.STOPPED, 2.0), (Status.CONVERGED, 2.0), (Status.STOPPED, 0.9)]
)
def test_a_failed_impact_above_the_speed_of_sound_is_told_of_it(monkeypatch, status, ratio):
    material = STRIKE.material
    speed = ratio * np.sqrt(material.modulus / material.density)
    case = STRIKE.changed(loading={"striker_speed": speed})
    answers(monkeypatch, (status, 1), curable=False)
    told = "moves at 2 times the speed of sound" in simulate_again(case).message
    assert told == (status is not Status.CONVERGED and ratio > 1.0)
