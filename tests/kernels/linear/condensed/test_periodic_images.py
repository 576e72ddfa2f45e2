"""Images of nodes: they follow a node and the mean strain, and hand on their forces to both."""

import numpy as np
import pytest

from kernels.linear.condensed.periodic_images import NONE, collect, spread

IMAGES = np.array([[4, 0, 6, 2], [5, -1, 7, -1], [3, 1, 7, 0]])  # one of a held coordinate
FOLLOWS = np.eye(8)
FOLLOWS[[3, 4, 5]] = 0.0
FOLLOWS[4, [0, 6]] = 1.0, 2.0
FOLLOWS[5, 7] = -1.0
FOLLOWS[3, 1] = 1.0


def test_images_move_with_what_they_follow():
    move = np.random.default_rng(0).uniform(-1, 1, 8)
    expected = FOLLOWS @ move
    spread(IMAGES, move)
    np.testing.assert_allclose(move, expected, rtol=1e-14)


def test_their_forces_do_the_same_work_on_what_they_follow():
    """The one is the transpose of the other."""
    random = np.random.default_rng(1)
    move, force = random.uniform(-1, 1, (2, 8))
    moved, borne = move.copy(), force.copy()
    spread(IMAGES, moved)
    collect(IMAGES, borne)
    np.testing.assert_allclose(borne, FOLLOWS.T @ force, rtol=0, atol=1e-15)
    assert borne @ move == pytest.approx(force @ moved, rel=1e-13)


def test_without_images_nothing_changes():
    values = np.arange(3.0)
    spread(NONE, values)
    collect(NONE, values)
    assert values.tolist() == [0.0, 1.0, 2.0]
