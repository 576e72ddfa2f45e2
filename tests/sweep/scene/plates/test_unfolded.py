"""The whole of a lattice from its quarter: the same nodes and quads as the lattice itself."""

import numpy as np
import pytest

from sweep.scene.plates.mesh import build_mesh
from sweep.scene.plates.unfolded import unfolded
from tests.support.designs.plates import along


def meshes(**lattice):
    return [build_mesh(along(symmetry=s, **lattice).lattice) for s in ("none", "quarter")]


def places(points):
    return [tuple(row) for row in np.round(1e9 * points).astype(np.int64)]


@pytest.mark.parametrize("cells", [1, 3])
def test_quarter_unfolds_to_the_bowed_whole(cells):
    whole, quarter = meshes(cells_x=cells, cells_y=cells, imperfection=0.3)
    found = unfolded(quarter)
    points = found.positions(quarter.rest[None])[0]
    assert len(points) == whole.n_nodes
    assert sorted(places(points)) == sorted(places(whole.rest))
    corners = [tuple(sorted(places(points[quad]))) for quad in found.quads]
    assert sorted(corners) == sorted(tuple(sorted(places(whole.rest[q]))) for q in whole.quads)
    assert np.array_equal(np.unique(found.quads), np.arange(len(points)))


def test_normals_of_images_are_the_images_of_normals():
    """Mirrored in x, a normal has the opposite x."""
    _, quarter = meshes(imperfection=0.0)
    found = unfolded(quarter)
    corner = found.positions(quarter.rest[None])[0][found.quads]
    normal = np.cross(corner[:, 1] - corner[:, 0], corner[:, 3] - corner[:, 0])
    normal /= np.linalg.norm(normal, axis=1)[:, None]
    own = normal.reshape(4, -1, 3)
    for k, (x, y) in enumerate([(1, 1), (-1, 1), (1, -1), (-1, -1)]):
        assert np.abs(own[k] - own[0] * [x, y, 1]).max() < 1e-12


def test_whole_stays_as_it_is():
    whole, _ = meshes()
    found = unfolded(whole)
    np.testing.assert_array_equal(found.quads, whole.quads)
    assert np.array_equal(found.positions(whole.rest[None])[0], whole.rest)
