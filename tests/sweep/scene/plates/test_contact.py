"""Who touches whom: walls over their thickness, nodes that no platen holds, images in mirrors."""

import numpy as np
import pytest

from sweep.scene.plates.contact import contact_of, mirror_of
from sweep.scene.plates.coordinates import Numbering
from sweep.scene.plates.mesh import build_mesh
from tests.support.designs.plates import BOX, T, along


def built(platen="glued", model="auto", **lattice):
    case = along(platen, **lattice).changed(contact=dict(model=model))
    mesh = build_mesh(case.lattice)
    return mesh, contact_of(mesh, Numbering(mesh.n_nodes), case), mirror_of(mesh, case)


def once(edges):
    return {tuple(sorted(nodes)) for nodes in edges.tolist()}


def test_walls_touch_over_their_thickness():
    mesh, contact, _ = built()
    assert contact.reach == pytest.approx(1.5 * T)
    assert np.array_equal(contact.thickness, mesh.node_thickness)
    assert np.array_equal(contact.rest_thickness, mesh.node_thickness)
    assert len(contact.triangles) == 2 * len(mesh.quads)
    assert once(contact.edges) == once(contact.triangles[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2))
    assert len(contact.edges) == len(once(contact.edges))


def test_bonded_ends_do_not_touch_their_platen():
    mesh, contact, _ = built()
    every = np.arange(mesh.n_nodes)
    assert np.array_equal(contact.low_nodes, np.setdiff1d(every, mesh.bottom))
    assert np.array_equal(contact.high_nodes, np.setdiff1d(every, mesh.top))
    assert contact.low_rest.min() == pytest.approx(BOX / mesh.layers)


def test_loose_ends_are_half_a_thickness_from_their_platen():
    mesh, contact, _ = built("contact")
    assert len(contact.low_nodes) == len(contact.high_nodes) == mesh.n_nodes
    assert contact.low_rest.min() == pytest.approx(0.5 * T)
    assert contact.high_rest.min() == pytest.approx(0.5 * T)


def test_without_contact_only_loose_platens_touch():
    _, contact, mirror = built(model="none", symmetry="quarter")
    assert len(contact.triangles) == len(contact.low_nodes) == len(mirror.node) == 0
    mesh, contact, _ = built("contact", model="none")
    assert len(contact.triangles) == 0
    assert len(contact.low_nodes) == mesh.n_nodes


def test_mirrors_are_met_by_all_nodes_that_are_not_on_them():
    mesh, _, mirror = built(symmetry="quarter")
    for axis in (0, 1):
        of = mirror.coordinate % 6 == axis
        assert np.array_equal(mirror.node[of], np.flatnonzero(~mesh.on[:, axis]))
        assert mirror.place[of] == pytest.approx(0.5 * BOX)
        apart = 0.5 * BOX - mesh.rest[mirror.node[of], axis]
        assert np.array_equal(mirror.rest[of], apart)
