"""Skyline matrix: assembly by coordinate, Cholesky factor, solve, directions of descent."""

import numpy as np
import pytest

from kernels import sparse
from tests.terms import dense, full_matrix


def random_skyline(rng, n):
    """First column of each row: short and long rows mixed."""
    return np.array([rng.integers(max(0, i - rng.integers(1, 9)), i + 1) for i in range(n)])


def filled(first, full):
    """Matrix with the skyline ``first`` and the entries of ``full`` that lie in it."""
    matrix = sparse.shaped(np.arange(first.size), first)
    for i in range(first.size):
        for j in range(first[i], i + 1):
            sparse.add(matrix, i, j, full[i, j])
    return matrix


def masked(first, full):
    keep = np.array(
        [[first[max(i, j)] <= min(i, j) for j in range(len(full))] for i in range(len(full))]
    )
    return np.where(keep, full, 0.0)


def definite(rng, first):
    """Random symmetric positive definite (n, n) array with that skyline."""
    n = first.size
    square = rng.uniform(-1, 1, (n, n))
    square = masked(first, square + square.T)
    return square + np.diag(np.abs(square).sum(axis=1) + 0.1)


@pytest.mark.parametrize("scale", [1.0, 1e9, 1e-9])
@pytest.mark.parametrize("seed", range(5))
def test_factor_and_solve(seed, scale):
    rng = np.random.default_rng(seed)
    first = random_skyline(rng, 40)
    full = scale * definite(rng, first)
    matrix, b = filled(first, full), rng.uniform(-1, 1, 40)
    np.testing.assert_array_equal(dense(matrix), full)
    assert sparse.factor(matrix, 40, scale) == (-1, 0.0)
    lower = np.tril(dense(matrix))
    np.testing.assert_allclose(lower @ lower.T, full, rtol=0, atol=1e-13 * np.abs(full).max())
    y = b.copy()
    sparse.solve(matrix, 40, y)
    np.testing.assert_allclose(full @ y, b, atol=1e-12)


def test_factor_of_leading_rows_leaves_the_last_row_alone():
    rng = np.random.default_rng(1)
    first = random_skyline(rng, 12)
    first[-1] = 3
    full = definite(rng, first)
    matrix, b = filled(first, full), rng.uniform(-1, 1, 12)
    assert sparse.factor(matrix, 11, 1.0)[0] == -1
    np.testing.assert_array_equal(dense(matrix)[-1], full[-1])
    y = b.copy()
    sparse.solve(matrix, 11, y)
    np.testing.assert_allclose(y[:11], np.linalg.solve(full[:11, :11], b[:11]), rtol=1e-10)
    assert y[11] == b[11]


def test_ties_and_supports_reduce_the_matrix():
    """Coordinates that share a row move together; held ones (-1) drop out: R^T A R."""
    rng = np.random.default_rng(2)
    full = rng.uniform(-1, 1, (8, 8))
    full += full.T
    row = np.array([0, 3, -1, 1, 3, 2, -1, 3])
    matrix = sparse.shaped(row, np.zeros(4, np.int64))
    for i in range(8):
        for j in range(i + 1):
            sparse.add(matrix, i, j, full[i, j])
    reduction = (row[:, None] == np.arange(4)).astype(float)
    np.testing.assert_allclose(dense(matrix), reduction.T @ full @ reduction, rtol=1e-13)


@pytest.mark.parametrize("row", [[0, 1, 2, 3], [0, 1, 0, 1], [-1, 0, 1, 0], [1, -1, -1, 0]])
def test_blocks_of_two_points_are_symmetric(row):
    matrix = sparse.shaped(np.array(row), np.zeros(max(row) + 1, np.int64))
    own, other = np.array([[2.0, 0.5], [0.5, 3.0]]), np.array([[7.0, -1.0], [4.0, 5.0]])
    sparse.add_block(matrix, 0, 0, *own.ravel())
    sparse.add_block(matrix, 2, 2, *own.ravel())
    sparse.add_block(matrix, 0, 2, *other.ravel())
    full = np.block([[own, other], [other.T, own]])
    reduction = (np.array(row)[:, None] == np.arange(max(row) + 1)).astype(float)
    np.testing.assert_allclose(dense(matrix), reduction.T @ full @ reduction)


def test_widen_makes_room_and_ignores_held_rows():
    first = np.arange(6)
    for a, b in ((5, 2), (1, 4), (3, -1), (-1, 0), (5, 3), (2, 2)):
        sparse.widen(first, a, b)
    np.testing.assert_array_equal(first, [0, 1, 2, 3, 1, 2])


@pytest.mark.parametrize("scale", [1.0, 1e6, 1e-6])
@pytest.mark.parametrize("seed", range(8))
def test_descent_along_a_negative_pivot(seed, scale):
    rng = np.random.default_rng(seed)
    first = random_skyline(rng, 30)
    bad = int(rng.integers(0, 30))
    full = definite(rng, first)
    full[bad, bad] -= np.abs(full[bad]).sum() + rng.uniform(0.01, 3)
    full *= scale
    matrix = filled(first, full)
    failed, pivot = sparse.factor(matrix, 30, scale)
    minors = [np.linalg.eigvalsh(full[:k, :k])[0] for k in range(1, 31)]
    assert failed == next(k for k, least in enumerate(minors) if least < 0) == bad
    assert pivot < 0
    d = np.full(30, 7.0)
    sparse.descent(matrix, failed, d)
    assert d @ full @ d == pytest.approx(pivot, rel=1e-9)
    assert d[failed] == 1.0
    assert not d[failed + 1 :].any()


def test_nan_fails():
    matrix = full_matrix(2)
    sparse.add(matrix, 0, 0, np.nan)
    assert sparse.factor(matrix, 2, 1.0)[0] == 0


@pytest.mark.parametrize("scale", [1.0, 1e6, 1e-6])
@pytest.mark.parametrize("loose", [1, 3])
def test_motions_without_stiffness_are_not_moved_along(loose, scale):
    """Semi-definite: no failure, and the exact solution wherever the load has one."""
    rng = np.random.default_rng(loose)
    half = rng.uniform(-1, 1, (12, 12 - loose))
    full = scale * half @ half.T
    matrix = filled(np.zeros(12, np.int64), full)
    assert sparse.factor(matrix, 12, scale) == (-1, 0.0)
    b = full @ rng.uniform(-1, 1, 12)
    y = b.copy()
    sparse.solve(matrix, 12, y)
    assert np.abs(y).max() < 1e3
    np.testing.assert_allclose(full @ y, b, atol=1e-7 * scale)


def test_a_coordinate_without_any_stiffness_gets_that_of_the_scale():
    matrix = full_matrix(3)
    sparse.add(matrix, 0, 0, 4.0)
    sparse.add(matrix, 2, 2, 1.0)
    assert sparse.factor(matrix, 3, 4.0)[0] == -1
    y = np.array([8.0, 8.0, 8.0])
    sparse.solve(matrix, 3, y)
    np.testing.assert_allclose(y, [2.0, 2.0, 8.0])


def test_a_small_but_true_negative_pivot_is_seen():
    matrix = full_matrix(2)
    sparse.add(matrix, 0, 0, 1.0)
    sparse.add(matrix, 1, 1, 1.0 - 1e-9)
    sparse.add(matrix, 1, 0, 1.0)
    failed, pivot = sparse.factor(matrix, 2, 1.0)
    assert failed == 1
    assert pivot == pytest.approx(-1e-9, rel=1e-6)
