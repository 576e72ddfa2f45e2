"""Symmetric matrix in variable-band (skyline) rows: assembly, Cholesky factor, solve.

Row i holds columns first[i] .. i without gaps, so that the factor fills no new entry and its
inner products run over unit stride (George & Liu 1981, Computer Solution of Large Sparse Positive
Definite Systems, ch. 4). Entries are addressed by *coordinate*; ``row`` maps a coordinate to its
row, -1 where it is held. Coordinates that share a row move together (a rigid platen).
"""

from typing import NamedTuple

import numpy as np

from kernels.jit import jit, jit_exact, jit_owning

NEUTRAL = 1e-11  # a pivot below this share of its diagonal is round-off around zero


class Matrix(NamedTuple):
    """Skyline matrix of n rows.

    row (n_coordinates,): row of each coordinate or -1. first (n,): first column of each row.
    offset (n,): entry (i, j) is values[offset[i] + j]. values (nnz,). diagonal (n,): 1 / L_ii.
    """

    row: np.ndarray
    first: np.ndarray
    offset: np.ndarray
    values: np.ndarray
    diagonal: np.ndarray


@jit_owning
def shaped(row, first):
    """Return a zero matrix with the skyline ``first`` (n,)."""
    n = first.size
    offset = np.empty(n, np.int64)
    size = 0
    for i in range(n):
        offset[i] = size - first[i]
        size += i - first[i] + 1
    return Matrix(row, first, offset, np.zeros(size), np.zeros(n))


@jit
def widen(first, a, b):
    """Let ``first`` make room for entry (a, b); rows that are -1 need none."""
    if a >= 0 and b >= 0:
        if a < b:
            a, b = b, a
        first[a] = min(first[a], b)


@jit
def add(matrix, i, j, value):
    """Add a symmetric pair of entries at coordinates ``i``, ``j`` (once where i == j)."""
    a = matrix.row[i]
    b = matrix.row[j]
    if a < 0 or b < 0:
        return
    if a < b:
        a, b = b, a
    if a == b and i != j:
        value *= 2.0
    matrix.values[matrix.offset[a] + b] += value


@jit
def add_block(matrix, i, j, xx, xy, yx, yy):
    """Add the 2 x 2 block of points whose x are coordinates ``i``, ``j`` (lower half if equal)."""
    add(matrix, i, j, xx)
    add(matrix, i + 1, j, yx)
    add(matrix, i + 1, j + 1, yy)
    if i != j:
        add(matrix, i, j + 1, xy)


@jit
def _eliminate(matrix, i):
    """Turn row ``i`` into a row of the factor and return its pivot."""
    values, first, offset = matrix.values, matrix.first, matrix.offset
    oi = offset[i]
    for j in range(first[i], i):
        oj = offset[j]
        start = max(first[i], first[j])
        values[oi + j] = (values[oi + j] - _dot(values, oi, oj, start, j)) * matrix.diagonal[j]
    return values[oi + i] - _dot(values, oi, oi, first[i], i)


@jit
def _dot(values, oi, oj, start, stop):
    total = 0.0
    for k in range(start, stop):
        total += values[oi + k] * values[oj + k]
    return total


@jit_exact
def factor(matrix, n, scale):
    """Cholesky-factor the leading ``n`` rows in place: A = L L^T, ``diagonal`` = 1 / L_ii.

    Return (failed, pivot): the first row whose pivot is negative, -1 if none. A pivot that is zero
    within round-off marks a motion without stiffness: it is given the stiffness of its own diagonal
    (or ``scale`` where that is zero too), so that the solution moves little along it.
    """
    for i in range(n):
        own = matrix.values[matrix.offset[i] + i]
        pivot = _eliminate(matrix, i)
        noise = NEUTRAL * max(abs(own), 1e-3 * scale)
        if abs(pivot) <= noise:
            pivot = max(abs(own), scale)
        if not pivot > 0.0:
            return i, pivot
        root = np.sqrt(pivot)
        matrix.values[matrix.offset[i] + i] = root
        matrix.diagonal[i] = 1.0 / root
    return -1, 0.0


@jit
def _back_substitute(matrix, n, b):
    """Solve L^T y = b in place for the leading ``n`` rows."""
    for i in range(n - 1, -1, -1):
        b[i] *= matrix.diagonal[i]
        oi = matrix.offset[i]
        for k in range(matrix.first[i], i):
            b[k] -= matrix.values[oi + k] * b[i]


@jit
def solve(matrix, n, b):
    """Solve A y = b in place with the factor of the leading ``n`` rows; ``b`` (>= n,)."""
    for i in range(n):
        oi = matrix.offset[i]
        total = b[i]
        for k in range(matrix.first[i], i):
            total -= matrix.values[oi + k] * b[k]
        b[i] = total * matrix.diagonal[i]
    _back_substitute(matrix, n, b)


@jit
def descent(matrix, failed, direction):
    """Fill ``direction`` (n,) with d such that d^T A d is the negative pivot at row ``failed``.

    With A = [[A1, a], [a^T, c]] and A1 = L L^T the vector d = (-A1^{-1} a, 1, 0 ...) has
    d^T A d = c - |L^{-1} a|^2, the pivot, and L^{-1} a is what `factor` left in row ``failed``.
    """
    direction[:] = 0.0
    for k in range(matrix.first[failed], failed):
        direction[k] = -matrix.values[matrix.offset[failed] + k]
    _back_substitute(matrix, failed, direction)
    direction[failed] = 1.0
