"""A custom structure as a lattice: its walls in metres."""

import numpy as np
import pytest

from sweep.config.faults import ConfigError
from sweep.config.load import case
from sweep.config.structures.structure import Structure
from tests.support.designs.tables import lattice_with


def test_walls_are_in_metres_and_have_no_rows():
    nodes = ((0.0, 0.0), (10.0, 0.0), (10.0, 20.0))
    built = Structure(nodes_mm=nodes, walls=((0, 1), (1, 2)), wall_thickness_mm=(0.5, 1.0))
    network = lattice_with(kind="custom", structure=built).network
    assert np.allclose(network.points, [(0.0, 0.0), (0.01, 0.0), (0.01, 0.02)], rtol=1e-15)
    assert np.allclose(network.wall_thickness, [0.5e-3, 1e-3], rtol=1e-15)
    assert network.walls.tolist() == [[0, 1], [1, 2]]
    assert len(network.bottom) == len(network.top) == 0


@pytest.mark.parametrize("kind", [{}, {"kind": "custom"}])
def test_a_drawing_needs_its_kind(tmp_path, kind):
    (tmp_path / "a.svg").write_text("<svg/>")
    with pytest.raises(ConfigError, match=r'a drawing; needed: lattice\.kind = "drawn"'):
        case(lattice=kind | {"file": str(tmp_path / "a.svg")})
