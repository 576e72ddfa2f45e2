"""Solves with the factor, and directions of negative curvature."""

from kernels.arrays import piece, zero
from kernels.compile.jit import jit, jit_exact
from kernels.linear.supernodal.dense import times, transposed_times
from kernels.linear.supernodal.fronts import strip
from kernels.linear.supernodal.matrix import COLUMNS, ROWS, rounded_up, size


@jit
def _forward_columns(matrix, s):
    """Solve with the triangle of supernode ``s``, in the first entries of ``front``."""
    (w, _), x, tiles = size(matrix, s), matrix.front, matrix.tiles
    for i in range(0, w, ROWS):
        at = strip(matrix, s, i)
        times(tiles, at, x, i, x, i)
        for k in range(i, min(i + ROWS, w)):
            for row in range(k + 1, i + ROWS):
                x[row] -= tiles[at + ROWS * k + row - i] * x[k]


@jit
def _forward(matrix, s):
    """Solve L y = vector for the columns of supernode ``s``, and subtract them below."""
    (w, r), x, first = size(matrix, s), matrix.front, matrix.column[s]
    below = rounded_up(w, ROWS)
    for i in range(w):
        x[i] = matrix.vector[first + i]
    for i in range(w, below + rounded_up(r, ROWS)):
        x[i] = 0.0
    _forward_columns(matrix, s)
    for i in range(w):
        matrix.vector[first + i] = x[i]
    for i in range(below, below + r, ROWS):
        times(matrix.tiles, strip(matrix, s, i), x, w, x, i)
    for i in range(r):
        matrix.vector[matrix.row[matrix.lower[s] + i]] += x[below + i]


@jit
def _gather_below(matrix, s):
    """Copy the entries of ``vector`` below supernode ``s`` to ``front``; return whether any of them
    differs from zero.
    """
    (w, r), x, has_any = size(matrix, s), matrix.front, False
    below = rounded_up(w, ROWS)
    for i in range(r):
        x[below + i] = matrix.vector[matrix.row[matrix.lower[s] + i]]
        has_any = has_any or x[below + i] != 0.0
    for i in range(r, rounded_up(r, ROWS)):
        x[below + i] = 0.0
    return has_any


@jit
def _clear_sums(matrix, s):
    w, _ = size(matrix, s)
    for i in range(COLUMNS * w):
        matrix.sums[i] = 0.0


@jit
def _backward_columns(matrix, s, last):
    """Solve L^T y = vector for the first ``last`` columns of supernode ``s``, the rest of which are
    zero or below; ``sums``: contribution of the rows below.
    """
    x, sums, tiles, first = matrix.front, matrix.sums, matrix.tiles, matrix.column[s]
    for i in range((last - 1) // ROWS * ROWS, -1, -ROWS):
        at, count = strip(matrix, s, i), min(ROWS, last - i)
        for k in range(count - 1, -1, -1):
            to = COLUMNS * (i + k)
            value = matrix.vector[first + i + k]
            value += (sums[to] + sums[to + 1]) + (sums[to + 2] + sums[to + 3])
            for row in range(k + 1, count):
                value -= tiles[at + ROWS * (i + k) + row] * x[i + row]
            x[i + k] = matrix.vector[first + i + k] = value
        for k in range(count, ROWS):
            x[i + k] = 0.0
        transposed_times(tiles, at, x, i, i, sums)


@jit
def _backward(matrix, s):
    """Solve L^T y = vector for the columns of supernode ``s``, given the solution below them."""
    w, r = size(matrix, s)
    below, has_any = rounded_up(w, ROWS), _gather_below(matrix, s)
    _clear_sums(matrix, s)
    if has_any:
        for i in range(below, below + r, ROWS):
            transposed_times(matrix.tiles, strip(matrix, s, i), matrix.front, i, w, matrix.sums)
    _backward_columns(matrix, s, w)


@jit
def solve(matrix, b):
    """Solve in place for the right side ``b`` (n,), by unknown."""
    ns, vector = matrix.column.size - 1, matrix.vector
    for i in range(b.size):
        vector[matrix.home[i]] = b[i]
    for s in range(ns):
        _forward(matrix, s)
    for i in range(b.size):
        vector[i] *= matrix.inverse[i]
    for s in range(ns - 1, -1, -1):
        _backward(matrix, s)
    for i in range(b.size):
        b[i] = vector[matrix.home[i]]


@jit_exact
def descend_to(matrix, supernode, failed):
    """Fill ``vector`` with d such that d^T A d is the pivot at place ``failed`` of a ``supernode``.

    With A = [[A1, a], [a^T, c]] the vector (-A1^{-1} a, 1, 0 ...) has d^T A d = c - a^T A1^{-1} a.
    """
    zero(matrix.vector)
    matrix.vector[failed] = 1.0
    row = failed - matrix.column[supernode]
    at = strip(matrix, supernode, row) + row % ROWS
    for k in range(row):
        matrix.vector[matrix.column[supernode] + k] = -matrix.tiles[at + ROWS * k]
    _clear_sums(matrix, supernode)
    if row > 0:
        _backward_columns(matrix, supernode, row)
    for s in range(supernode - 1, -1, -1):
        _backward(matrix, s)


@jit_exact
def descend(matrix, direction):
    """Fill ``direction`` (n,), by unknown, with d such that d^T A d is the negative pivot
    that `factor` returned.
    """
    failed = matrix.failed[0]
    descend_to(matrix, piece(matrix.column, failed), failed)
    for i in range(direction.size):
        direction[i] = matrix.vector[matrix.home[i]]
