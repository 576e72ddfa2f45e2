"""Matrix of blocks: assembly by home, LDL^T factor, solve, directions of negative curvature."""

import numpy as np
import pytest

from kernels.linear.condensed import block_ldlt, block_matrix
from kernels.linear.pivots import ROUNDED, SOFT
from tests.support.kernels.blocks import NB, by_entry, column, put, random_pattern, shaped
from tests.support.kernels.terms import by_home


def definite(rng, joined):
    """Random symmetric positive definite array with that pattern."""
    square = rng.uniform(-1, 1, (3 * len(joined),) * 2)
    square = np.where(by_entry(joined), square + square.T, 0.0)
    return square + np.diag(np.abs(square).sum(axis=1) + 0.1)


def made(joined, full, scale):
    """Matrix with these entries, ready to be factored. scale: of all slots."""
    matrix = shaped(joined)
    put(matrix, full, by_entry(joined))
    block_ldlt.add_diagonal(matrix, (scale,) * 3)
    return matrix


def solved(matrix, b):
    """Solution (3 nb,) by home after the factor."""
    matrix.vector[:] = b
    block_ldlt.forward(matrix)
    block_ldlt.backward(matrix, matrix.start.size - 1)
    return matrix.vector.copy()


@pytest.mark.parametrize("scale", [1.0, 1e9, 1e-9])
@pytest.mark.parametrize("seed", range(2))
def test_factor_and_solve(seed, scale):
    rng = np.random.default_rng(seed)
    joined = random_pattern(rng)
    full = scale * definite(rng, joined)
    matrix, b = made(joined, full, scale), rng.uniform(-1, 1, len(full))
    np.testing.assert_array_equal(by_home(matrix), full)
    assert block_ldlt.factor(matrix, (scale,) * 3, ROUNDED) == (-1, 0.0)
    np.testing.assert_allclose(full @ solved(matrix, b), b, rtol=0, atol=1e-12)


@pytest.mark.parametrize("scale", [1.0, 1e6, 1e-6])
@pytest.mark.parametrize("slot", range(3))
@pytest.mark.parametrize("seed", range(2))
def test_descent_along_a_negative_pivot(seed, slot, scale):
    rng = np.random.default_rng(seed)
    joined = random_pattern(rng)
    bad = 3 * int(rng.integers(0, NB)) + slot
    full = definite(rng, joined)
    full[bad, bad] -= np.abs(full[bad]).sum() + rng.uniform(0.01, 3)
    full *= scale
    matrix = made(joined, full, scale)
    failed, pivot = block_ldlt.factor(matrix, (scale,) * 3, ROUNDED)
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
    failed, pivot = block_ldlt.factor(matrix, (1.0,) * 3, ROUNDED)
    assert failed == 3 + bad
    block_ldlt.descend(matrix, failed)
    d = matrix.vector
    assert d @ full @ d == pytest.approx(pivot, rel=1e-9)
    assert abs(d[3 + loose]) < 1e-15 / SOFT


@pytest.mark.parametrize("slot", range(3))
def test_nan_fails(slot):
    matrix = shaped(np.eye(1, dtype=bool))
    for i in range(3):
        block_matrix.add(matrix, i, i, 1.0 if i != slot else np.nan)
    block_ldlt.add_diagonal(matrix, (1.0,) * 3)
    failed, pivot = block_ldlt.factor(matrix, (1.0,) * 3, ROUNDED)
    assert failed == slot
    assert np.isnan(pivot)


@pytest.mark.parametrize("angle", [0.0, 0.5])
@pytest.mark.parametrize("slender", [20.0, 200.0, 2000.0])
def test_a_slender_column_is_unstable_above_its_buckling_load(slender, angle):
    """Its pivots are far smaller than the round-off of an inverted block."""
    for compression, stable in ((0.98, True), (1.02, False)):
        full, joined = column(slender, compression, angle)
        matrix = made(joined, full, 1.0)
        failed, _ = block_ldlt.factor(matrix, (1.0,) * 3, ROUNDED)
        assert (failed < 0) == stable


def test_a_coordinate_without_any_stiffness_gets_a_share_of_the_scale():
    matrix = made(np.eye(1, dtype=bool), np.diag([4.0, 0.0, 1.0]), 4.0)
    assert block_ldlt.factor(matrix, (4.0,) * 3, ROUNDED)[0] == -1
    np.testing.assert_allclose(solved(matrix, np.full(3, 8.0)), [2.0, 2.0 / SOFT, 8.0])


@pytest.mark.parametrize("apart", [1, 3])
def test_a_small_but_true_negative_pivot_is_seen(apart):
    """The large entry beside it is in the same block, or in another one."""
    full = np.eye(6)
    full[apart, 0] = full[0, apart] = 1.0
    full[apart, apart] -= 1e-6
    matrix = made(np.ones((2, 2), dtype=bool), full, 1.0)
    failed, pivot = block_ldlt.factor(matrix, (1.0,) * 3, ROUNDED)
    assert failed == apart
    assert pivot == pytest.approx(-1e-6, rel=1e-6)
