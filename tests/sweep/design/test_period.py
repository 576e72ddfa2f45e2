"""Endless lattices: one period, wherever it is cut, and the copies that its walls may touch."""

from unittest.mock import patch

import numpy as np
import pytest
import shapely

from sweep.design import period
from sweep.design.infill import families
from sweep.design.lattice import build_network
from sweep.design.network import relative_density
from tests.support.designs.periods import L, cut_elsewhere, lattice_of


@pytest.mark.parametrize("kind", families())
def test_all_families_have_a_period(kind):
    """Its density depends neither on the cut nor on the number of periods."""
    found = []
    for cells, cut in (((1, 2), (0, 0)), ((2, 2), (0, 0)), ((2, 4), (0.3 * L, 0.7 * L))):
        with cut_elsewhere(cut):
            made = period.build_period(lattice_of(kind, cells, 0.05).geometry)
        found.append(made.printed_area / np.prod(cells))
    same = pytest.approx([found[0]] * 3, rel=1e-9)
    assert found == same, f"{kind} does not repeat after one column and two rows"


def test_density_of_the_endless_square_grid():
    lattice = lattice_of("square", (2, 3), 0.1)
    assert relative_density(build_network(lattice.geometry), lattice.outer_size) == pytest.approx(
        1 - 0.9**2
    )


@pytest.mark.parametrize("kind", families())
def test_copies_have_all_walls_round_the_openings_of_a_period(kind):
    """More copies make no smaller opening next to its walls."""
    lattice = lattice_of(kind, (1, 2), 0.05)
    sizes = []
    for reach in (period.REACH, 2.5):
        with patch.object(period, "REACH", reach):
            network = period.build_period(lattice.geometry)
        lines = shapely.linestrings(network.points[network.walls])
        cells = shapely.get_parts(shapely.polygonize(lines))
        beside = shapely.STRtree(cells).query(lines[: network.own], "covered_by")
        between = np.bincount(beside[0], minlength=network.own)
        assert np.all(between == 2), f"a wall of {kind} is not between two openings"
        sizes.append(np.sort(shapely.area(cells[beside[1]])))
    np.testing.assert_allclose(*sizes, rtol=1e-9)
