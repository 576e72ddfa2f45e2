"""The print of a lattice: its area, mass and density."""

import numpy as np
import pytest

from sweep.design.lattice import build_network
from sweep.design.network import Network, mass, relative_density
from tests.support.designs.tables import lattice_with


def closed_form(lattice):
    """Outer box less the openings: (W + t)(H + t) - n_x n_y (p_x - t)(p_y - t)."""
    t = lattice.wall_thickness
    opening_x = lattice.width / lattice.cells_x - t
    opening_y = lattice.height / lattice.cells_y - t
    openings = lattice.cells_x * lattice.cells_y * opening_x * opening_y
    return (lattice.width + t) * (lattice.height + t) - openings


@pytest.mark.parametrize("cells", [(1, 1), (1, 3), (2, 1), (3, 3), (4, 7)])
@pytest.mark.parametrize("thickness", [0.1e-3, 0.8e-3])
def test_printed_area_counts_joints_once(cells, thickness):
    lattice = lattice_with(
        cells_x=cells[0], cells_y=cells[1], height=20e-3, wall_thickness=thickness
    )
    assert build_network(lattice.geometry).printed_area == pytest.approx(
        closed_form(lattice), rel=1e-11
    )


def test_printed_area_of_the_seed_is_the_closed_form_of_a_square_grid():
    n, p, t = 3, 12.5e-3 / 3, 0.8e-3
    expected = (n * p + t) ** 2 - n**2 * (p - t) ** 2
    assert build_network(lattice_with().geometry).printed_area == pytest.approx(expected, rel=1e-12)


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
