"""The solid of a sheet: the same on any mesh, and by the slicer's lines."""

import pytest

from sweep.config.case import Case
from sweep.scene.plates.scene import build_scene
from sweep.simulation.solid import drawn_mass, filled


@pytest.mark.parametrize("nodes", [2, 4])
def test_the_mass_of_a_sheet_is_area_times_thickness(nodes):
    case = Case.of(
        lattice={"kind": "gyroid", "wall_thickness": 5e-4, "nodes_per_wall": nodes}, loading={}
    )
    of, lattice = build_scene(case), case.lattice
    expected = case.material.density * 5e-4 * lattice.area
    assert drawn_mass(case, of) == pytest.approx(expected, rel=1e-3)
    assert of.terms.coordinates.mass[0::6][:-1].sum() == pytest.approx(expected, rel=1e-3)
    assert filled(case, of) == pytest.approx(3.0915 * 5e-4 / lattice.period, rel=1e-3)


def test_a_slicer_draws_a_little_more_than_it_extrudes():
    """A line is a layer high where the sheet lies flat."""
    values = {"slicer": "prusa", "pattern": "gyroid", "infill": 0.2, "nodes_per_wall": 4}
    case = Case.of(lattice=values, loading={"direction": "out_of_plane"})
    of = build_scene(case)
    extruded = case.material.density * case.lattice.extruded
    assert 1.0 < drawn_mass(case, of) / extruded < 1.05
    assert of.mesh.thickness.min() == case.lattice.layer_height
    assert of.mesh.thickness.max() <= case.lattice.wall_thickness


@pytest.mark.parametrize("direction", ["in_plane", "out_of_plane"])
def test_a_block_is_drawn_nearly_as_it_is_extruded(direction):
    sizes = dict.fromkeys(("width", "height", "depth"), 5e-3)
    values = {"slicer": "prusa", "pattern": "gyroid", "infill": 0.2, "perimeters": 2} | sizes
    case = Case.of(lattice=values, loading={"direction": direction})
    of, (width, height) = build_scene(case), case.lattice.outer_size
    extruded = case.material.density * case.lattice.extruded
    assert drawn_mass(case, of) == pytest.approx(extruded, rel=0.01)
    box = case.material.density * width * height * 5e-3
    assert filled(case, of) == pytest.approx(drawn_mass(case, of) / box, rel=1e-12)
