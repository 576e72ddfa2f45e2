"""Matrix of blocks: assembly by home, LDL^T factor, solve, directions of negative curvature."""

import numpy as np
import pytest

from kernels.linear import block_ldlt, block_matrix, periodic_images
from kernels.linear.block_matrix import DRIVEN, HELD, INNER
from tests.support.terms import by_home, dense, full_matrix

NB = 12


def filled(joined):
    """Pattern (nb, nb) with the fill of eliminating the blocks one after the other."""
    joined = joined | np.eye(len(joined), dtype=bool)
    for j in range(len(joined)):
        behind = j + 1 + np.flatnonzero(joined[j + 1 :, j])
        joined[np.ix_(behind, behind)] = True
    return joined


def random_pattern(rng, nb=NB):
    """Symmetric pattern of ``nb`` blocks, closed under elimination."""
    joined = rng.uniform(size=(nb, nb)) < 1.5 / nb
    return filled(joined | joined.T)


def shaped(joined, home=None, ratio=None):
    """Zero matrix with the blocks of a closed pattern; by default every slot is a coordinate."""
    nb = len(joined)
    below = [j + 1 + np.flatnonzero(joined[j + 1 :, j]) for j in range(nb)]
    start = np.cumsum([0, *map(len, below)])
    home = np.arange(3 * nb) if home is None else home
    ratio = np.ones(home.size) if ratio is None else ratio
    return block_matrix.zero_matrix(home, start, np.concatenate(below), ratio, periodic_images.NONE)


def put(matrix, full, room=None):
    """Add the lower half of an (n, n) array where there is ``room``, (n, n) of bool."""
    for i in range(len(full)):
        for j in range(i + 1):
            if room is None or room[i, j]:
                block_matrix.add(matrix, i, j, full[i, j])


def by_entry(joined):
    """Pattern of the entries of a pattern of blocks."""
    return np.kron(joined, np.ones((3, 3), dtype=bool))


def definite(rng, joined):
    """Random symmetric positive definite array with that pattern."""
    square = rng.uniform(-1, 1, (3 * len(joined),) * 2)
    square = np.where(by_entry(joined), square + square.T, 0.0)
    return square + np.diag(np.abs(square).sum(axis=1) + 0.1)


def made(joined, full, scale):
    """Matrix with these entries, ready to be factored."""
    matrix = shaped(joined)
    put(matrix, full, by_entry(joined))
    block_ldlt.add_diagonal(matrix, scale)
    return matrix


def solved(matrix, b):
    """Solution (3 nb,) by home after the factor."""
    matrix.vector[:] = b
    block_ldlt.forward(matrix)
    block_ldlt.backward(matrix, matrix.start.size - 1)
    return matrix.vector.copy()


@pytest.mark.parametrize("scale", [1.0, 1e9, 1e-9])
@pytest.mark.parametrize("seed", range(5))
def test_factor_and_solve(seed, scale):
    rng = np.random.default_rng(seed)
    joined = random_pattern(rng)
    full = scale * definite(rng, joined)
    matrix, b = made(joined, full, scale), rng.uniform(-1, 1, len(full))
    np.testing.assert_array_equal(by_home(matrix), full)
    assert block_ldlt.factor(matrix, scale, block_ldlt.ROUNDED) == (-1, 0.0)
    np.testing.assert_allclose(full @ solved(matrix, b), b, rtol=0, atol=1e-12)


@pytest.mark.parametrize("seed", range(3))
def test_the_factor_times_its_diagonal_times_its_transpose_is_the_matrix(seed):
    rng = np.random.default_rng(seed)
    joined = random_pattern(rng)
    full = definite(rng, joined)
    matrix = made(joined, full, 1.0)
    block_ldlt.factor(matrix, 1.0, block_ldlt.ROUNDED)
    kept = by_home(matrix)
    inside = by_entry(np.eye(NB, dtype=bool))
    lower = np.tril(np.where(inside, 0.0, kept)) + np.eye(len(full))
    diagonal = np.linalg.inv(np.where(inside, kept, 0.0))
    np.testing.assert_allclose(lower @ diagonal @ lower.T, full, rtol=0, atol=1e-13 * len(full))
    assert not matrix.values[:-1].reshape(-1, block_matrix.STRIDE)[:, 3].any()


@pytest.mark.parametrize("seed", range(5))
def test_updates_are_where_the_products_of_a_column_belong(seed):
    rng = np.random.default_rng(seed)
    joined = random_pattern(rng, 20)
    matrix = shaped(joined)
    place = {(j, j): j for j in range(20)}
    for j in range(20):
        for q in range(matrix.start[j], matrix.start[j + 1]):
            place[matrix.row[q], j] = 20 + q
    expected = [
        block_matrix.SIZE * place[a, b]
        for j in range(20)
        for b in matrix.row[matrix.start[j] : matrix.start[j + 1]]
        for a in matrix.row[matrix.start[j] : matrix.start[j + 1]]
        if b <= a
    ]
    assert len(expected) > 50
    np.testing.assert_array_equal(matrix.update, expected)


def reduction_to(home, nb):
    """Matrix (n, 3 nb) of ones where a coordinate has its home."""
    return (np.asarray(home)[:, None] == np.arange(3 * nb)).astype(float)


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
    block_ldlt.add_diagonal(matrix, 7.0)
    R = reduction_to(home, 3)
    expected = R.T @ full @ R + np.diag(np.where(R.any(axis=0), 0.0, 7.0))
    np.testing.assert_allclose(by_home(matrix), expected, rtol=0, atol=1e-14)
    np.testing.assert_array_equal(matrix.own, np.diag(by_home(matrix)))
    np.testing.assert_array_equal(matrix.diagonal, np.diag(full))
    driven, free = home == DRIVEN, home >= 0
    np.testing.assert_allclose(matrix.pull[free], full[np.ix_(free, driven)] @ ratio[driven])
    assert matrix.missing[0] == 0


def test_a_matrix_that_is_used_again_starts_at_zero():
    rng = np.random.default_rng(4)
    home = np.array([4, 0, HELD, 1, 4, INNER, DRIVEN, 2])
    matrix = shaped(np.ones((2, 2), dtype=bool), home)
    for scale in (3.0, 5.0):
        full = rng.uniform(-1, 1, (8, 8)) + 8.0 * np.eye(8)
        full += full.T
        block_matrix.clear(matrix)
        for cleared in (matrix.values, matrix.diagonal, matrix.pull, matrix.missing):
            assert not cleared.any()
        put(matrix, full)
        assert matrix.missing[0] == 1
        block_ldlt.add_diagonal(matrix, scale)
        R = reduction_to(home, 2)
        expected = R.T @ full @ R + np.diag(np.where(R.any(axis=0), 0.0, scale))
        np.testing.assert_allclose(by_home(matrix), expected, rtol=0, atol=1e-14)
        assert block_ldlt.factor(matrix, scale, block_ldlt.ROUNDED)[0] == -1


NO_ROOM = [(0, 5, True), (0, 3, False), (0, 7, True), (6, 7, False), (1, 0, False), (9, 0, False)]


@pytest.mark.parametrize(("i", "j", "missing"), NO_ROOM)
def test_an_entry_without_room_is_missed(i, j, missing):
    """Between blocks that do not couple, or with what is eliminated inside its wall."""
    joined = np.eye(3, dtype=bool)
    joined[1, 0] = joined[0, 1] = True
    home = np.array([0, 1, 2, 3, 4, 6, HELD, INNER, INNER, DRIVEN])
    matrix = shaped(joined, home)
    for a, b in ((i, j), (j, i)):
        block_matrix.clear(matrix)
        block_matrix.add(matrix, a, b, 2.0)
        assert matrix.missing[0] == missing
        assert not missing or not matrix.values.any()


def test_the_diagonal_has_room_everywhere():
    matrix = shaped(np.eye(1, dtype=bool), np.array([HELD, INNER, DRIVEN, 1]))
    for i in range(4):
        block_matrix.add(matrix, i, i, 1.0 + i)
    np.testing.assert_array_equal(matrix.diagonal, [1.0, 2.0, 3.0, 4.0])
    assert matrix.missing[0] == 0


@pytest.mark.parametrize("home", [[0, 1, 3, 4], [3, 4, 0, 1], [0, 1, 0, 1], [HELD, 0, 1, 0]])
def test_blocks_of_two_points_are_symmetric(home):
    matrix = shaped(np.ones((2, 2), dtype=bool), np.array(home))
    own, other = np.array([[2.0, 0.5], [0.5, 3.0]]), np.array([[7.0, -1.0], [4.0, 5.0]])
    block_matrix.add_block(matrix, 0, 0, *own.ravel())
    block_matrix.add_block(matrix, 2, 2, *own.ravel())
    block_matrix.add_block(matrix, 0, 2, *other.ravel())
    full = np.block([[own, other], [other.T, own]])
    R = reduction_to(home, 2)
    block_ldlt.add_diagonal(matrix, 1.0)
    expected = R.T @ full @ R + np.diag(np.where(R.any(axis=0), 0.0, 1.0))
    np.testing.assert_allclose(by_home(matrix), expected)


@pytest.mark.parametrize("scale", [1.0, 1e6, 1e-6])
@pytest.mark.parametrize("slot", range(3))
@pytest.mark.parametrize("seed", range(4))
def test_descent_along_a_negative_pivot(seed, slot, scale):
    rng = np.random.default_rng(seed)
    joined = random_pattern(rng)
    bad = 3 * int(rng.integers(0, NB)) + slot
    full = definite(rng, joined)
    full[bad, bad] -= np.abs(full[bad]).sum() + rng.uniform(0.01, 3)
    full *= scale
    matrix = made(joined, full, scale)
    failed, pivot = block_ldlt.factor(matrix, scale, block_ldlt.ROUNDED)
    minors = [np.linalg.eigvalsh(full[:k, :k])[0] for k in range(1, len(full) + 1)]
    assert failed == next(k for k, least in enumerate(minors) if least < 0) == bad
    assert pivot < 0
    matrix.vector[:] = 7.0
    block_ldlt.descend(matrix, failed)
    d = matrix.vector
    assert d @ full @ d == pytest.approx(pivot, rel=1e-9)
    assert d[failed] == 1.0
    assert not d[failed + 1 :].any()


@pytest.mark.parametrize("noise", [0.0, 1e-16])
@pytest.mark.parametrize(("loose", "bad"), [(0, 1), (0, 2), (1, 2)])
def test_descent_leaves_out_a_motion_without_stiffness(loose, bad, noise):
    """Which is in the same block as the negative pivot, and coupled to it by round-off."""
    rng = np.random.default_rng(loose + bad)
    full = definite(rng, np.ones((2, 2), dtype=bool))
    full[3 + loose] = full[:, 3 + loose] = 0.0
    full[3 + loose, 3 + loose] = noise
    full[3 + bad, 3 + loose] = full[3 + loose, 3 + bad] = 3.0 * noise
    full[3 + bad, 3 + bad] = -1.0
    matrix = made(np.ones((2, 2), dtype=bool), full, 1.0)
    failed, pivot = block_ldlt.factor(matrix, 1.0, block_ldlt.ROUNDED)
    assert failed == 3 + bad
    block_ldlt.descend(matrix, failed)
    d = matrix.vector
    assert d @ full @ d == pytest.approx(pivot, rel=1e-9)
    assert abs(d[3 + loose]) < 1e-15 / block_ldlt.SOFT


@pytest.mark.parametrize("slot", range(3))
def test_nan_fails(slot):
    matrix = shaped(np.eye(1, dtype=bool))
    for i in range(3):
        block_matrix.add(matrix, i, i, 1.0 if i != slot else np.nan)
    block_ldlt.add_diagonal(matrix, 1.0)
    failed, pivot = block_ldlt.factor(matrix, 1.0, block_ldlt.ROUNDED)
    assert failed == slot
    assert np.isnan(pivot)


@pytest.mark.parametrize("scale", [1.0, 1e6, 1e-6])
@pytest.mark.parametrize("loose", [1, 3])
def test_motions_without_stiffness_are_not_moved_along(loose, scale):
    """Semi-definite: no failure, and the exact solution wherever the load has one."""
    rng = np.random.default_rng(loose)
    half = rng.uniform(-1, 1, (12, 12 - loose))
    full = scale * half @ half.T
    matrix = made(np.ones((4, 4), dtype=bool), full, scale)
    assert block_ldlt.factor(matrix, scale, block_ldlt.ROUNDED) == (-1, 0.0)
    b = full @ rng.uniform(-1, 1, 12)
    y = solved(matrix, b)
    assert np.abs(y).max() < 1e3
    np.testing.assert_allclose(full @ y, b, rtol=0, atol=1e-7 * scale)


def test_a_coordinate_without_any_stiffness_gets_a_share_of_the_scale():
    matrix = made(np.eye(1, dtype=bool), np.diag([4.0, 0.0, 1.0]), 4.0)
    assert block_ldlt.factor(matrix, 4.0, block_ldlt.ROUNDED)[0] == -1
    np.testing.assert_allclose(solved(matrix, np.full(3, 8.0)), [2.0, 2.0 / block_ldlt.SOFT, 8.0])


@pytest.mark.parametrize("apart", [1, 3])
def test_a_small_but_true_negative_pivot_is_seen(apart):
    """In the same block, and in another one."""
    full = np.eye(6)
    full[apart, 0] = full[0, apart] = 1.0
    full[apart, apart] -= 1e-6
    matrix = made(np.ones((2, 2), dtype=bool), full, 1.0)
    failed, pivot = block_ldlt.factor(matrix, 1.0, block_ldlt.ROUNDED)
    assert failed == apart
    assert pivot == pytest.approx(-1e-6, rel=1e-6)


def test_the_full_matrix_of_the_tests_has_room_for_every_pair():
    rng = np.random.default_rng(0)
    for n in (1, 2, 7, 8):
        full, matrix = rng.uniform(-1, 1, (n, n)), full_matrix(n)
        put(matrix, full + full.T)
        np.testing.assert_array_equal(dense(matrix), full + full.T)
        assert matrix.missing[0] == 0
