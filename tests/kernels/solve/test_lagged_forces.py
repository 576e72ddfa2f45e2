"""Friction in a march: no cost without it, and crushes that it once stopped."""

import pytest

from sweep.config.case import Case
from sweep.simulation.simulate import simulate
from tests.support.converged import converged
from tests.support.designs.tables import MATERIAL


def crushed(contact, strain, steps, **tables):
    """Result of a lattice pressed between glued platens."""
    case = Case.of(
        **dict(lattice=dict(wall_thickness=0.6e-3, nodes_per_wall=2), material=MATERIAL) | tables,
        loading=dict(mode="displacement", strain=strain, unload=False, platen="glued"),
        contact=contact,
        solver=dict(load_steps=steps),
    )
    return simulate(case)


def test_contact_that_nothing_touches_takes_no_iteration():
    """Though its list of pairs is renewed in each of the long steps."""
    models = [dict(model=model) for model in ("barrier", "none")]
    summary, bare = (crushed(model, 0.1, 10).summary for model in models)
    assert not summary["touched"]
    assert summary["newton_iterations"] == bare["newton_iterations"]
    assert summary["absorbed_energy_J"] == pytest.approx(bare["absorbed_energy_J"], rel=1e-12)


def test_few_steps_are_enough():
    """Although the normal forces are taken at the start of a step."""
    *coarse, fine = (
        crushed(dict(friction=0.6), 0.5, steps).summary["absorbed_energy_J"]
        for steps in (50, 100, 200, 400)
    )
    assert coarse == pytest.approx([fine] * 3, rel=5e-4)


def test_duals_that_mislead_are_forgotten():
    """Stout walls snap: Newton goes on by a hundredth of a step at a time if it keeps them."""
    stout = dict(wall_thickness=1.2e-3, nodes_per_wall=8)
    material = dict(name="ultimaker_tpu95a")
    result = crushed(dict(friction=1.0), 0.6, 100, lattice=stout, material=material)
    assert result.status == "converged"


@pytest.mark.parametrize("friction", [0.1, 0.6])
def test_walls_of_acute_corners_are_kept_from_crossing(friction):
    """Where sliced honeycombs end on their perimeters, walls fold flat onto them."""
    lattice = dict(slicer="prusa", pattern="honeycomb", infill=0.3, height=12.5e-3)
    loading = dict(mode="displacement", strain=0.6, unload=False, platen="contact")
    touch, steps = dict(friction=friction), dict(load_steps=100)
    tables = dict(material=dict(name="cheetah"), contact=touch, solver=steps)
    case = Case.of(lattice=lattice, loading=loading, **tables)
    assert converged(case).summary["max_crossings"] == 0


def test_a_violent_motion_slides_smoothly():
    """A light lattice under 54 N moves at hundreds of metres a second until it has given way.

    Over a fixed slip speed of 1 mm/s, contacts would change their signs one by one, and tens of
    thousands of iterations were not enough for the first step.
    """
    case = Case.of(
        lattice=dict(
            kind="circle", cells_x=1, cells_y=5, width=4.69e-3, height=23.4e-3, depth=1.23e-3,
            wall_thickness=1.08e-3, nodes_per_wall=3, imperfection=0.0,
        ),
        material=dict(modulus=83.6e6, density=198.0, poisson=0.0),
        loading=dict(mode="force", force=54.2, release_time=0.163, duration=0.652),
        contact=dict(friction=2.0),
        solver=dict(time_step=0.163, time_limit=60.0, retry=False),
    )  # fmt: skip
    assert converged(case).summary["newton_iterations"] < 3000
