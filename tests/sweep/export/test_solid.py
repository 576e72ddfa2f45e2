"""Bodies are closed and have the computed mass."""

import numpy as np
import pytest
import trimesh

from sweep.config.case import Case
from sweep.export.design import design_of
from sweep.export.errors import ExportError
from sweep.export.outline import outline, panel, specimen
from sweep.export.solid import Body, extruded, solid
from tests.support.designs.infills import EDGES, KINDS, lattice_of
from tests.support.results.exported import grid

THICKNESSES = (0.2e-3, 0.85e-3)
SINGLE = np.float32  # of an STL


def made(design, sides=None):
    shape = outline(design.network)
    part = panel(design, shape, sides) if sides else specimen(design, shape)
    return solid(part, 1e9 * part.specimens * design.volume)


def read_by_another_program(body):
    """A mesh whose equal corners are one, as a slicer makes it of an STL."""
    mesh = trimesh.Trimesh(body.points.astype(SINGLE), body.triangles, process=False)
    mesh.merge_vertices()
    return mesh


@pytest.mark.parametrize(("kind", "way"), KINDS)
@pytest.mark.parametrize("edge", EDGES)
@pytest.mark.parametrize("thickness", THICKNESSES)
def test_every_family_is_a_closed_body_of_the_mass(kind, way, edge, thickness):
    changes = EDGES[edge] | {"wall_thickness": thickness, "grading": 1.3}
    design = design_of(Case.of(lattice=lattice_of(kind, way, **changes)))
    mesh = read_by_another_program(made(design))
    assert mesh.is_watertight
    assert mesh.is_winding_consistent
    assert mesh.volume == pytest.approx(1e9 * design.volume, rel=2e-4)
    assert mesh.body_count == 1


def test_volume_of_a_grid_is_its_closed_form():
    area = 13.3**2 - 9 * (12.5 / 3 - 0.8) ** 2
    assert made(design_of(grid(3))).volume == pytest.approx(12 * area, rel=1e-6)


def test_panel_has_a_body_for_each_specimen():
    design = design_of(grid(3))
    mesh = read_by_another_program(made(design, (0.1, 0.05)))
    assert mesh.is_watertight
    assert mesh.body_count == 7
    assert mesh.volume == pytest.approx(28 * 1e9 * design.volume, rel=1e-5)


def test_body_that_is_too_heavy_is_refused():
    design = design_of(grid(3))
    part = specimen(design, outline(design.network))
    volume = 1e9 * design.volume
    assert solid(part, 0.996 * volume)
    with pytest.raises(
        ExportError, match=r"its mass / density is .*; allowed: a difference of 0.5"
    ):
        solid(part, 0.994 * volume)


def test_body_with_a_hole_or_a_turned_side_is_open():
    cube = trimesh.creation.box()
    points, sides = np.array(cube.vertices), np.array(cube.faces)
    assert Body(points, sides).is_closed
    assert Body(points, sides).volume == pytest.approx(1.0)
    assert not Body(points, sides[1:]).is_closed
    turned = np.concatenate([sides[:1, ::-1], sides[1:]])
    assert not Body(points, turned).is_closed


def test_cubes_that_share_an_edge_are_not_closed():
    import shapely

    squares = shapely.multipolygons([shapely.box(0, 0, 1, 1), shapely.box(1, 1, 2, 2)])
    part = specimen(design_of(grid(3)), squares)._replace(depth=1.0)
    assert not extruded(part).is_closed
    with pytest.raises(ExportError, match="not closed, as walls touch in a single line"):
        solid(part, 2.0)
