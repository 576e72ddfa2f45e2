"""Arcs along the path of a structure: their length, their weights, their history."""

import numpy as np
import pytest

from sweep.config.case import Case
from sweep.scene.arc_length import arc_of, path_columns
from sweep.scene.custom import build_structure
from tests.support.designs.structures import BEAM, LENGTH, MATERIAL, MM, end_load, structure


def arc(**solver):
    """The scene of a cantilever, and its arc."""
    lattice = dict(kind="custom", structure=structure(**BEAM | end_load(-1e-3)))
    case = Case.of(lattice=lattice, material=MATERIAL, solver=solver)
    scene = build_structure(case)
    return scene, arc_of(scene, case)


def test_nodes_weigh_by_their_share_of_walls_and_rotations_do_not():
    scene, found = arc(integrator="arc_length", load_steps=40)
    nodes = 2 * len(scene.mesh.points)
    x, y = found.weight[:nodes].reshape(-1, 2).T
    np.testing.assert_array_equal(x, y)
    assert x.sum() == pytest.approx(1.0)
    inner = np.full(31, 1 / 32)
    np.testing.assert_allclose(x, [1 / 64, 1 / 64, *inner], rtol=1e-12)
    assert not found.weight[nodes:].any()
    assert found.path.size == 41


def test_as_many_arcs_as_steps_make_the_diagonal_unless_their_length_is_given():
    _, found = arc(integrator="arc_length", load_steps=40)
    assert found.length == pytest.approx(LENGTH * MM / 40)
    _, found = arc(integrator="arc_length", arc_length=2e-3)
    assert (found.length, found.path.size) == (2e-3, 201)


def test_without_a_path_there_are_no_arcs_and_no_columns():
    _, found = arc(integrator="static")
    assert found is None
    assert path_columns(found, 3) == {}


def test_columns_are_what_the_rows_found():
    _, found = arc(integrator="arc_length", load_steps=4)
    found.path["factor"], found.path["unstable"] = np.arange(5) / 4, [0, 0, 1, 2, 1]
    columns = path_columns(found, 3)
    assert columns["load_factor"].tolist() == [0.0, 0.25, 0.5]
    assert columns["unstable_modes"].tolist() == [0, 0, 1]
