"""A case that cannot finish is a row with a message: nothing raises, and finished steps are
kept.
"""

import threading
import time
from unittest.mock import patch

import numpy as np
import pytest

from kernels.solve import outcomes
from sweep.columns import ABSORBED_AT, COLUMNS, HISTORY_COLUMNS
from sweep.config.case import Case
from sweep.result import Status
from sweep.simulation.failures import ADVICE, stopped
from sweep.simulation.simulate import simulate
from tests.support.designs.scenes import is_sound, pressed

LONG = Case.of(
    lattice=dict(cells_x=8, cells_y=8, wall_thickness=0.4e-3),
    loading=dict(mode="displacement", strain=0.6),
    solver=dict(load_steps=2000, time_limit=60.0),
)


def check_kept(result):
    """All columns are there, and whatever rows there are hold numbers."""
    rows = len(result.history["strain"])
    assert {name for name in result.summary if not ABSORBED_AT.fullmatch(name)} == set(COLUMNS)
    assert set(HISTORY_COLUMNS) <= set(result.history)
    assert {len(column) for column in result.history.values()} == {rows}
    for name, column in result.history.items():
        assert name in ("min_gap_m", "base_pressure_x_m") or np.all(np.isfinite(column))
    assert np.all(np.isfinite(result.frames["position_m"]))
    assert result.summary["status"] == result.status
    assert result.summary["message"] == result.message
    return rows


def test_time_limit():
    case = LONG.model_copy(update={"solver": LONG.solver.model_copy(update={"time_limit": 1.0})})
    begun = time.monotonic()
    result = simulate(case)
    assert time.monotonic() - begun < 6.0
    assert result.status == Status.TIMED_OUT
    assert result.message.startswith("solver.time_limit of 1 s reached while loading, at strain")
    assert 1 < check_kept(result) < 2001


def test_limit_of_iterations():
    """A static step that fails is halved, and may take twice as many, up to sixteen times."""
    result = simulate(pressed(3, 0.6, 5, friction=0.3, solver={"max_iterations": 1}))
    assert result.status == Status.STOPPED
    assert "while loading, at strain" in result.message
    assert "within 16 Newton iterations while loading" in result.message
    assert 1 <= check_kept(result) < 6


def test_stop_that_is_asked_for_before_the_start():
    result = simulate(LONG, np.array([1, 0, 0]))
    assert result.status == Status.STOPPED
    assert result.message.startswith("interrupted while loading, at strain 0 after 0 steps")
    assert check_kept(result) == 1


def test_stop_that_is_asked_for_in_the_middle():
    control, results = np.zeros(3, dtype=np.int64), []
    worker = threading.Thread(target=lambda: results.append(simulate(LONG, control)))
    worker.start()
    limit = time.monotonic() + 30
    while control[1] < 3 and time.monotonic() < limit:
        time.sleep(0.01)
    control[0] = 1
    worker.join(5.0)
    assert not worker.is_alive()
    assert results[0].status == Status.STOPPED
    assert results[0].message.startswith("interrupted while loading")
    assert 3 < check_kept(results[0]) == control[1] + 1 < 2001
    assert control[2] == 4000  # loaded and unloaded
    strains = 0.6 * np.arange(control[1] + 1) / 2000
    np.testing.assert_allclose(results[0].history["strain"], strains, atol=1e-12)


EXTREMES = {
    "one cell of single elements": Case.of(
        lattice=dict(cells_x=1, cells_y=1, nodes_per_wall=0),
        loading=dict(mode="displacement"),
    ),
    "crushed flat at once": Case.of(
        loading=dict(mode="displacement", strain=0.999),
        solver=dict(load_steps=1, max_iterations=10),
    ),
    "walls that almost fill the cells": Case.of(
        lattice=dict(cells_x=2, cells_y=2, wall_thickness=3.1e-3),
        loading=dict(mode="displacement", strain=0.3, platen="contact"),
        solver=dict(load_steps=20),
    ),
    "walls like foil": Case.of(
        lattice=dict(wall_thickness=2e-5),
        loading=dict(mode="displacement"),
        solver=dict(load_steps=30),
    ),
    "a heavy load": Case.of(
        loading=dict(force=1e3, platen="contact", duration=2e-3), solver=dict(time_step=1e-3)
    ),
    "one step": Case.of(loading=dict(force=10.0, platen="contact"), solver=dict(time_step=0.2)),
    "100 m/s": Case.of(loading=dict(mode="displacement", speed=100.0), solver=dict(load_steps=30)),
    "walls bent like arches": Case.of(
        lattice=dict(imperfection=20.0),
        loading=dict(mode="displacement", strain=0.4),
        solver=dict(load_steps=40),
    ),
    "walls that stick": Case.of(
        loading=dict(mode="displacement", platen="contact"),
        contact=dict(friction=5.0),
        solver=dict(load_steps=30, max_iterations=30),
    ),
    "a tolerance below round-off": Case.of(
        loading=dict(mode="displacement", strain=0.2), solver=dict(tolerance=1e-16)
    ),
}


@pytest.mark.parametrize("name", EXTREMES)
def test_extremes_raise_nothing_and_cross_nowhere(name):
    result = simulate(EXTREMES[name])
    check_kept(result)
    assert result.summary["max_crossings"] == 0
    if result.status == Status.CONVERGED:
        assert is_sound(result)
    else:
        assert result.status == Status.STOPPED
        assert "; try " in result.message


def test_a_book_that_does_not_close_is_no_result():
    with patch("sweep.simulation.simulate.GAP", -1.0):
        result = simulate(pressed(3, 0.2, 10))
    assert result.status == Status.STOPPED
    assert result.message.startswith(
        "work and energies do not balance at strain 0.2 after 10 steps;"
    )


@pytest.mark.parametrize(("newton", "status"), [(1e-7, Status.STOPPED), (1e-2, Status.CONVERGED)])
def test_a_load_of_which_round_off_is_left_over_is_too_small(newton, status):
    """The book of no converged case is open, however small its load."""
    loading = {"mode": "force", "platen": "contact", "force": newton}
    hexagons = {"kind": "hex", "cells_x": 3, "cells_y": 3, "wall_thickness": 8e-4}
    tpu = {"name": "cheetah", "loss": 0.3}
    result = simulate(Case.of(lattice=hexagons, material=tpu, loading=loading))
    assert result.status == status
    assert ("the forces are too small" in result.message) == (status == Status.STOPPED)


def test_every_end_of_the_solver_has_its_advice():
    """Except those after which the march continues, or calls the solver again."""
    known = {value for name, value in vars(outcomes).items() if name.isupper()}
    goes_on = {outcomes.CONVERGED, outcomes.OUTGROWN, outcomes.UNFINISHED}
    assert {*ADVICE, outcomes.INTERRUPTED} == known - goes_on


def test_a_load_on_walls_without_contact_is_told_to_have_none():
    """Unless something else than the minimisation has failed, or contact acts."""
    apart = Case.of(loading=dict(force=1e3), contact=dict(model="none"))
    why = 'try contact.model "barrier"'
    said = [
        stopped(case, outcome, "while loading, here", driven=False)[1]
        for case in (apart, Case.of(loading=dict(force=1e3)))
        for outcome in (outcomes.STALLED, outcomes.NOT_FINITE)
    ]
    assert [why in message for message in said] == [True, False, False, False]
