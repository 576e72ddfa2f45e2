"""Walls as chains: how elements lie, and products with the stiffness of their vectors."""

import numpy as np
import pytest

from kernels.terms import elements
from tests.support.frames import joint_of_four, shaken, walls_of
from tests.support.terms import assembled, motions, room

FRAME = joint_of_four()
WALLS = walls_of(FRAME)


def random_stiffness(seed):
    """Any symmetric one, but without hinges behind the last elements of walls."""
    _, stiffness = room(WALLS)
    rng = np.random.default_rng(seed)
    for part in stiffness:
        part[:] = rng.uniform(-1, 1, part.shape)
    stiffness.next[:, WALLS.start[1:] - 1] = 0.0
    return stiffness


@pytest.mark.parametrize("seed", range(3))
def test_measure_fills_directions_and_lengths(seed):
    x, (shape, _) = shaken(FRAME, seed), room(WALLS)
    along = (motions(WALLS, x.size) @ x)[: 2 * len(FRAME.edges)].reshape(-1, 2)
    length = np.linalg.norm(along, axis=1)
    assert elements.measure(x, WALLS, shape) == pytest.approx(length.min(), rel=1e-14)
    np.testing.assert_allclose(shape.length, length, rtol=1e-14)
    np.testing.assert_allclose(shape.t, (along / length[:, None]).T, rtol=0, atol=1e-14)


@pytest.mark.parametrize("seed", range(3))
def test_a_product_is_that_of_the_whole_matrix(seed):
    stiffness, (shape, _) = random_stiffness(seed), room(WALLS)
    u = np.random.default_rng(seed + 9).uniform(-1, 1, FRAME.rest.size)
    shape.slope[0], shape.moment[:] = 0.3, -0.2  # of another term: they stay
    before, found = np.zeros((2, u.size))
    elements.gather(WALLS, shape, before)
    form = elements.product(WALLS, stiffness, u, 0.7, shape)
    elements.gather(WALLS, shape, found)
    expected = assembled(WALLS, stiffness, u.size) @ u
    assert np.abs(expected).max() > 0.1
    np.testing.assert_allclose(found - before, 0.7 * expected, rtol=0, atol=1e-13)
    assert form == pytest.approx(u @ expected, rel=1e-12)


def test_gather_is_the_transpose_of_the_motions():
    """A moment turns against the rotation of its joint. What is there stays."""
    shape, _ = room(WALLS)
    rng = np.random.default_rng(1)
    shape.slope[:], shape.moment[:] = rng.uniform(-1, 1, (2, 7)), rng.uniform(-1, 1, 8)
    forces = np.concatenate([shape.slope.T.ravel(), -shape.moment])
    g = np.ones(FRAME.rest.size)
    elements.gather(WALLS, shape, g)
    np.testing.assert_allclose(g, 1.0 + motions(WALLS, g.size).T @ forces, rtol=0, atol=1e-14)


def test_sums_are_scaled_and_cleared():
    one, other, (shape, _) = random_stiffness(1), random_stiffness(2), room(WALLS)
    expected = [a + 0.3 * b for a, b in zip(one, other, strict=True)]
    elements.add_scaled(one, other, 0.3)
    for found, part in zip(one, expected, strict=True):
        np.testing.assert_allclose(found, part, rtol=1e-14)
    elements.product(WALLS, other, np.ones(FRAME.rest.size) + FRAME.rest, 1.0, shape)
    shape.length[:] = 1.0
    assert shape.slope.any()
    elements.clear(shape, one)
    assert not any(part.any() for part in (*one, shape.slope, shape.moment))
    assert np.all(shape.length == 1.0)
