"""Random symmetric matrices of blocks, dense and in the panels of supernodes."""

import numpy as np

from kernels.linear.pivots import ROUNDED
from kernels.linear.supernodal import factor as ldlt
from kernels.linear.supernodal.analysis import analyse
from kernels.linear.supernodal.matrix import place, rounded_up


def random_blocks(rng, nb, share=0.1):
    """Sizes (nb,) of 1 to 6, pairs (k, 2) and points (nb, 3) of a random graph."""
    joined = np.argwhere(np.triu(rng.uniform(size=(nb, nb)) < share, 1))
    chain = np.column_stack([np.arange(nb - 1), np.arange(1, nb)])
    return rng.integers(1, 7, nb), np.vstack([joined, chain]), rng.uniform(size=(nb, 3))


def random_dense(rng, sizes, pairs):
    """Random symmetric array with the pattern of these blocks, and the blocks' slices."""
    ends = np.cumsum(sizes)
    spans = [slice(end - size, end) for end, size in zip(ends, sizes, strict=True)]
    full = np.zeros((ends[-1], ends[-1]))
    for i, j in [(i, i) for i in range(len(sizes))] + [tuple(pair) for pair in pairs]:
        full[spans[i], spans[j]] = rng.uniform(-1, 1, (sizes[i], sizes[j]))
        full[spans[j], spans[i]] = full[spans[i], spans[j]].T
    for span in spans:
        full[span, span] = np.tril(full[span, span]) + np.tril(full[span, span], -1).T
    return full, spans


def dominant(full):
    """The array with its diagonal raised until it is positive definite."""
    return full + np.diag(np.abs(full).sum(axis=1) - np.diag(full) + 0.1)


def add(matrix, i, j, block):
    """Add ``block``, rows by unknown of block i, columns by unknown of block j, to block (i, j)."""
    at, down, across = place(matrix, i, j)
    assert at >= 0
    for (r, c), value in np.ndenumerate(block):
        matrix.values[at + r * down + c * across] += value


def assembled(sizes, pairs, points, full, spans):
    """A `Matrix` with the entries of the array ``full``."""
    matrix = analyse(sizes, np.ascontiguousarray(pairs), points)
    for i in range(len(sizes)):
        add(matrix, i, i, full[spans[i], spans[i]])
    for i, j in {(max(i, j), min(i, j)) for i, j in pairs if i != j}:
        add(matrix, i, j, full[spans[i], spans[j]])
    return matrix


def factored(matrix, rounded=ROUNDED, shift=0.0, weights=None, scale=1.0):
    """Result of `factor` with the same ``scale`` for all unknowns."""
    n = matrix.home.size
    weights = np.ones(n) if weights is None else weights
    return ldlt.factor(matrix, np.full(n, scale), weights, shift, rounded)


def lower(matrix):
    """The factor L (n, n), by place."""
    n = matrix.home.size
    full = np.eye(n)
    for s in range(matrix.column.size - 1):
        first, last = matrix.column[s], matrix.column[s + 1]
        rows = matrix.row[matrix.lower[s] : matrix.lower[s + 1]]
        wide = rounded_up(last - first, 4)
        tiles = matrix.tiles[matrix.tile[s] : matrix.tile[s + 1]].reshape(-1, wide, 12)
        panel = tiles.transpose(0, 2, 1).reshape(-1, wide)[:, : last - first]
        full[first:last, first:last] += np.tril(panel[: last - first], -1)
        full[rows, first:last] = panel[rounded_up(last - first, 12) :][: len(rows)]
    return full
