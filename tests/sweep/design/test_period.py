"""Endless lattices: one period, wherever it is cut, and the copies that its walls may touch."""

from unittest.mock import patch

import numpy as np
import pytest
import shapely

from sweep.design import period
from sweep.design.drawing import extent, pitch
from sweep.design.geometry import Geometry
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


@pytest.mark.parametrize("kind", families())
def test_all_families_repeat_between_rows_of_any_number(kind):
    """One column of three rows is the increment of a wide lattice per column."""
    (one, _), (wide, _), (wider, width) = (
        drawn(kind, cells, sides) for cells, sides in ((2, True), (24, False), (28, False))
    )
    assert one.printed_area / 2 == pytest.approx((wider.printed_area - wide.printed_area) / 4)
    rows = len(wider.bottom) - len(wide.bottom), len(wider.top) - len(wide.top)
    assert (2 * len(one.bottom), 2 * len(one.top)) == rows
    assert np.ptp(one.points[one.bottom, 0]) < 2 * L < width


def drawn(kind, cells, tied):
    """The network of cells of pitch L in three rows, and its width, m."""
    low, high = extent(kind, None, (cells, 3))
    width = L * cells if tied else float(L * (high - low)[0] / pitch(kind, None)[0])
    shape = Geometry(kind, None, (cells, 3), (width, 3 * L), 0.05 * L, periodic=(tied, False))
    return build_network(shape), width


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
