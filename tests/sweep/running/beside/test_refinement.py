"""A case with more or fewer elements and steps."""

import json
from math import prod

import numpy as np
import pytest

from sweep.config.case import Case
from sweep.config.structures.structure_file import read_structure
from sweep.design.upright_plan import most_layers
from sweep.running.beside.refinement import layers, refined
from tests.support.designs.structures import BEAM

CRUSH = {"mode": "displacement", "strain": 0.5}


def crush(elements, steps):
    return Case.of(
        lattice=dict(nodes_per_wall=elements - 1), loading=CRUSH, solver=dict(load_steps=steps)
    )


@pytest.mark.parametrize(
    ("times", "elements", "steps"),
    [((2.0, 1.0), 10, 20), ((1.0, 4.0), 5, 80), ((0.5, 0.5), 2, 10), ((0.1, 0.01), 1, 1)],
)
def test_a_refined_case_is_that_of_its_numbers(times, elements, steps):
    assert refined(crush(5, 20), *times).case_id == crush(elements, steps).case_id


def test_a_number_of_elements_may_be_asked_for():
    for before in range(1, 30):
        assert refined(crush(before, 20), elements=12 / before).lattice.pieces == (12,)


def test_a_case_without_a_change_is_itself():
    along = Case.of(loading=CRUSH | {"direction": "out_of_plane"})
    for case in (crush(3, 7), along):
        assert refined(case) == case


def test_times_of_steps_scale_as_their_order():
    case = Case.of(solver=dict(integrator="bdf2", step_error=1e-6))
    fine = refined(case, steps=2.0).solver
    assert fine.time_step == pytest.approx(0.5 * case.solver.time_step)
    assert fine.step_error == pytest.approx(1e-6 / 8.0)
    assert fine.load_steps is None


def test_rounded_steps_under_a_speed_last_as_long_together():
    """Half of three steps is one."""
    loading = dict(mode="displacement", speed=1e-3, stroke=5e-3)
    coarse = refined(Case.of(loading=loading, solver=dict(time_step=5 / 3)), steps=0.5).solver
    assert (coarse.load_steps, coarse.time_step) == (1, pytest.approx(5.0))


def test_layers_of_plates_grow_up_to_the_thickness_of_walls():
    along = Case.of(loading=CRUSH | {"direction": "out_of_plane"})
    before = along.lattice.layers
    most = most_layers(np.array([along.lattice.wall_thickness]), along.lattice.depth)
    assert refined(along, elements=2.0).lattice.layers == min(2 * before, most)
    assert refined(along, elements=100.0).lattice.layers == most
    assert layers(along.lattice, 10 * most, thicker=2.0)["layers"] < most
    assert layers(along.lattice, 0)["layers"] == 1


def test_every_wall_of_a_structure_is_divided(tmp_path):
    file = tmp_path / "beam.json"
    file.write_text(json.dumps(BEAM | {"subdivide": 3}))
    lattice = dict(kind="custom", structure=read_structure(file), file=str(file))
    case = Case.of(lattice=lattice, loading=dict(mode="custom"))
    assert prod(refined(case, elements=2.0).lattice.pieces) == 2 * prod(case.lattice.pieces)
