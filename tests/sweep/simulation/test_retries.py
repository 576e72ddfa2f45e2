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
STOPS, LOADS, ENDS = (Status.STOPPED, 0), (Status.STOPPED, 1), (Status.CONVERGED, 1)
MOVES = (Status.STOPPED, 0, "whatever the steps")
COARSE, SLIPS, LATE = (Status.UNRESOLVED, 0), (Status.SLIPPED, 0), (Status.TIMED_OUT, 0)
USUAL = STRIKE.loading.contact_step(STRIKE.pressed, STRIKE.material.modulus)
SWING = LOAD.changed(solver={"integrator": "newmark"})
limits = []  # the seconds that each simulation may take


def answers(monkeypatch, *outcomes, curable=True, why=WHY):
    """Let `simulate` end in these ways, one after another; return the cases that it is given."""
    asked, left = [], list(outcomes)

    def simulate(case, stop=None, seconds=None):
        asked.append(case)
        limits.append(seconds)
        status, loaded, *certain = left.pop(0)
        message = "" if status is Status.CONVERGED else why
        made, cures = failed_result(case, status, message), curable and not certain
        summary = made.summary | {"case_id": case.case_id, "loaded": loaded, "cpu_s": 1.0}
        return replace(made, summary=summary, curable=cures and status not in retries.ENDED)

    limits.clear()
    monkeypatch.setattr(retries, "simulate", simulate)
    return asked


def test_a_case_whose_loading_was_complete_is_not_given_up_for_one_that_slipped(monkeypatch):
    asked = answers(monkeypatch, LOADS, SLIPS, STOPS)
    result = simulate_again(CRUSH)
    assert len(asked) == 3
    assert (result.status, result.summary["loaded"]) == (Status.STOPPED, 1)
    assert result.summary["retry"] == ""
    asked = answers(monkeypatch, STOPS, SLIPS)
    assert (simulate_again(CRUSH).status, len(asked)) == (Status.SLIPPED, 2)


@pytest.mark.parametrize(
    ("case", "outcomes", "last", "retry"),
    [
        (CRUSH, [ENDS], {}, ""),
        (CRUSH, [STOPS, ENDS], {"load_steps": 1600}, "solver.load_steps = 1600"),
        (CRUSH, [STOPS, STOPS, ENDS], {"load_steps": 400}, "lattice.imperfection = 0.015"),
        (FAST, [STOPS, ENDS], {"load_steps": 800}, "solver.load_steps = 800"),
        (LOAD, [STOPS, ENDS], {"time_step": 2.5e-5}, "solver.time_step = 25 us"),
        (
            SWING,
            [STOPS, STOPS, ENDS],
            {"time_step": SWING.solver.time_step, "integrator": "backward_euler"},
            'solver.integrator = "backward_euler"',
        ),
        (
            STRIKE,
            [COARSE, ENDS],
            {"time_step": USUAL},
            f"solver.time_step = {with_unit(USUAL, 's')}",
        ),
        (
            STRIKE.changed(solver={"integrator": "newmark"}),
            [COARSE, COARSE, ENDS],
            {"time_step": USUAL / 4.0, "integrator": "bdf2"},
            f'solver.time_step = {with_unit(USUAL / 4.0, "s")}, solver.integrator = "bdf2"',
        ),
    ],
)
def test_a_retry_gives_the_row_its_numbers(monkeypatch, case, outcomes, last, retry):
    """Shorter steps first, then another imperfection or integrator; an impact in usual steps."""
    asked = answers(monkeypatch, *outcomes)
    result = simulate_again(case)
    assert len(asked) == len(outcomes)
    found = {key: getattr(asked[-1].solver, key) for key in last}
    for key, value in last.items():
        assert found[key] == (value if isinstance(value, str) else pytest.approx(value))
    imperfect = asked[-1].lattice.imperfection / case.lattice.imperfection
    assert imperfect == pytest.approx(1.5 if "imperfection" in retry else 1.0)
    assert result.case is case
    assert (result.status, result.message) == (Status.CONVERGED, "")
    summary = {"case_id": case.case_id, "retry": retry, "cpu_s": float(len(outcomes))}
    assert {key: result.summary[key] for key in summary} == summary


@pytest.mark.parametrize(
    ("advice", "kept"),
    [
        ("", ""),
        ("; try more solver.load_steps", ""),
        ("; try a larger solver.max_iterations", None),
    ],
)
def test_a_case_that_stops_in_spite_of_them_says_what_was_tried(monkeypatch, advice, kept):
    """Advice that was followed is not given."""
    answers(monkeypatch, *[STOPS] * 3, why=f"stopped here{advice}")
    result = simulate_again(CRUSH)
    tried = "solver.load_steps = 1600; lattice.imperfection = 0.015"
    why = f"stopped here{advice if kept is None else kept}"
    told = f"{why} (tried without success: {tried})"
    assert result.message == result.summary["message"] == told
    assert result.summary["retry"] == ""


def test_a_retry_that_completes_the_loading_counts_if_none_converges(monkeypatch):
    answers(monkeypatch, STOPS, LOADS, STOPS)
    result = simulate_again(CRUSH)
    assert (result.summary["loaded"], result.summary["retry"]) == (1, "solver.load_steps = 1600")
    assert result.message.endswith("(tried without success: lattice.imperfection = 0.015)")


def test_a_failure_that_no_steps_cure_counts_more_than_one_of_coarse_steps(monkeypatch):
    """Its advice stands; other failures, or a time limit, may have come less far."""
    answers(monkeypatch, COARSE, *[MOVES] * 4, why="moves down; try a longer loading.duration")
    result = simulate_again(STRIKE)
    assert result.status == Status.STOPPED
    assert result.summary["retry"].startswith("solver.time_step = ")
    assert "; try a longer loading.duration (tried without success: " in result.message
    for others in STOPS, LATE:
        answers(monkeypatch, COARSE, *[others] * 4)
        result = simulate_again(STRIKE)
        assert (result.status, result.summary["retry"]) == (Status.UNRESOLVED, "")


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
    case = scene(404)[1]
    assert simulate(case).status == Status.SLIPPED
    result = simulate_again(case)
    assert (result.status, result.summary["retry"]) == (Status.CONVERGED, "solver.load_steps = 168")
    assert result.summary["absorbed_energy_J"] > 1e3 * simulate(case).summary["absorbed_energy_J"]


def test_a_drawn_scene_that_gained_energy_in_few_steps_takes_shares_of_them():
    case = scene(269)[1]
    result = simulate_again(case)
    assert (result.status, result.summary["retry"]) == (Status.SLIPPED, "")  # it tips over
    assert result.summary["steps"] > case.solver.load_steps


@pytest.mark.parametrize(
    ("integrator", "step", "tried"),
    [("newmark", 1e-3, 2), ("newmark", 4e-4, 1), ("backward_euler", 1e-3, 1)],
)
def test_a_swing_in_steps_that_take_too_long_leaves_time_for_backward_euler(
    monkeypatch, integrator, step, tried
):
    """Not in steps of up to four times the usual ones, nor where that integrator took too long."""
    asked = answers(monkeypatch, LATE, ENDS, curable=False)
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
    asked = answers(monkeypatch, LATE, ENDS)
    assert simulate_again(STRIKE.changed(solver={"time_limit": 40.0})).status is Status.CONVERGED
    assert limits == [10.0, pytest.approx(40.0, abs=1.0)]
    assert asked[1].solver.time_step == USUAL


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
def test_a_failure_above_the_speed_of_sound_is_told_of_it(monkeypatch, status, ratio):
    material = STRIKE.material
    speed = ratio * np.sqrt(material.modulus / material.density)
    platen = Case.of(loading={"mode": "displacement", "speed": speed})
    for case in (STRIKE.changed(loading={"striker_speed": speed}), platen):
        answers(monkeypatch, (status, 1), curable=False)
        told = "moves at 2 times the speed of sound" in simulate_again(case).message
        assert told == (status is not Status.CONVERGED and ratio > 1.0)
