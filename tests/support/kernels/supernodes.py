"""Random symmetric matrices of blocks, dense and in the panels of supernodes."""

import numpy as np

from kernels.linear.pivots import ROUNDED
from kernels.linear.supernodal import factor as ldlt
from kernels.linear.supernodal.analysis import analyse
from kernels.linear.supernodal.matrix import place
from kernels.linear.supernodal.solution import solve


def random_blocks(rng, nb, share=0.1):
    """Sizes (nb,) of 1 to 6, pairs (k, 2) and points (nb, 3) of a random graph."""
    joined = np.argwhere(np.triu(rng.uniform(size=(nb, nb)) < share, 1))
    chain = np.column_stack([np.arange(nb - 1), np.arange(1, nb)])
    return rng.integers(1, 7, nb), np.vstack([joined, chain]), rng.uniform(size=(nb, 3))


def _spans(sizes):
    """Slices of the unknowns of blocks."""
    return [slice(end - size, end) for end, size in zip(np.cumsum(sizes), sizes, strict=True)]


def random_dense(rng, sizes, pairs):
    """Random symmetric array with the pattern of these blocks."""
    spans, full = _spans(sizes), np.zeros((sum(sizes),) * 2)
    for i, j in [(i, i) for i in range(len(sizes))] + [tuple(pair) for pair in pairs]:
        full[spans[i], spans[j]] = rng.uniform(-1, 1, (sizes[i], sizes[j]))
        full[spans[j], spans[i]] = full[spans[i], spans[j]].T
    for span in spans:
        full[span, span] = np.tril(full[span, span]) + np.tril(full[span, span], -1).T
    return full


def dominant(full):
    """The array with its diagonal raised until it is positive definite."""
    return full + np.diag(np.abs(full).sum(axis=1) - np.diag(full) + 0.1)


def assembled(sizes, pairs, points, full):
    """A `Matrix` with the entries of the array ``full``."""
    matrix, spans = analyse(sizes, np.ascontiguousarray(pairs), points), _spans(sizes)
    coupled = {(max(i, j), min(i, j)) for i, j in pairs} | {(i, i) for i in range(len(sizes))}
    for i, j in coupled:
        at, down, across = place(matrix, i, j)
        assert at >= 0
        for (r, c), value in np.ndenumerate(full[spans[i], spans[j]]):
            matrix.values[at + r * down + c * across] += value
    return matrix


def factored(matrix, rounded=ROUNDED, shift=0.0, weights=None, scale=1.0):
    """Result of `factor` with the same ``scale`` for all unknowns."""
    n = matrix.home.size
    weights = np.ones(n) if weights is None else weights
    return ldlt.factor(matrix, np.full(n, scale), weights, shift, rounded)


def solved(matrix, b):
    """Solution (n,) for the right side ``b`` (n,) after `factored`."""
    x = b.copy()
    solve(matrix, x)
    return x
