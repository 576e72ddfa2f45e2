"""Which coordinates of plates move: platens, turns without stiffness, mirror planes, masses."""

import numpy as np
import pytest

from sweep.scene.plates.coordinates import Numbering, at_rest, heights, leaders, masses
from sweep.scene.plates.mesh import build_mesh
from tests.support.designs.plates import BOX, FAMILIES, T, along


def parts(platen, **lattice):
    """The mesh, and whether the coordinates of each node are free, (n, 6)."""
    mesh = build_mesh(along(**lattice).lattice)
    leader = leaders(mesh, platen)
    return mesh, leader, (leader == np.arange(leader.size))[:-2].reshape(-1, 6)


@pytest.mark.parametrize("kind", FAMILIES)
def test_only_the_turn_about_the_normal_of_one_plane_is_held_inside(kind):
    mesh, _, free = parts("contact", kind=kind)
    assert np.array_equal(free[:, 5], ~mesh.flat)
    assert free[:, :5].all()


def test_glued_ends_keep_their_place_and_their_bearing_but_not_their_slope():
    mesh, leader, free = parts("glued")
    low, high = leader.size - 2, leader.size - 1
    assert (leader[low], leader[high]) == (-1, high)
    for nodes in (mesh.bottom, mesh.top):
        wall = nodes[mesh.flat[nodes]]
        joint = nodes[~mesh.flat[nodes]]
        assert not free[nodes, :3].any()
        assert free[wall, 3].all()
        assert not free[wall, 4:].any()
        assert free[joint, 3:5].all()
        assert not free[joint, 5].any()
    assert np.all(leader[6 * mesh.top + 2] == high)
    assert np.all(leader[6 * mesh.bottom + 2] == -1)
    inside = np.setdiff1d(np.arange(mesh.n_nodes), np.append(mesh.bottom, mesh.top))
    assert free[inside, :5].all()


def test_clamped_ends_keep_their_slope_too():
    mesh, leader, free = parts("clamped")
    ends = np.append(mesh.bottom, mesh.top)
    assert not free[ends].any()
    assert np.all(leader[6 * mesh.top + 2] == leader.size - 1)


def test_mirror_planes_hold_what_would_leave_them():
    """A wall along x meets its plane at a right angle: it may move in y and z, and turn about x."""
    mesh, _, free = parts("contact", symmetry="quarter")
    for axis in (0, 1):
        nodes = np.flatnonzero(mesh.on[:, axis])
        assert len(nodes) == 2 * (mesh.layers + 1)
        along_wall = mesh.frames.reshape(-1, 3, 3)[nodes, :, 0]
        assert np.abs(along_wall[:, axis]) == pytest.approx(1.0)
        moves = np.arange(3) != axis
        assert np.array_equal(free[nodes, :3], np.tile(moves, (len(nodes), 1)))
        assert np.array_equal(free[nodes, 3:], np.tile([True, False, False], (len(nodes), 1)))


def test_platens_are_at_the_ends_or_half_a_thickness_outside():
    mesh = build_mesh(along().lattice)
    assert heights(mesh, "glued") == heights(mesh, "clamped") == (0.0, BOX)
    assert heights(mesh, "contact") == pytest.approx((-0.5 * T, BOX + 0.5 * T))
    x = at_rest(mesh, "glued")
    assert x.size == Numbering(mesh.n_nodes).size
    assert np.array_equal(x[:-2].reshape(-1, 6)[:, :3], mesh.rest)
    assert not x[:-2].reshape(-1, 6)[:, 3:].any()
    assert x[-1] == BOX


def test_masses_sum_to_the_print_along_each_axis():
    mesh = build_mesh(along(kind="kagome").lattice)
    found = masses(mesh, 2.5e-3, 0.05)
    assert found[:-2].reshape(-1, 6)[:, :3].sum(axis=0) == pytest.approx(np.full(3, 2.5e-3))
    assert not found[:-2].reshape(-1, 6)[:, 3:].any()
    assert found[-2:].tolist() == [0.0, 0.05]
