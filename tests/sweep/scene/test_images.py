"""Images of the nodes of a period: whom they follow, that they weigh nothing and count nothing."""

import numpy as np
import pytest

from sweep.design.network import mass
from sweep.scene.images import Repeated, images_of
from sweep.scene.sides import build_tied
from tests.support.designs.periods import L, lattice_of, pressed


def scene_of(platen):
    lattice = lattice_of("hex", (2, 2), 0.1, repeats="sides")
    case = pressed(lattice, platen=platen, friction=0.3)
    return case, build_tied(case)


def test_images_follow_what_they_copy_unless_they_are_held_or_tied():
    """Three nodes: one of the period, and its images one period to the right and one above."""
    rows = np.empty(0, np.int64)
    shift = np.array([[0, 0], [1, 0], [0, 1]])
    numbering = Repeated(3, rows, rows, np.array([0, 0, 0]), shift)
    low, high = numbering.low, numbering.high
    leader = np.arange(numbering.size)
    leader[1] = leader[5] = -1  # y of the node is held, and y of the second image
    found = images_of(numbering, leader, (low, high), np.array([1.0, 0.0])).tolist()
    assert found == [[2, 0, low, 1], [4, 0, low, 0], [3, -1, high, 0]]


@pytest.mark.parametrize("platen", ["glued", "sliding", "contact"])
def test_a_period_has_the_mass_of_its_walls_and_images_have_none(platen):
    case, scene = scene_of(platen)
    masses, n = scene.terms.coordinates.mass, scene.terms.layout.n_nodes
    own = scene.terms.layout.origin[:n] == np.arange(n)
    assert not masses[: 2 * n].reshape(n, 2)[~own].any()
    total = mass(scene.network, case.lattice.depth, case.material.density)
    assert masses[0 : 2 * n : 2].sum() == pytest.approx(total, rel=1e-12)


@pytest.mark.parametrize("platen", ["glued", "contact"])
def test_contact_counts_the_nodes_of_the_period_only(platen):
    _, scene = scene_of(platen)
    touch, n = scene.terms.contact, scene.terms.layout.n_nodes
    own = scene.terms.layout.origin[:n] == np.arange(n)
    assert touch.tributary.sum() == pytest.approx(scene.mesh.rest_length.sum(), rel=1e-12)
    assert not touch.tributary[~own].any()
    assert not touch.special_weight[~own[touch.special_node]].any()
    assert own[touch.platen_nodes].all()
    assert len(touch.platen_nodes) > 0


def test_copies_are_walls_of_the_period_moved_by_whole_periods():
    case, scene = scene_of("contact")
    points, n = scene.mesh.points, scene.terms.layout.n_nodes
    moved = (points - points[scene.terms.layout.origin[:n]]) / case.lattice.width
    np.testing.assert_allclose(moved[:, 1], 0.0, atol=1e-12)
    np.testing.assert_allclose(moved[:, 0], moved[:, 0].round(), atol=1e-9)
    assert set(moved[:, 0].round()) == {-1.0, 0.0, 1.0}
    assert len(scene.around) > 0
    assert case.lattice.width > 2 * L
