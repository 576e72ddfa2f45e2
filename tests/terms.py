"""Derivatives of one term against differences, and its matrices, for tests of kernels.

A term is a kernel module with energy(x, *args), gradient(x, *args, g) and
hessian(x, *args, matrix, projected).
"""

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


def gradient_of(kernel, args, x: np.ndarray) -> np.ndarray:
    """Gradient (n,) of a term at ``x``."""
    g = np.zeros_like(x)
    kernel.gradient(x, *args, g)
    return g


def hessian_of(kernel, args, x: np.ndarray, projected: bool = False) -> np.ndarray:
    """Hessian (n, n) of a term at ``x``."""
    matrix = full_matrix(x.size)
    kernel.hessian(x, *args, matrix, projected)
    return dense(matrix)


def differences(function, x: np.ndarray, step: np.ndarray) -> np.ndarray:
    """Fourth-order central differences of ``function`` at ``x`` in steps of each coordinate."""
    rows = []
    for i in range(x.size):
        e = np.zeros_like(x)
        e[i] = step[i]
        close = function(x + e) - function(x - e)
        far = function(x + 2 * e) - function(x - 2 * e)
        rows.append((8 * close - far) / (12 * step[i]))
    return np.array(rows)


def derivative_error(kernel, args, x: np.ndarray, unit=1.0, step: float = 1e-3) -> float:
    """Largest error of gradient and exact Hessian against differences, relative to their size.

    unit: size of a coordinate, a number or (n,); step: of the differences, in that unit.
    """
    unit = np.broadcast_to(unit, x.shape)
    slope = gradient_of(kernel, args, x) * unit
    curvature = hessian_of(kernel, args, x) * np.outer(unit, unit)
    by_energy = differences(lambda at: kernel.energy(at, *args), x, step * unit) * unit
    by_slope = differences(lambda at: gradient_of(kernel, args, at), x, step * unit)
    by_slope = by_slope * np.outer(unit, unit)
    stiffest, steepest = np.abs(curvature).max(), np.abs(slope).max()
    in_slope = np.abs(slope - by_energy).max() / (steepest + step * stiffest or 1.0)
    in_curvature = np.abs(curvature - by_slope).max() / (stiffest or steepest or 1.0)
    return max(in_slope, in_curvature)


def least_share(kernel, args, x: np.ndarray, unit=1.0) -> float:
    """Smallest eigenvalue of the projected Hessian as a share of the largest one."""
    unit = np.broadcast_to(unit, x.shape)
    values = np.linalg.eigvalsh(hessian_of(kernel, args, x, True) * np.outer(unit, unit))
    return values[0] / np.abs(values).max()
