"""The grid of quads of every infill: counts, areas, directors, joints, triangles."""

import numpy as np
import pytest

from sweep.design.upright_plan import plan_of, quads_along
from sweep.scene.plates.mesh import build_mesh, extruded
from tests.support.designs.plates import BOX, FAMILIES, T, along, network

MESHES = [(kind, "none") for kind in FAMILIES] + [("square", "quarter")]


@pytest.fixture(params=MESHES, ids="-".join)
def mesh(request):
    kind, symmetry = request.param
    return build_mesh(along(kind=kind, symmetry=symmetry, imperfection=0.2).lattice)


def test_counts_of_nodes_and_quads_have_closed_forms(mesh):
    quads = quads_along(mesh.plan, 6)
    columns = len(mesh.plan.points) + (quads - 1).sum()
    assert mesh.n_nodes == columns * (mesh.layers + 1)
    assert len(mesh.quads) == quads.sum() * mesh.layers
    assert len(mesh.bottom) == len(mesh.top) == columns
    assert np.array_equal(np.unique(mesh.quads), np.arange(mesh.n_nodes))


def test_quads_are_the_walls_times_the_height(mesh):
    area = mesh.plan.length.sum() * BOX
    assert mesh.size.prod(axis=1).sum() == pytest.approx(area, rel=1e-12)
    assert mesh.area.sum() == pytest.approx(area, rel=1e-12)
    assert mesh.volume.sum() == pytest.approx(area * T, rel=1e-12)
    assert mesh.node_thickness == pytest.approx(T, rel=1e-12)
    assert mesh.size.min() >= T * (1.0 - 1e-9)


def test_directors_are_the_normals_of_the_walls(mesh):
    start, end = mesh.plan.points[mesh.plan.walls].swapaxes(0, 1)
    along_wall = (end - start) / mesh.plan.length[:, None]
    normal = np.column_stack([along_wall[:, 1], -along_wall[:, 0], np.zeros(len(start))])
    frames = mesh.frames.reshape(-1, 3, 3)
    director = np.einsum("ecij,ecj->eci", frames[mesh.quads], mesh.directors)
    assert np.abs(director - normal[mesh.wall][:, None]).max() < 1e-14
    turned = np.einsum("nij,nkj->nik", frames, frames)
    assert np.abs(turned - np.eye(3)).max() < 1e-14
    assert np.linalg.det(frames) == pytest.approx(1.0)


def test_third_axis_is_the_normal_just_where_all_quads_are_in_one_plane(mesh):
    """There a turn about it moves no director; elsewhere it moves one."""
    third = np.abs(mesh.directors[..., 2])
    least = np.full(mesh.n_nodes, np.inf)
    np.minimum.at(least, mesh.quads.ravel(), third.ravel())
    assert np.array_equal(least > 1.0 - 1e-12, mesh.flat)
    assert np.abs(mesh.directors[mesh.flat[mesh.quads]][:, :2]).max() < 1e-12


def test_walls_share_the_nodes_of_their_joints(mesh):
    """No two nodes are in one place, and each wall begins and ends at the columns of its joints."""
    places = np.round(mesh.rest / (1e-6 * T)).astype(np.int64)
    assert len(np.unique(places, axis=0)) == mesh.n_nodes
    for wall, ends in enumerate(mesh.plan.walls):
        columns = np.unique(mesh.quads[mesh.wall == wall] // (mesh.layers + 1))
        assert set(ends) <= set(columns)
        assert len(columns) == (mesh.wall == wall).sum() // mesh.layers + 1


def test_triangles_cover_the_quads_and_share_their_edges(mesh):
    """An edge inside a wall belongs to two triangles, an edge of a joint to two for each wall,
    others to one.
    """
    flat = mesh.rest[mesh.triangles]
    sides = np.cross(flat[:, 1] - flat[:, 0], flat[:, 2] - flat[:, 0])
    area = 0.5 * np.linalg.norm(sides, axis=1)
    assert area.sum() == pytest.approx(mesh.size.prod(axis=1).sum(), rel=1e-2)
    assert len(mesh.triangles) == 2 * len(mesh.quads)
    pairs = np.sort(mesh.triangles[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2), axis=1)
    edges, uses = np.unique(pairs, axis=0, return_counts=True)
    on_end = (mesh.level[edges] == 0).all(1) | (mesh.level[edges] == mesh.layers).all(1)
    column = edges // (mesh.layers + 1)
    upright = column[:, 0] == column[:, 1]
    arms = np.bincount(mesh.plan.walls.ravel())
    at_joint = upright & (column[:, 0] < len(arms))
    wanted = np.where(on_end, 1, 2)
    wanted[at_joint] = arms[column[at_joint, 0]]
    assert np.array_equal(uses, wanted)


def test_a_wall_through_a_straight_joint_is_one_plane():
    """Walls that are drawn towards each other have opposite normals in one frame."""
    plan = plan_of(network([[0, 0], [2, 0], [4, 0]], [[0, 1], [2, 1]]))
    mesh = extruded(plan, np.array([2, 2]), 3, 3e-3)
    assert mesh.flat.all()
    assert set(np.round(mesh.directors[..., 2].ravel(), 12)) == {1.0, -1.0}


def test_graded_walls_have_their_own_thickness():
    mesh = build_mesh(along(grading=2.0).lattice)
    assert len(np.unique(mesh.thickness.round(9))) > 2
    assert mesh.volume.sum() == pytest.approx((mesh.size.prod(axis=1) * mesh.thickness).sum())


def test_custom_structure_has_its_own_subdivision(tmp_path):
    file = tmp_path / "angle.json"
    file.write_text(
        '{"nodes_mm": [[0, 0], [5, 0], [5, 4]], "walls": [[0, 1], [1, 2]], "subdivide": [5, 2],'
        ' "wall_thickness_mm": [0.5, 0.4], "depth_mm": 7}'
    )
    case = along(kind="custom", file=str(file), wall_thickness=0.45e-3)
    mesh = build_mesh(case.lattice)
    assert (mesh.wall == 0).sum() == 5 * mesh.layers
    assert (mesh.wall == 1).sum() == 2 * mesh.layers
    assert mesh.height == 7e-3
    assert mesh.thickness.min() == pytest.approx(0.4e-3)
