"""The estimate before a sweep."""

import os
import signal
import time
from dataclasses import replace

import numpy as np
import pytest

from sweep.config.case import Case
from sweep.result import Result, Status
from sweep.running.batches import cost
from sweep.running.estimate import duration, estimate
from sweep.running.sweep import Interrupted

GLUED = dict(mode="displacement", platen="glued")


def cases(loading, cells=(2, 3, 4, 5)):
    return [Case.of(lattice=dict(cells_x=n, cells_y=n), loading=loading) for n in cells]


def stand_in(status=Status.CONVERGED):
    """A simulation with a pace for each mode of loading and 1000 numbers to store, and its log."""
    asked = []

    def simulate(case, control):
        asked.append(case)
        pace = {"force": 1e-6, "displacement": 5e-6}[case.loading.mode]
        history = {"strain": np.zeros(1000)}
        return Result(case, status, "why", {"cpu_s": pace * cost(case)}, history)

    return simulate, asked


def test_each_kind_of_loading_is_scaled_by_its_own_pace():
    force, glued = cases({}), cases(GLUED)
    expected = 1e-6 * sum(map(cost, force)) + 5e-6 * sum(map(cost, glued))
    found = estimate([*force, *glued], stand_in()[0])
    assert found.cpu == pytest.approx(expected)
    assert found.pilots == 2
    assert found.disk == pytest.approx(8 * (1000 + 0.9 * 4 * 1000))


def test_pilot_stands_in_the_middle_of_the_work():
    simulate, asked = stand_in()
    estimate(cases(GLUED), simulate)
    (pilot,) = asked
    assert pilot.lattice.cells_x == 5


def by_thickness(seconds):
    """Cases of five wall thicknesses, and a simulation that thin walls make slow, with its log."""
    sizes = [(n, t * 1e-4) for n in (3, 4, 5) for t in (3, 4, 6, 8, 10)]
    many = [
        Case.of(lattice=dict(cells_x=n, cells_y=n, wall_thickness=t), loading=GLUED)
        for n, t in sizes
    ]
    asked = []

    def simulate(case, control):
        asked.append(case)
        taken = seconds * 1e-6 * cost(case) * (3e-4 / case.lattice.wall_thickness) ** 3
        return Result(case, Status.CONVERGED, "", {"cpu_s": taken}, {})

    return many, simulate, asked


def test_groups_of_short_cases_have_a_pace_of_their_own():
    many, simulate, asked = by_thickness(0.1)
    true = sum(simulate(case, None).summary["cpu_s"] for case in many)
    asked.clear()
    found = estimate(many, simulate)
    assert found.cpu == pytest.approx(true, rel=0.35)
    assert found.pilots == len(asked) == 5
    alone = simulate(asked[0], None).summary["cpu_s"] * sum(map(cost, many)) / cost(asked[0])
    assert abs(np.log(alone / true)) > np.log(1.5)


def test_long_cases_are_not_run_for_the_estimate():
    many, simulate, asked = by_thickness(1e4)
    assert estimate(many, simulate).pilots == len(asked) == 1


def test_the_steps_of_a_long_pilot_stay_as_slow_as_its_last_ones(monkeypatch):
    """It does 40 steps in the first half of its time and 10 in the second, of 400."""
    monkeypatch.setattr("sweep.running.estimate.LONGEST", 0.4)
    monkeypatch.setattr("psutil.getloadavg", lambda: (0.0, 0.0, 0.0))
    asked = []

    def slow(case, control):
        asked.append(case)
        control[1] = 40
        time.sleep(0.4)
        control[1] = 50
        return Result(case, Status.TIMED_OUT, "raise it", {"cpu_s": 0.3}, {"strain": np.zeros(9)})

    (case,) = cases(GLUED, (3,))
    case = case.changed(solver={"load_steps": 400}, loading={"unload": False})
    found = estimate([case], slow)
    assert asked[0].solver.time_limit == 0.4 < case.solver.time_limit
    assert asked[0].case_id == case.case_id
    assert found.cpu == pytest.approx(0.3 * (1.0 + 0.5 * 350 / 10))
    assert found.stopped == 1
    assert found.failures == []
    limited = case.changed(solver={"time_limit": 2.0})
    assert estimate([limited], slow).cpu == 2.0


def test_walls_that_fold_are_slower_after_they_collapse(monkeypatch):
    """A sixth of the time to 50 % strain passes before 20 %; unloading takes a quarter."""
    monkeypatch.setattr("sweep.running.estimate.LONGEST", 0.1)

    def slow(case, control):
        control[1] = 40
        return Result(case, Status.TIMED_OUT, "raise it", {"cpu_s": 0.1}, {})

    lattice = dict(cells_x=1, cells_y=1, layers=2)
    loading = GLUED | dict(direction="out_of_plane", strain=0.5)
    for unload, expected in ((False, 0.1 / 0.17), (True, 0.125 / 0.17)):
        case = Case.of(lattice=lattice, loading=loading | dict(unload=unload))
        assert case.solver.load_steps == 100
        assert estimate([case], slow).cpu == pytest.approx(expected)


def test_other_programs_take_their_share_of_the_cores(monkeypatch):
    """Of four cores three are busy, one of them by the pilot itself."""
    monkeypatch.setattr("psutil.cpu_percent", lambda: 75.0)
    monkeypatch.setattr("psutil.cpu_count", lambda: 4)

    def busy(case, control):
        end = time.process_time() + 0.2
        while time.process_time() < end:
            pass
        return stand_in()[0](case, control)

    found = estimate(cases(GLUED, (3,)), busy)
    assert 1.9 <= found.others < 3.0
    alone, crowded = (replace(found, cpu=60.0, others=count) for count in (0.0, 2.0))
    assert alone.wall(2, 2) == crowded.wall(2, 4) == 30.0
    assert crowded.wall(2, 2) == 60.0
    assert crowded.wall(1, 2) == 90.0


def test_failed_pilots_are_counted():
    assert estimate(cases(GLUED), stand_in(Status.STOPPED)[0]).failures == ["why"]


def test_pilot_that_breaks_down_leaves_the_time_unknown():
    def huge(case, control):
        raise MemoryError

    found = estimate(cases(GLUED), huge)
    assert "needs more memory than there is" in found.failures[0]
    assert duration(found.cpu) == "unknown"


def test_pilot_can_be_interrupted_while_it_runs():
    def endless(case, control):
        time.sleep(0.1)  # until the main thread waits for this one
        os.kill(os.getpid(), signal.SIGINT)
        while not control[0]:
            time.sleep(0.001)
        return stand_in(Status.STOPPED)[0](case, control)

    with pytest.raises(Interrupted, match="interrupted; no result was written"):
        estimate(cases(GLUED), endless)


@pytest.mark.parametrize(
    ("seconds", "text"),
    [(0.123, "0.12 s"), (95.0, "95 s"), (104.0, "100 s"), (150.0, "2.5 min"), (9000.0, "2.5 h")],
)
def test_durations_are_rough(seconds, text):
    assert duration(seconds) == text
