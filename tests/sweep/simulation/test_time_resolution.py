"""Impacts in steps that are too long are no results, and say which steps would do."""

import numpy as np
import pytest

from sweep.config.case import Case
from sweep.config.units import in_si
from sweep.result import Status
from sweep.simulation.simulate import simulate
from sweep.simulation.time_resolution import (
    LOCAL,
    MOST_LOST,
    integrator_share,
    momentum_share,
    path_error,
    peak_row,
    striker_share,
)
from tests.studies.stability.draw import scene
from tests.support.converged import converged
from tests.support.designs.scenes import is_sound, pressed

CELLS = {"cells_x": 2, "cells_y": 2, "nodes_per_wall": 2}
RIGHT = 67.8  # N, of steps of 2 us by newmark
AT_ENERGY, AT_MOMENTUM = "time integrator removed", "impulse on the support"


def struck(time_step=None, integrator=None, step_error=None, **loading):
    """A striker of 50 g at 2 m/s on 2 x 2 cells, which throw it back after 12 ms."""
    impact = {"mode": "impact", "striker_mass": 0.05, "striker_speed": 2.0, "duration": 0.02}
    solver = {"time_step": time_step, "integrator": integrator, "step_error": step_error}
    return Case.of(lattice=CELLS, loading=impact | loading, solver=solver)


@pytest.mark.parametrize(
    ("case", "why"),
    [
        (struck(0.02, "newmark"), AT_ENERGY),
        (struck(0.02, "backward_euler"), AT_ENERGY),
        (struck(5e-3, "backward_euler"), AT_ENERGY),
        (struck(0.02, platen="contact"), AT_MOMENTUM),
        (struck(5e-3, platen="contact"), AT_MOMENTUM),
        (struck(2e-3, step_error=1e-6), AT_MOMENTUM),
    ],
    ids=["back at once", "one step", "three steps", "loose", "loose, four", "rows far apart"],
)
def test_steps_longer_than_the_contact_are_no_result(case, why):
    result = simulate(case)
    assert result.status == result.summary["status"] == Status.UNRESOLVED
    assert why in result.message
    assert result.summary["peak_force_N"] < 0.5 * RIGHT
    assert "try a solver.time_step of 6.25 us" in result.message


@pytest.mark.parametrize(("speed", "time_step"), [(0.01, 2e-3), (20.0, 5e-4)])
def test_a_message_names_steps_that_do(speed, time_step):
    """A share of the contact of a slow striker, and of the passage of a fast one."""
    result = simulate(struck(time_step, striker_speed=speed, striker_mass=5e-4))
    assert result.status == Status.UNRESOLVED
    words = result.message.split("time_step of ")[1].split()
    step = in_si(" ".join(words[:2]), "s")
    finer = converged(struck(step, striker_speed=speed, striker_mass=5e-4))
    assert is_sound(finer)


def test_a_short_run_is_not_one_of_long_steps():
    result = simulate(struck(duration=2e-3))
    assert result.status == Status.STOPPED
    assert "the striker still moves down" in result.message


@pytest.mark.parametrize(
    ("time_step", "integrator", "share", "error"),
    [
        (1e-4, "backward_euler", (0.05, 0.2), (0.1, 0.2)),
        (1e-5, "backward_euler", (0.01, 0.03), (0.0, 0.03)),
        (1e-4, "bdf2", (0.02, 0.08), (0.03, 0.1)),
        (1e-5, "bdf2", (0.0, 0.003), (0.0, 0.005)),
    ],
)
def test_what_the_integrator_takes_is_a_measure_of_the_error(time_step, integrator, share, error):
    result = converged(struck(time_step, integrator))
    assert share[0] <= result.summary["integrator_share"] < share[1]
    assert error[0] <= 1.0 - result.summary["peak_force_N"] / RIGHT < error[1]


def test_static_steps_have_no_share():
    history = {"work_in_J": np.array([0.0, -2.0]), "dissipated_integrator_J": np.array([0.0, 1.0])}
    assert integrator_share(struck().loading, history) == 0.5
    assert np.isnan(integrator_share(pressed(2, 0.1, 5).loading, history))
    assert np.isnan(integrator_share(struck().loading, dict.fromkeys(history, np.zeros(2))))


def test_what_the_integrator_takes_from_vibrations_is_no_error_of_the_striker():
    """Nothing else damps them; with an eighth of the steps the share is below 0.1 %."""
    case = Case.of(
        lattice={"nodes_per_wall": 2}, loading={"mode": "impact"}, damping={"model": "none"}
    )
    shorter = {"integrator": "newmark", "time_step": case.solver.time_step / 8}
    usual, fine = (simulate(each) for each in (case, case.changed(solver=shorter)))
    assert usual.status == fine.status == Status.CONVERGED
    assert usual.summary["integrator_share"] > 0.2 > 0.001 > fine.summary["integrator_share"]
    for name in ("peak_force_N", "peak_strain"):
        assert usual.summary[name] == pytest.approx(fine.summary[name], rel=0.02)


@pytest.mark.parametrize("platen", ["glued", "contact"])
def test_the_support_bears_what_striker_and_row_bring(platen):
    """The glued row has no small part of the momentum of so light a striker."""
    case = struck(platen=platen, striker_mass=5e-4, striker_speed=3.0, time_step=2e-6)
    result = simulate(case)
    assert momentum_share(case.loading, result.history, 1e-3 * result.summary["mass_g"], 0.0) < 0.01


def test_what_damping_takes_from_the_mass_is_not_missing():
    """A light striker bounces off hexagons that are damped to rest before their base notices."""
    case = scene(41)[1]
    result = converged(case)
    mass = 1e-3 * result.summary["mass_g"]
    shares = [
        momentum_share(case.loading, result.history, mass, a) for a in (0.0, case.damping.mass)
    ]
    assert shares[0] > 1.0 > MOST_LOST > shares[1]


def half_wave(rows, share=1.0):
    """A striker of 50 g at 2 m/s on a spring without mass, in ``rows``; share: of its force."""
    time = np.linspace(0.0, 1.0, rows)
    speed = 2.0 * np.cos(np.pi * time)
    return {
        "time_s": time,
        "striker_speed_m_per_s": speed,
        "target_speed_m_per_s": 0.0 * speed,
        "reaction_bottom_N": share * 0.1 * np.pi * np.sin(np.pi * time),
        "work_in_J": np.full(rows, 0.1),
        "kinetic_J": 0.025 * speed**2,
        "dissipated_integrator_J": 0.03 * np.sin(np.pi * time),
    }


def test_shares_of_a_half_wave():
    loading = struck().loading
    assert momentum_share(loading, half_wave(1001), 0.0, 0.0) == pytest.approx(0.0, abs=1e-5)
    assert momentum_share(loading, half_wave(1001, 0.9), 0.0, 0.0) == pytest.approx(0.2, rel=1e-4)
    assert momentum_share(loading, half_wave(2), 0.0, 0.0) == pytest.approx(2.0)
    assert integrator_share(loading, half_wave(1001)) == pytest.approx(0.3)
    assert striker_share(half_wave(1001)) == pytest.approx(np.pi**2 / 2000, rel=1e-5)
    swings = half_wave(1001, 0.9)
    swings["kinetic_J"] = swings["kinetic_J"] + 0.1
    assert momentum_share(loading, swings, 5e-4, 0.0) == pytest.approx(0.1, rel=1e-3)


def loaded(**solver):
    load = {"mode": "force", "platen": "contact", "force": 10.0}
    load |= {"release_time": 0.01, "duration": 0.02}
    return Case.of(lattice=CELLS, loading=load, solver=solver)


@pytest.mark.parametrize("integrator", LOCAL)
def test_local_errors_of_a_path_fall_with_the_order_of_the_integrator(integrator):
    """The path u = 1 - cos t until t = pi has the error C h^(p+1) max |u^(p+1)| / 2."""
    order, constant = LOCAL[integrator]
    case = loaded(integrator=integrator)
    for rows in (100, 400):
        time = np.linspace(0.0, 2.0 * np.pi, rows + 1)
        error = path_error(case, {"strain": 0.5 * (1.0 - np.cos(time))}, 1.0)
        assert error == pytest.approx(0.5 * constant * time[1] ** (order + 1), rel=0.05)


@pytest.mark.parametrize("integrator", LOCAL)
def test_a_path_of_too_few_rows_has_no_bound_of_its_error(integrator):
    order, _ = LOCAL[integrator]
    strain = np.array([0.0, 0.1, 0.05, 0.0, 0.0])
    error = path_error(loaded(integrator=integrator), {"strain": strain}, 0.1)
    assert (error == np.inf) == (order > 1)


def test_only_dead_loads_have_a_path_and_one_that_does_not_move_has_none():
    """A stated error of steps is compared with the path."""
    history = {"strain": np.array([0.0, 0.1, 0.05])}
    assert np.isnan(path_error(struck(), history, 0.1))
    assert np.isnan(path_error(pressed(2, 0.1, 5), history, 0.1))
    assert np.isnan(path_error(loaded(), {"strain": np.zeros(3)}, 0.0))
    case = loaded(step_error=1e-6)
    assert path_error(case, history, 0.2) == pytest.approx(0.1e-6 / (0.2 * case.height))


def test_peaks_between_rows_are_those_of_the_steps():
    """With a stated error of steps rows may be far apart; with shorter rows nothing changes."""
    solver = {"integrator": "newmark", "step_error": 1e-7}
    far, near = (simulate(loaded(**solver, time_step=h)).summary for h in (1e-3, 5e-5))
    for name in ("peak_strain", "peak_force_N"):
        assert far[name] == pytest.approx(near[name], rel=0.02)


@pytest.mark.parametrize(
    ("force", "row"),
    [([0, 5, 9.5, 10, 2], 3), ([0, 5, 10], None), ([10, 9.5, 1], 0), ([0, 8, 10, 8.5], None)],
)
def test_the_peak_of_a_dead_load_needs_a_row_beside_it(force, row):
    assert peak_row(loaded().loading, np.array(force)) == row
    assert peak_row(struck().loading, np.array(force)) == int(np.argmax(force))


def test_the_force_of_a_blow_between_two_rows_is_not_known():
    """A sudden load acts on its plate; backward Euler softens the blow."""
    hard, soft = (simulate(loaded(integrator=each)).summary for each in ("bdf2", "backward_euler"))
    assert np.isnan([hard["peak_force_N"], hard["peak_force_at_densification_N"]]).all()
    assert soft["peak_force_N"] == soft["peak_force_at_densification_N"] >= 10.0
