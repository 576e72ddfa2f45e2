"""The study of renumbered lattices: it is the same lattice, and nothing but friction tells."""

import numpy as np
import pytest

from sweep.design.lattice import build_network
from tests.studies.rankings import renumbered
from tests.studies.rankings.renumbered import crushed, scene


def lengths(network):
    """Sorted lengths of the walls and where their middles are."""
    ends = network.points[network.walls]
    middle = ends.mean(axis=1)
    return np.sort(np.linalg.norm(ends[:, 1] - ends[:, 0], axis=1)), middle[np.lexsort(middle.T)]


def test_a_renumbered_network_is_the_same_network():
    network = build_network(scene(0.3).lattice.geometry)
    other = renumbered.renumbered(network, 3)
    assert not np.array_equal(other.points, network.points)
    for one, two in zip(lengths(network), lengths(other), strict=True):
        np.testing.assert_allclose(one, two, rtol=0, atol=1e-15)
    np.testing.assert_array_equal(other.points[other.top], network.points[network.top])
    np.testing.assert_array_equal(other.points[other.bottom], network.points[network.bottom])


@pytest.mark.parametrize(("friction", "most"), [(0.0, 1e-9), (0.3, 3e-3)])
def test_the_order_of_walls_hardly_matters(friction, most):
    case = scene(friction, imperfection=0.1)
    energies = [crushed(case, seed).summary["absorbed_energy_J"] for seed in (None, 1)]
    assert energies[1] == pytest.approx(energies[0], rel=most)
    assert energies[1] != energies[0]
