"""Bodies are closed and have the computed mass."""

import numpy as np
import pytest
import shapely
import trimesh

from sweep.config.case import Case
from sweep.export.design import design_of
from sweep.export.errors import ExportError
from sweep.export.outline import outline, specimen
from sweep.export.solid import Body, extruded, solid
from tests.support.designs.infills import EDGES, KINDS, lattice_of
from tests.support.results.exported import grid

THICKNESSES = (0.2e-3, 0.85e-3)


@pytest.mark.parametrize(("kind", "way"), KINDS)
@pytest.mark.parametrize("edge", EDGES)
@pytest.mark.parametrize("thickness", THICKNESSES)
def test_every_family_is_a_closed_body_of_the_mass(kind, way, edge, thickness):
    """As a slicer reads it from an STL, where equal corners are one."""
    changes = EDGES[edge] | {"wall_thickness": thickness, "grading": 1.3}
    design = design_of(Case.of(lattice=lattice_of(kind, way, **changes)))
    body = solid(specimen(design, outline(design.network)), 1e9 * design.volume)
    mesh = trimesh.Trimesh(body.points.astype(np.float32), body.triangles, process=False)
    mesh.merge_vertices()
    assert mesh.is_watertight
    assert mesh.is_winding_consistent
    assert mesh.volume == pytest.approx(1e9 * design.volume, rel=2e-4)
    assert mesh.body_count == 1


def test_body_that_is_too_heavy_is_refused():
    design = design_of(grid(3))
    part = specimen(design, outline(design.network))
    assert solid(part, 0.996e9 * design.volume)
    with pytest.raises(ExportError, match=r"mass / density is .*; allowed: a difference of 0.5"):
        solid(part, 0.994e9 * design.volume)


def test_body_with_a_hole_or_a_turned_side_is_open():
    cube = trimesh.creation.box()
    points, sides = np.array(cube.vertices), np.array(cube.faces)
    assert Body(points, sides).is_closed
    assert Body(points, sides).volume == pytest.approx(1.0)
    assert not Body(points, sides[1:]).is_closed
    turned = np.concatenate([sides[:1, ::-1], sides[1:]])
    assert not Body(points, turned).is_closed


def test_cubes_that_share_an_edge_are_not_closed():
    squares = shapely.multipolygons([shapely.box(0, 0, 1, 1), shapely.box(1, 1, 2, 2)])
    part = specimen(design_of(grid(3)), squares)._replace(depth=1.0)
    assert not extruded(part).is_closed
    with pytest.raises(ExportError, match="not closed, as walls touch in a single line"):
        solid(part, 2.0)
