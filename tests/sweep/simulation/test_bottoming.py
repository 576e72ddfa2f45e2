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


def struck(mass, **solver):
    """A striker at 5 m/s on cells of 2.5 g."""
    impact = {"mode": "impact", "striker_mass": mass, "striker_speed": 5.0, "duration": 0.02}
    return Case.of(lattice=CELLS, loading=impact, solver=solver)


def pressed(force, **solver):
    """A dead load (N) on cells of a linear law, without contact."""
    load = {"mode": "force", "force": force, "duration": 5e-3}
    contact = {"model": "none"}
    return Case.of(lattice=CELLS, material=STIFF, loading=load, contact=contact, solver=solver)


def column(case):
    """The load (N) that presses a column of the mass of the lattice until it is as low as without
    voids.
    """
    filled = simulate(case).summary["relative_density"]
    width, depth = case.lattice.outer_size[0], case.lattice.depth
    return STIFF["modulus"] * (1.0 - filled) * filled * width * depth


def test_an_unresolved_striker_that_has_closed_all_voids_is_an_answer():
    case = struck(5.0, time_step=1e-3, integrator="backward_euler", retry=False)
    assert simulate(case).status == Status.UNRESOLVED
    result = simulate_again(case)
    assert result.status == result.summary["status"] == Status.BOTTOMED_OUT
    assert (result.summary["loaded"], result.summary["bottomed_out"]) == (0, 1.0)
    closed = float(result.message.split("at strain ")[1].split(",")[0])
    voids = result.summary["stroke_left_m"] / case.height + result.history["strain"].max()
    assert voids <= closed < voids + 0.2
    assert "% of its energy left: the lattice bottoms out" in result.message


def test_the_energy_left_is_that_of_the_striker_where_the_voids_are_closed():
    case = struck(5.0, time_step=1e-3, integrator="backward_euler", retry=False)
    result = simulate(case)
    depth, speed = (result.history[n] for n in ("top_displacement_m", "striker_speed_m_per_s"))
    row = np.flatnonzero(depth - depth.max() >= result.summary["stroke_left_m"])[0]
    assert f"with {100.0 * (speed[row] / 5.0) ** 2:.2g} % of" in bottoms_out(result)


def test_an_unresolved_striker_that_leaves_voids_is_no_answer():
    case = struck(0.05, time_step=5e-3, integrator="backward_euler", retry=False)
    result = simulate_again(case)
    assert result.status == Status.UNRESOLVED
    assert bottoms_out(result) == ""


def test_a_run_that_is_interrupted_is_run_again():
    case = struck(5.0, time_step=1e-3, integrator="backward_euler")
    closed = simulate(case)

    def stops(*_):
        return replace(closed, status=Status.STOPPED, message="interrupted", curable=False)

    with pytest.MonkeyPatch.context() as patch:
        patch.setattr("sweep.simulation.retries.simulate", stops)
        assert simulate_again(case, np.array([1, 0])).status == Status.STOPPED
        assert simulate_again(case, np.array([0, 0])).status == Status.BOTTOMED_OUT


@pytest.mark.parametrize(("share", "status"), [(1.05, Status.BOTTOMED_OUT), (0.95, Status.STOPPED)])
def test_a_load_that_no_lattice_of_this_mass_bears_is_named_as_such(share, status):
    force = share * column(pressed(1.0))
    result = simulate_again(pressed(force, **FEW))
    assert result.status == status
    assert result.summary["peak_strain"] < 1.0 - result.summary["relative_density"]
    assert ("the load is 1.05 times that which presses a column" in result.message) == (share > 1.0)


def test_a_load_that_has_closed_all_voids_before_it_failed_is_an_answer():
    result = simulate(pressed(0.95 * column(pressed(1.0)), **FEW))
    assert bottoms_out(result) == ""
    deep = {**result.summary, "peak_strain": 1.001 - result.summary["relative_density"]}
    assert "the load has closed all voids (strain 0." in bottoms_out(replace(result, summary=deep))
