"""The lattice as drawn: a box of infill, or one period."""

import numpy as np
import pytest

from sweep.design.lattice import build_network
from sweep.design.network import Network
from sweep.design.period import Endless
from tests.support.designs.tables import lattice_with


def test_joints_lie_on_a_regular_grid():
    network = build_network(lattice_with(cells_x=3, cells_y=2, width=0.03, height=0.01).geometry)
    assert network.points.shape == (12, 2)
    assert np.array_equal(network.points[:4, 0], np.linspace(0.0, 0.03, 4))
    assert np.array_equal(network.points[::4, 1], [0.0, 0.005, 0.01])


def test_outer_rows_run_from_left_to_right():
    network = build_network(lattice_with(cells_x=3, cells_y=2).geometry)
    assert network.bottom.tolist() == [0, 1, 2, 3]
    assert network.top.tolist() == [8, 9, 10, 11]
    assert np.all(network.points[network.top, 1] == 12.5e-3)


@pytest.mark.parametrize(("cells_x", "cells_y"), [(1, 1), (3, 2), (5, 5)])
def test_every_edge_between_adjacent_joints_is_one_wall(cells_x, cells_y):
    network = build_network(
        lattice_with(cells_x=cells_x, cells_y=cells_y, width=0.02, height=0.01).geometry
    )
    assert len(network.walls) == cells_x * (cells_y + 1) + cells_y * (cells_x + 1)
    assert len(np.unique(np.sort(network.walls, axis=1), axis=0)) == len(network.walls)
    spans = np.abs(np.diff(network.points[network.walls], axis=1)[:, 0])
    pitches = [0.02 / cells_x, 0.01 / cells_y]
    assert np.isclose(spans, pitches).any(axis=1).all()
    assert np.isclose(spans, 0.0).any(axis=1).all()


def test_a_period_is_endless_and_a_box_is_not():
    for boundary, kind in (("periodic", Endless), ("free", Network)):
        assert type(build_network(lattice_with(boundary=boundary).geometry)) is kind
