"""Matrix of blocks: its pattern, homes and room, and tied, held and led coordinates."""

import numpy as np
import pytest

from kernels.linear.condensed import block_ldlt, block_matrix
from kernels.linear.condensed.block_matrix import DRIVEN, HELD, IMAGE, INNER
from tests.support.kernels.blocks import put, reduction_to, shaped
from tests.support.kernels.terms import by_home


@pytest.mark.parametrize("seed", range(3))
def test_ties_and_supports_reduce_the_matrix(seed):
    """Coordinates of one home move together; held and driven ones drop out: R^T A R.

    A driven one pulls by its ratio to the move that is driven.
    """
    rng = np.random.default_rng(seed)
    full = rng.uniform(-1, 1, (10, 10))
    full += full.T
    home = np.array([4, 0, HELD, 1, 4, 8, DRIVEN, 4, DRIVEN, 5])
    ratio = np.where(home == DRIVEN, rng.uniform(-1, 1, 10), 1.0)
    matrix = shaped(np.ones((3, 3), dtype=bool), home, ratio)
    put(matrix, full)
    block_ldlt.add_diagonal(matrix, (7.0,) * 3)
    R = reduction_to(home, 3)
    expected = R.T @ full @ R + np.diag(np.where(R.any(axis=0), 0.0, 7.0))
    np.testing.assert_allclose(by_home(matrix), expected, rtol=0, atol=1e-14)
    np.testing.assert_array_equal(matrix.own, np.diag(by_home(matrix)))
    np.testing.assert_array_equal(matrix.diagonal, np.diag(full))
    driven, free = home == DRIVEN, home >= 0
    np.testing.assert_allclose(matrix.pull[free], full[np.ix_(free, driven)] @ ratio[driven])
    assert matrix.missing[0] == 0
    matrix.missing[0] = 1
    block_matrix.clear(matrix)
    for cleared in (matrix.values, matrix.diagonal, matrix.pull, matrix.missing):
        assert not cleared.any()


NO_ROOM = [(0, 5, True), (0, 3, False), (0, 7, True), (6, 7, False), (1, 0, False), (9, 0, False)]


@pytest.mark.parametrize(("i", "j", "missing"), NO_ROOM)
def test_an_entry_without_room_is_missed(i, j, missing):
    """Entries between blocks that do not couple, or with an unknown that is eliminated inside its
    wall.
    """
    joined = np.eye(3, dtype=bool)
    joined[1, 0] = joined[0, 1] = True
    home = np.array([0, 1, 2, 3, 4, 6, HELD, INNER, INNER, DRIVEN])
    matrix = shaped(joined, home)
    for a, b in ((i, j), (j, i)):
        block_matrix.clear(matrix)
        block_matrix.add(matrix, a, b, 2.0)
        assert matrix.missing[0] == missing
        assert not missing or not matrix.values.any()


@pytest.mark.parametrize("home", [[0, 1, 3, 4], [3, 4, 0, 1], [0, 1, 0, 1], [HELD, 0, 1, 0]])
def test_blocks_of_two_points_are_symmetric(home):
    matrix = shaped(np.ones((2, 2), dtype=bool), np.array(home))
    own, other = np.array([[2.0, 0.5], [0.5, 3.0]]), np.array([[7.0, -1.0], [4.0, 5.0]])
    block_matrix.add_block(matrix, 0, 0, *own.ravel())
    block_matrix.add_block(matrix, 2, 2, *own.ravel())
    block_matrix.add_block(matrix, 0, 2, *other.ravel())
    full = np.block([[own, other], [other.T, own]])
    R = reduction_to(home, 2)
    block_ldlt.add_diagonal(matrix, (1.0,) * 3)
    expected = R.T @ full @ R + np.diag(np.where(R.any(axis=0), 0.0, 1.0))
    np.testing.assert_allclose(by_home(matrix), expected)


def test_blocks_of_images_go_to_what_they_follow():
    """Two points and an image of the first, moved by a mean that is solved for and one led."""
    full = np.random.default_rng(6).uniform(-1, 1, (6, 6))
    full += full.T
    home = np.array([0, 1, 3, 4, IMAGE, IMAGE - 1, 6, DRIVEN])
    images = np.array([[4, 0, 6, 2], [5, 1, 7, -3]])
    start, row = np.array([0, 2, 3, 3]), np.array([1, 2, 2])
    matrix = block_matrix.zero_matrix(home, start, row, np.ones(8), images)
    for i in (0, 2, 4):
        for j in range(0, i + 1, 2):
            block_matrix.add_block(matrix, i, j, *full[i : i + 2, j : j + 2].ravel())
    block_ldlt.add_diagonal(matrix, (1.0,) * 3)
    follows = np.eye(6, 8)
    follows[4:, 4:] = 0.0
    follows[4, [0, 6]], follows[5, [1, 7]] = (1.0, 2.0), (1.0, -3.0)
    reduced, R = follows.T @ full @ follows, reduction_to(home, 3)
    expected = R.T @ reduced @ R + np.diag(np.where(R.any(axis=0), 0.0, 1.0))
    np.testing.assert_allclose(by_home(matrix), expected, rtol=0, atol=1e-14)
    np.testing.assert_allclose(matrix.pull[home >= 0], reduced[home >= 0, 7], rtol=0, atol=1e-14)
    assert matrix.diagonal[7] == pytest.approx(reduced[7, 7])
