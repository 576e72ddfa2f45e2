"""Lattices sized by a share of infill or by their mass."""

from itertools import product

import numpy as np
import pytest

from sweep.config.case import Case
from sweep.design.drawing import pitch
from sweep.design.infill import families
from sweep.design.lattice import build_network
from sweep.design.network import mass
from sweep.design.sizing import cell_of, cells_of_size, infill_share
from tests.support.designs.tables import lattice_with, material_with


@pytest.mark.parametrize("kind", families())
@pytest.mark.parametrize("extra", [{}, {"perimeters": 1}, {"grading": 2.0}])
def test_a_mass_is_met(kind, extra):
    lattice = dict(kind=kind, width=0.02, height=0.02, mass=1.4e-3, **extra)
    made = Case.of(lattice=lattice, material=dict(name="ninjaflex")).lattice
    found = mass(build_network(made.geometry), made.depth, material_with().density)
    assert found == pytest.approx(1.4e-3, rel=1e-12)
    again = Case.model_validate(Case.of(lattice=made).model_dump())
    assert again.lattice.wall_thickness == pytest.approx(made.wall_thickness, rel=1e-12)


@pytest.mark.parametrize("kind", families())
@pytest.mark.parametrize("share", [0.1, 0.25])
def test_a_share_of_infill_is_met_as_nearly_as_cells_allow(kind, share):
    box = {"width": 80e-3, "height": 60e-3, "line_width": 0.45e-3}
    lattice = lattice_with(kind=kind, infill=share, perimeters=2, **box)
    assert lattice.wall_thickness == 0.45e-3
    assert infill_share(lattice.geometry) == pytest.approx(share, rel=0.1)


def test_share_of_a_square_grid_is_that_of_slicers():
    """Two lines of width w each pitch, in either direction; lines on the outline are no infill."""
    lattice = lattice_with(width=0.1, height=0.1, infill=0.2, perimeters=1)
    assert (lattice.cells_x, lattice.cells_y) == (26, 26)
    assert infill_share(lattice.geometry) == pytest.approx(2 * 0.4e-3 / 0.1 * 25)


@pytest.mark.parametrize("kind", families())
def test_cells_of_a_size_are_the_whole_numbers_that_come_nearest(kind):
    """No other number of columns or rows has cells nearer to regular ones of this size."""
    made = lattice_with(kind=kind, width=0.1, height=0.015, wall_thickness=0.2e-3, cell_size=4e-3)
    count = made.cells_x, made.cells_y
    assert count == (25, 4)
    shape = pitch(kind, made.orientation)
    regular = 4e-3 * shape / shape[0]

    def missed(cells):
        return np.abs(np.log(cell_of(made.geometry._replace(cells=cells)) / regular))

    least = missed(count)
    for axis, step in product((0, 1), (-1, 1)):
        other = [n + step * (k == axis) for k, n in enumerate(count)]
        assert missed(tuple(other))[axis] > least[axis]


def test_cells_are_measured_as_they_are_drawn():
    """Honeycomb: the distance of its columns."""
    comb = lattice_with(kind="hex", width=0.1, height=0.015, cell_size=4e-3)
    points = build_network(comb.geometry).points
    bottom = np.sort(points[points[:, 1] == 0.0, 0])
    assert np.diff(bottom) == pytest.approx(cell_of(comb.geometry)[0])


def test_a_period_has_whole_pairs_of_rows_that_are_shifted():
    box = dict(boundary="periodic", width=30e-3, height=10e-3, cell_size=4e-3)
    for kind, size in (("hex", 4e-3), ("hex", 3e-3), ("kagome", 2e-3)):
        made = lattice_with(kind=kind, wall_thickness=0.2e-3, **box | dict(cell_size=size))
        assert made.cells_y % 2 == 0
    tied = box | dict(kind="hex", boundary="free", sides="periodic")
    assert lattice_with(**tied).cells_y == 3
    assert lattice_with(orientation="flat", **tied).cells_x % 2 == 0
    assert cells_of_size(lattice_with(**box).geometry, 4e-3, 100) == (8, 3)
