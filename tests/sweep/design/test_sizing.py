"""Lattices asked for by a share of infill or by their mass."""

import pytest

from sweep.config.case import Case
from sweep.design.infill import families
from sweep.design.lattice import build_network
from sweep.design.network import mass
from sweep.design.sizing import infill_share
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
    """Two lines of width w each pitch, in either direction; those on the outline are no infill."""
    lattice = lattice_with(width=0.1, height=0.1, infill=0.2, perimeters=1)
    assert (lattice.cells_x, lattice.cells_y) == (26, 26)
    assert infill_share(lattice.geometry) == pytest.approx(2 * 0.4e-3 / 0.1 * 25)
