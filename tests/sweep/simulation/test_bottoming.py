"""Failed impacts and dead loads that have closed all voids of their lattice say so."""

from dataclasses import replace

import numpy as np
import pytest

from sweep.config.case import Case
from sweep.result import Status
from sweep.simulation.bottoming import bottoms_out
from sweep.simulation.retries import simulate_again
from sweep.simulation.simulate import simulate

CELLS = {"cells_x": 2, "cells_y": 2, "nodes_per_wall": 2}
STIFF = {"modulus": 1e7, "density": 1000.0, "poisson": 0.0}
FEW = {"max_iterations": 1, "retry": False}  # whatever snaps fails
LONG = {"time_step": 1e-3, "integrator": "backward_euler", "retry": False}


def struck(mass, loading=None, **solver):
    """A striker at 5 m/s on cells of less than a gram."""
    impact = {"mode": "impact", "striker_mass": mass, "striker_speed": 5.0, "duration": 0.02}
    return Case.of(lattice=CELLS, loading=impact | (loading or {}), solver=solver)


def pressed(force, platen="contact", release_time=5e-3, **solver):
    """A dead load (N) on cells of a linear law."""
    times = {"duration": 5e-3, "release_time": release_time}
    load = {"mode": "force", "force": force, "platen": platen} | times
    return Case.of(lattice=CELLS, material=STIFF, loading=load, solver=solver)


def column(case):
    """The load (N) that presses a column of the mass of the lattice until it is as low as without
    voids.
    """
    filled = simulate(case).summary["relative_density"]
    width, depth = case.lattice.outer_size[0], case.lattice.depth
    return STIFF["modulus"] * (1.0 - filled) * filled * width * depth


def test_an_unresolved_striker_with_twice_the_energy_is_an_answer():
    case = struck(5.0, **LONG)
    assert simulate(case).status == Status.UNRESOLVED
    result = simulate_again(case)
    assert result.status == result.summary["status"] == Status.BOTTOMED_OUT
    assert (result.summary["loaded"], result.summary["bottomed_out"]) == (0, 1.0)
    assert "% of its energy left: the lattice bottoms out" in result.message
    assert "the time integrator removed or created" in result.message


def test_the_energy_left_is_that_of_the_striker_where_the_voids_are_closed():
    """Between two rows, the force of the lattice is taken as constant."""
    result = simulate(struck(5.0, **LONG))
    depth, speed = (result.history[n] for n in ("top_displacement_m", "striker_speed_m_per_s"))
    voids = depth.max() + result.summary["stroke_left_m"]
    row = np.flatnonzero(depth > voids)[0]
    way = (voids - depth[row - 1]) / (depth[row] - depth[row - 1])
    before, after = speed[row - 1 : row + 1] ** 2
    left = 100.0 * (before + way * (after - before)) / 25.0
    said = float(bottoms_out(result).split("with ")[1].split(" %")[0])
    assert left == pytest.approx(said, abs=0.51)


@pytest.mark.parametrize(("mass", "closes"), [(0.005, 0.0), (0.05, 1.0)])
def test_an_unresolved_striker_that_may_hold_is_no_answer(mass, closes):
    """Long steps of backward Euler may close voids that shorter ones leave."""
    result = simulate_again(struck(mass, **LONG))
    assert (result.status, result.summary["bottomed_out"]) == (Status.UNRESOLVED, closes)
    assert bottoms_out(result) == ""


def test_the_energy_left_is_a_share_of_what_weight_adds_too():
    """A striker that falls from a hair gains its energy while it presses the lattice."""
    loading = {"striker_speed": None, "drop_height": 1e-4, "gravity": True, "duration": 0.1}
    result = simulate(struck(50.0, loading, **LONG))
    summary, loading = result.summary, result.case.loading
    assert summary["bottomed_out"] == 1.0
    said = float(bottoms_out(result).split("with ")[1].split(" %")[0])
    voids = summary["peak_strain"] * result.case.height + summary["stroke_left_m"]
    gained = loading.relative_energy + loading.weight * voids
    depth, work = result.history["top_displacement_m"], result.history["work_in_J"]
    kept = np.interp(voids, depth, 25.0 * result.history["striker_speed_m_per_s"] ** 2)
    assert work.max() > 2.0 * loading.relative_energy
    assert said == pytest.approx(100.0 * kept / gained, rel=0.05)


def test_a_striker_that_is_narrower_leaves_voids_beside_it():
    flat = simulate(struck(5.0, **LONG))
    punch = {"striker": "punch", "striker_width": 4e-3}
    narrow = replace(flat, case=struck(5.0, punch, **LONG))
    assert bottoms_out(flat)
    assert bottoms_out(narrow) == ""


@pytest.mark.parametrize("voids", [0.0, 2.0])
def test_voids_that_no_row_closes_are_no_answer(voids):
    """A solid has none; others may be closed for a moment between two rows. voids: strokes."""
    result = simulate(struck(5.0, **LONG))
    stroke = result.summary["peak_strain"] * result.case.height
    changed = {**result.summary, "stroke_left_m": (voids - 1.0) * stroke}
    assert bottoms_out(replace(result, summary=changed)) == ""


def test_a_run_that_is_interrupted_is_run_again():
    case = struck(5.0, **LONG)
    closed = simulate(case)

    def stops(*_):
        return replace(closed, status=Status.STOPPED, message="interrupted", curable=False)

    with pytest.MonkeyPatch.context() as patch:
        patch.setattr("sweep.simulation.retries.simulate", stops)
        assert simulate_again(case, np.array([1, 0, 0])).status == Status.STOPPED
        assert simulate_again(case, np.array([0, 0])).status == Status.BOTTOMED_OUT


@pytest.mark.parametrize(
    ("share", "changes", "status"),
    [
        (1.05, {}, Status.BOTTOMED_OUT),
        (0.95, {}, Status.STOPPED),
        (1.05, {"platen": "none"}, Status.BOTTOMED_OUT),
        (1.05, {"release_time": 1e-4}, Status.STOPPED),  # may not fall far
    ],
)
def test_a_load_that_no_lattice_of_this_mass_bears_is_named_as_such(share, changes, status):
    force = share * column(pressed(1.0))
    result = simulate_again(pressed(force, **changes, **FEW))
    assert result.status == status
    known = "the load is 1.05 times what a solid column" in result.message
    assert known == (status == Status.BOTTOMED_OUT)
    assert ("or swings below its base" in result.message) == ("platen" in changes)


@pytest.mark.parametrize(("newton", "closes"), [(1.0, 0.0), (200.0, 1.0)])
def test_a_dead_load_on_a_platen_has_a_stroke_left(newton, closes):
    """The height of walls, not of their centre lines, is that of the voids."""
    case = pressed(newton)
    summary = simulate(case).summary
    voids = (1.0 - summary["relative_density"]) * case.lattice.outer_size[1]
    assert summary["stroke_left_m"] == pytest.approx(voids - summary["peak_strain"] * case.height)
    assert summary["bottomed_out"] == closes == float(summary["stroke_left_m"] <= 0.0)
    free = simulate(pressed(newton, platen="none", **FEW)).summary
    assert np.isnan(free["stroke_left_m"])
