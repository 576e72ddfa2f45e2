"""LDL^T factor by supernodes: against dense algebra, with inertia and negative curvature."""

import numpy as np
import pytest

from kernels.linear.pivots import SOFT, THROUGH
from kernels.linear.supernodal import factor as ldlt
from kernels.linear.supernodal.matrix import clear
from tests.support.kernels.blocks import column
from tests.support.kernels.supernodes import (
    assembled,
    dominant,
    factored,
    random_blocks,
    random_dense,
    solved,
)

NO_PAIRS = np.empty((0, 2), int)
SHAPES = [(1, 0.0), (2, 0.0), (5, 0.5), (25, 0.02), (40, 0.1)]


def random_case(seed, nb, share, make):
    rng = np.random.default_rng([seed, nb])
    sizes, pairs, points = random_blocks(rng, nb, share)
    full = make(random_dense(rng, sizes, pairs))
    return rng, full, assembled(sizes, pairs, points, full)


@pytest.mark.parametrize(("nb", "share"), SHAPES)
@pytest.mark.parametrize("scale", [1.0, 1e9, 1e-9])
def test_factor_and_solve(scale, nb, share):
    rng, full, matrix = random_case(0, nb, share, lambda a: scale * dominant(a))
    assert factored(matrix, scale=scale) == (-1, 0.0)
    b = rng.uniform(-1, 1, len(full))
    x = solved(matrix, b)
    np.testing.assert_allclose(full @ x, b, rtol=0, atol=1e-12)


@pytest.mark.parametrize(("nb", "share"), SHAPES)
@pytest.mark.parametrize("seed", range(2))
def test_negative_pivots_are_negative_eigenvalues(seed, nb, share):
    rng, full, matrix = random_case(seed, nb, share, lambda a: a + 0.3 * np.eye(len(a)))
    assert factored(matrix, THROUGH) == (-1, 0.0)
    assert ldlt.negatives(matrix) == (np.linalg.eigvalsh(full) < 0).sum()
    b = rng.uniform(-1, 1, len(full))
    x = solved(matrix, b)
    assert np.abs(full @ x - b).max() < 1e-6


@pytest.mark.parametrize("size", range(1, 7))
def test_nan_fails_in_every_slot(size):
    for slot in range(size):
        full = np.eye(size)
        full[slot, slot] = np.nan
        matrix = assembled(np.array([size]), NO_PAIRS, np.zeros((1, 3)), full)
        failed, pivot = factored(matrix)
        assert failed == slot
        assert np.isnan(pivot)


@pytest.mark.parametrize("scale", [1.0, 1e6, 1e-6])
@pytest.mark.parametrize("loose", [1, 3])
def test_motions_without_stiffness_are_not_moved_along(loose, scale):
    """Semi-definite: no failure, and the exact solution wherever the load has one."""
    rng = np.random.default_rng(loose)
    half = rng.uniform(-1, 1, (12, 12 - loose))
    full = scale * half @ half.T
    matrix = assembled(np.full(4, 3), np.argwhere(np.tri(4, k=-1)), np.zeros((4, 3)), full)
    assert factored(matrix, scale=scale) == (-1, 0.0)
    b = full @ rng.uniform(-1, 1, 12)
    x = solved(matrix, b)
    assert np.abs(x).max() < 1e3
    np.testing.assert_allclose(full @ x, b, rtol=0, atol=1e-7 * scale)


@pytest.mark.parametrize("seed", range(4))
def test_the_rotation_of_a_free_beam_is_no_instability(seed):
    """Its pivot is the round-off of a sum that is far larger than its diagonal."""
    rng = np.random.default_rng(seed)
    second = np.diff(np.eye(300), n=2, axis=0)
    full = second.T @ np.diag(rng.uniform(0.5, 2.0, 298)) @ second
    at = np.arange(100)
    pairs = np.column_stack([at[1:], at[:-1]])
    matrix = assembled(np.full(100, 3), pairs, np.outer(at, np.ones(3)), full)
    assert factored(matrix) == (-1, 0.0)
    assert ldlt.negatives(matrix) == 0


@pytest.mark.parametrize("angle", [0.0, 0.5])
@pytest.mark.parametrize("slender", [20.0, 200.0, 2000.0])
def test_a_slender_column_is_unstable_above_its_buckling_load(slender, angle):
    """Its pivots are far smaller than the round-off of an inverted block."""
    for compression, is_stable in ((0.98, True), (1.02, False)):
        full, joined = column(slender, compression, angle)
        nb, pairs = len(joined), np.argwhere(np.tril(joined, -1))
        matrix = assembled(np.full(nb, 3), pairs, np.zeros((nb, 3)), full)
        assert (factored(matrix)[0] < 0) == is_stable


def test_an_unknown_without_any_stiffness_gets_a_share_of_the_scale():
    full = np.diag([4.0, 0.0, 1.0])
    matrix = assembled(np.array([3]), NO_PAIRS, np.zeros((1, 3)), full)
    assert factored(matrix, scale=4.0) == (-1, 0.0)
    np.testing.assert_allclose(solved(matrix, np.full(3, 8.0)), [2.0, 2.0 / SOFT, 8.0])


@pytest.mark.parametrize("size", [2, 1])
def test_a_small_but_true_negative_pivot_is_seen(size):
    """The large entry beside it is in the same block, or in another one."""
    full = np.array([[1.0, 1.0], [1.0, 1.0 - 1e-6]])
    pairs = np.array([(0, 1)])[: 2 - size]
    sizes = np.full(2 // size, size)
    matrix = assembled(sizes, pairs, np.zeros((len(sizes), 3)), full)
    _, pivot = factored(matrix)
    assert pivot == pytest.approx(-1e-6, rel=1e-5)


def test_a_shift_is_added_to_the_diagonal_and_leaves_the_matrix():
    rng, full, matrix = random_case(5, 25, 0.1, lambda a: a)
    weights = rng.uniform(0.5, 2.0, len(full))
    kept, shift = matrix.values.copy(), 2.0 * np.abs(full).sum(axis=1).max()
    assert factored(matrix)[0] >= 0
    assert factored(matrix, shift=shift, weights=weights) == (-1, 0.0)
    np.testing.assert_array_equal(matrix.values, kept)
    b = rng.uniform(-1, 1, len(full))
    x = solved(matrix, b)
    np.testing.assert_allclose(full @ x + shift * weights * x, b, rtol=0, atol=1e-12)


def test_the_stiffest_unknown_of_a_mask():
    rng, full, matrix = random_case(5, 25, 0.1, dominant)
    mask = rng.uniform(size=len(full)) < 0.5
    factored(matrix, shift=2.0)
    assert ldlt.stiffest(matrix, mask) == np.diag(full)[mask].max() + 2.0
    assert ldlt.stiffest(matrix, np.zeros(len(full), bool)) == 0.0


def test_the_factor_forgets_what_was_there_before():
    _, _, matrix = random_case(1, 40, 0.1, dominant)
    factored(matrix)
    first, kept = matrix.tiles.copy(), matrix.values.copy()
    matrix.values[:] = 3.0 * kept
    factored(matrix)
    matrix.values[:] = kept
    factored(matrix)
    np.testing.assert_array_equal(matrix.tiles, first)
    clear(matrix)
    assert not matrix.values.any()
