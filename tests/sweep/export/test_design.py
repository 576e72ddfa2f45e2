"""The design of a case: its drawing, its mass, and cases that are no parts."""

import numpy as np
import pytest

from sweep.config.case import Case
from sweep.config.load import load_config
from sweep.design.lattice import build_network
from sweep.export.design import design_of
from sweep.export.errors import ExportError
from tests.support.designs.tables import lattice_with


def assert_of_its_volume(case):
    """Mass / density is the volume of the drawing, which is returned."""
    found = design_of(case)
    assert found.volume == pytest.approx(1e-3 * found.grams / case.material.density, rel=1e-12)
    return found


@pytest.mark.parametrize("wish", [{"mass": 1.2e-3}, {"infill": 0.2, "width": 50e-3}])
def test_what_follows_from_a_wish_is_drawn(wish):
    case = Case.of(lattice=wish)
    found, drawn = design_of(case), build_network(case.lattice.geometry)
    np.testing.assert_array_equal(found.network.points, drawn.points)
    np.testing.assert_array_equal(found.network.wall_thickness, drawn.wall_thickness)


def test_custom_structure_is_drawn_as_in_its_file():
    case = load_config("custom").cases[0]
    found = assert_of_its_volume(case)
    np.testing.assert_allclose(1e3 * found.network.points, case.lattice.structure.nodes_mm)


@pytest.mark.parametrize(
    ("key", "why"),
    [
        ("boundary", r"lattice\.boundary.*no part; allowed: \.csv"),
        ("sides", r"wide panel, .*no part; allowed"),
    ],
)
def test_a_period_is_no_part(key, why):
    with pytest.raises(ExportError, match=why):
        design_of(Case.of(lattice={key: "periodic"}, loading={"mode": "displacement"}))


@pytest.mark.parametrize("perimeters", [0, 1])
def test_design_that_is_pressed_along_its_cells_stands_on_its_plan(perimeters):
    lattice = lattice_with(height=9e-3, depth=14e-3, perimeters=perimeters, cells_x=2, cells_y=2)
    assert_of_its_volume(Case.of(lattice=lattice, loading=dict(direction="out_of_plane")))


@pytest.mark.parametrize(
    "wish",
    [
        {"pattern": "grid", "mass": 3e-3},
        {"pattern": "honeycomb", "infill": 0.3, "fill_angle": 0.2},
        {"pattern": "tri-hexagon", "infill": 0.2, "fill_multiline": 2, "perimeters": 3},
    ],
)
def test_infill_of_a_slicer_is_heavier_as_extruded(wish):
    found = assert_of_its_volume(
        Case.of(lattice=dict(slicer="orca", width=25e-3, height=25e-3, **wish))
    )
    if "mass" in wish:
        assert found.extruded_grams == pytest.approx(3.0, rel=5e-3)
    assert found.extruded_grams > found.grams
    assert design_of(Case.of()).extruded_grams is None
