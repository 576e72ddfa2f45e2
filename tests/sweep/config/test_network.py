"""Centre lines of the walls: of an infill, and of the file of a custom structure."""

import numpy as np

from sweep.config.network import network_of
from sweep.config.structures.structure import Structure
from sweep.design.lattice import build_network
from tests.support.designs.tables import lattice_with


def test_infill_is_drawn_with_its_rows():
    network = network_of(lattice_with(kind="hex", cells_x=2, cells_y=2))
    assert network is build_network(lattice_with(kind="hex", cells_x=2, cells_y=2).geometry)
    assert len(network.bottom) > 0


def test_structure_is_in_metres_and_has_no_rows():
    nodes = ((0.0, 0.0), (10.0, 0.0), (10.0, 20.0))
    built = Structure(nodes_mm=nodes, walls=((0, 1), (1, 2)), wall_thickness_mm=(0.5, 1.0))
    network = network_of(lattice_with(kind="custom", structure=built))
    assert np.allclose(network.points, [(0.0, 0.0), (0.01, 0.0), (0.01, 0.02)], rtol=1e-15)
    assert np.allclose(network.wall_thickness, [0.5e-3, 1e-3], rtol=1e-15)
    assert network.walls.tolist() == [[0, 1], [1, 2]]
    assert len(network.bottom) == len(network.top) == 0
