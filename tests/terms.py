"""Small scenes for tests of kernels: a few walls with every kind of joint, in any state."""

import numpy as np

from kernels import sparse
from kernels.sparse import Matrix


def full_matrix(n: int) -> Matrix:
    """Matrix with room for every pair of ``n`` coordinates, each its own row."""
    return sparse.shaped(np.arange(n), np.zeros(n, np.int64))


def dense(matrix: Matrix) -> np.ndarray:
    """Symmetric (n, n) array of a skyline matrix."""
    n = matrix.first.size
    full = np.zeros((n, n))
    for i in range(n):
        columns = np.arange(matrix.first[i], i + 1)
        full[i, columns] = matrix.values[matrix.offset[i] + columns]
    return full + np.tril(full, -1).T


def numeric_gradient(energy, x: np.ndarray, step: float) -> np.ndarray:
    """Fourth-order central differences of ``energy`` at ``x``."""
    slope = np.zeros_like(x)
    for i in range(x.size):
        e = np.zeros_like(x)
        e[i] = step
        near, far = energy(x + e) - energy(x - e), energy(x + 2 * e) - energy(x - 2 * e)
        slope[i] = (8 * near - far) / (12 * step)
    return slope


def numeric_hessian(gradient, x: np.ndarray, step: float) -> np.ndarray:
    """Fourth-order central differences of ``gradient`` at ``x``."""
    rows = []
    for i in range(x.size):
        e = np.zeros_like(x)
        e[i] = step
        near = gradient(x + e) - gradient(x - e)
        far = gradient(x + 2 * e) - gradient(x - 2 * e)
        rows.append((8 * near - far) / (12 * step))
    return np.array(rows)


def assert_derivatives(energy, gradient, hessian, x: np.ndarray, step: float = 1e-4) -> None:
    """Check gradient and Hessian against differences, to 1e-7 of their largest entry.

    energy(x) -> float; gradient(x, g) and hessian(x, matrix) add to zeroed arrays.
    """

    def filled(at: np.ndarray) -> np.ndarray:
        g = np.zeros_like(at)
        gradient(at, g)
        return g

    matrix = full_matrix(x.size)
    hessian(x, matrix)
    exact, slope = dense(matrix), filled(x)
    scale = np.abs(exact).max() + np.abs(slope).max() + 1e-300
    np.testing.assert_allclose(slope, numeric_gradient(energy, x, step), rtol=0, atol=1e-7 * scale)
    np.testing.assert_allclose(exact, numeric_hessian(filled, x, step), rtol=0, atol=1e-7 * scale)
