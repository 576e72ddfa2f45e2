"""Arithmetic of tiles against whole arrays."""

import numpy as np
import pytest

from kernels.linear.supernodal import dense


def strip_of(array):
    """A strip (12, depth) in its storage order: column by column."""
    return np.ascontiguousarray(array.T).ravel()


@pytest.mark.parametrize("depth", [0, 1, 7, 40])
def test_subtract(depth):
    rng = np.random.default_rng(depth)
    rows, others, pivots = rng.normal(size=(12, depth)), rng.normal(size=(12, depth)), np.ones(50)
    pivots[3:] = rng.normal(size=47)
    packed, step, target = np.zeros(4 * max(depth, 1)), 20, rng.normal(size=100)
    before = target.copy()
    dense.pack(np.append(strip_of(others), np.zeros(12)), 8, pivots, 3, depth, packed)
    dense.subtract(strip_of(rows), 0, packed, depth, target, 5, step)
    product = rows @ np.diag(pivots[3 : 3 + depth]) @ others[8:12].T
    for c in range(4):
        before[5 + c * step : 17 + c * step] -= product[:, c]
    np.testing.assert_allclose(target, before, rtol=0, atol=1e-13)


def test_divide():
    rng = np.random.default_rng(0)
    triangle, pivots = np.tril(rng.normal(size=(4, 4)), -1) + np.eye(4), rng.uniform(1, 2, 4)
    corner = np.full((12, 4), np.nan)
    corner[4:8] = np.where(np.tri(4, k=-1), triangle, np.nan)
    rows = rng.normal(size=(12, 4))
    tiles = np.append(strip_of(corner), strip_of(rows))
    dense.divide(tiles, 48, 4, tuple(1.0 / pivots))
    expected = rows @ np.linalg.inv(triangle).T @ np.diag(1.0 / pivots)
    np.testing.assert_allclose(tiles[48:].reshape(4, 12).T, expected, rtol=0, atol=1e-13)


@pytest.mark.parametrize("depth", [0, 1, 30])
def test_products_with_vectors(depth):
    rng = np.random.default_rng(depth)
    rows, x, y = rng.normal(size=(12, depth)), rng.normal(size=depth + 1), rng.normal(size=14)
    found, sums = y.copy(), np.zeros(4 * max(depth, 1))
    dense.times(strip_of(rows), 0, x, depth, found, 2)
    np.testing.assert_allclose(found[2:], y[2:] - rows @ x[:depth], rtol=0, atol=1e-13)
    np.testing.assert_array_equal(found[:2], y[:2])
    dense.transposed_times(strip_of(rows), 0, y, 2, depth, sums)
    total = sums.reshape(-1, 4).sum(axis=1)[:depth]
    np.testing.assert_allclose(total, -(rows.T @ y[2:]), rtol=0, atol=1e-13)
