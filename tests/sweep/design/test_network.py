"""The print of a lattice: its area, mass and density."""

import numpy as np
import pytest

from sweep.design.lattice import build_network
from sweep.design.network import Network, mass, relative_density
from tests.support.designs.tables import lattice_with


def test_walls_of_different_thickness():
    points = np.array([[0.0, 0.0], [1.0, 0.0], [2.0, 0.0]])
    walls, ends = np.array([[0, 1], [1, 2]]), np.array([0])
    network = Network(points, walls, np.array([0.1, 0.2]), ends, ends)
    assert network.printed_area == pytest.approx(0.3)


def test_mass_and_relative_density_of_the_published_specimen():
    lattice = lattice_with(
        width=12e-3, height=12e-3, depth=12e-3, wall_thickness=0.4e-3, cells_x=3, cells_y=3
    )
    network = build_network(lattice.geometry)
    assert mass(network, lattice.depth, 1220.0) == pytest.approx(0.543e-3, rel=1e-3)
    assert relative_density(network, lattice.outer_size) == pytest.approx(0.241, abs=5e-4)
