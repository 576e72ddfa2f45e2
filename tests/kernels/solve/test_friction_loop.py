"""The loop of friction: where it ends, when it is given up, and that nothing is paid without it."""

import numpy as np
import pytest

from kernels.compile.choice import FAST, compiler
from kernels.solve import friction_loop, march, residual
from sweep.config.case import Case, Contact, Lattice, Loading, Material, Solver
from sweep.simulation.simulate import simulate
from tests.studies.stability import draw
from tests.studies.verify import MATERIAL


def crushed(strain, contact, steps, tolerance=1e-8):
    """Summary of a 3 x 3 grid pressed between glued platens."""
    case = Case(
        lattice=Lattice(wall_thickness=0.6e-3),
        material=MATERIAL,
        loading=Loading(mode="displacement", strain=strain, unload=False, platen="glued"),
        contact=contact,
        solver=Solver(load_steps=steps, tolerance=tolerance),
    )
    return simulate(case).summary


def looped(*residuals):
    """Progress of a loop in which friction was off by these (N); 1e-6 are enough."""
    progress = np.zeros(1, march.PROGRESS)[0]
    friction_loop.begin(progress)
    for off in residuals:
        friction_loop._update(off, 1e-6, 1e-9, progress)
    return progress


def test_contact_that_nothing_touches_takes_no_iteration():
    """Though its list of pairs is renewed in each of the long steps."""
    summary, bare = (crushed(0.1, Contact(model=model), 10) for model in ("barrier", "none"))
    assert not summary["touched"]
    assert summary["newton_iterations"] == bare["newton_iterations"]
    assert summary["absorbed_energy_J"] == pytest.approx(bare["absorbed_energy_J"], rel=1e-12)


def test_rough_minima_end_where_those_found_to_the_end_do():
    energies = [
        crushed(0.6, Contact(friction=0.3), 60, tolerance)["absorbed_energy_J"]
        for tolerance in (1e-8, 1e-11)
    ]
    assert energies[0] == pytest.approx(energies[1], rel=1e-7)


def test_a_minimum_is_found_as_well_as_friction_is_known():
    assert looped().loosening == 1.0
    assert looped(1.0).loosening == pytest.approx(0.1 / 1e-9)
    assert looped(1.0, 1e-3).loosening == pytest.approx(1e-4 / 1e-9)
    assert looped(1.0, 9e-6).loosening == 1.0  # the next may be the last
    assert looped(*np.geomspace(1.0, 1e-3, friction_loop.INEXACT_LOOPS + 1)).loosening == 1.0
    assert looped(np.nan).loosening == looped(np.inf).loosening == 1.0


def test_round_off_of_a_stiff_contact_is_admissible_up_to_a_share_of_friction():
    tolerance = residual.Tolerance(1e-9, 1e-12, 1e-6, 1e-5, 1e-15, 1e-16, 100)
    assert friction_loop._admissible(0.0, 1e9, tolerance) == 1e-6
    assert friction_loop._admissible(1.0, 1e9, tolerance) == 1e-5
    assert friction_loop._admissible(1.0, 1e12, tolerance) == pytest.approx(1e-4)
    assert friction_loop._admissible(1.0, 1e30, tolerance) == 1e-2


def test_a_loop_is_given_up_once_it_goes_in_circles():
    falling = np.geomspace(1.0, 0.1, friction_loop.MAX_LOOPS - 1)
    assert not friction_loop.fails(looped(*falling))
    assert friction_loop.fails(looped(*falling, 0.05))
    circle = [1.0, *[2.0, 1.0] * (friction_loop.STAGNATION // 2)]
    assert not friction_loop.fails(looped(*circle[:-1]))
    assert friction_loop.fails(looped(*circle))


def test_duals_that_mislead_are_forgotten():
    """Stout walls snap: Newton goes on by a hundredth of a step at a time if it keeps them."""
    case = Case(
        lattice=Lattice(wall_thickness=1.2e-3, nodes_per_wall=8),
        material=Material(name="ultimaker_tpu95a"),
        loading=Loading(mode="displacement", strain=0.6, unload=False, platen="glued"),
        contact=Contact(friction=1.0),
        solver=Solver(load_steps=100),
    )
    assert simulate(case).status == "converged"


@pytest.mark.skipif(compiler() != FAST, reason="in which scene it does not settle, rounding tells")
def test_a_loop_that_does_not_settle_is_told():
    found = simulate(draw.scene(478)[1])
    assert found.status == "stopped"
    assert found.message.endswith(
        "friction did not settle; try more solver.load_steps or a smaller contact.friction"
    )
