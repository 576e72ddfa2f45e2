"""Arithmetic of dense panels in tiles, four numbers at a time.

A *strip* is twelve rows of a panel; its columns follow one another, twelve entries each. A *tile*
is four columns of a strip: twelve registers of four numbers, which stay in the processor while all
earlier columns are subtracted. The four rows of the other factor are packed beforehand, four
entries for each column.
"""

from kernels.compile.jit import jit
from kernels.compile.simd import load, spread, store
from kernels.linear.supernodal.matrix import COLUMNS, ROWS


@jit
def pack(tiles, at, pivots, first, depth, packed):
    """Write four rows of a strip times the pivots of their columns to ``packed`` (4 depth,).

    at: first of the four rows in column 0 of the strip. pivots[first:first + depth]: of columns.
    """
    for k in range(depth):
        pivot = spread(pivots[first + k])
        store(packed, COLUMNS * k, load(tiles, at + ROWS * k) * pivot)


@jit
def subtract(tiles, at, packed, depth, target, to, step):
    """Subtract a strip times ``packed`` rows from a tile, whose columns are ``step`` apart.

    at: start of the strip in ``tiles``; its first ``depth`` columns count. to: start of the tile in
    ``target``.
    """
    a0, a1, a2 = load(target, to), load(target, to + 4), load(target, to + 8)
    b = to + step
    b0, b1, b2 = load(target, b), load(target, b + 4), load(target, b + 8)
    c = b + step
    c0, c1, c2 = load(target, c), load(target, c + 4), load(target, c + 8)
    d = c + step
    d0, d1, d2 = load(target, d), load(target, d + 4), load(target, d + 8)
    for k in range(depth):
        i, p = at + ROWS * k, COLUMNS * k
        x, y, z = load(tiles, i), load(tiles, i + 4), load(tiles, i + 8)
        w = spread(packed[p])
        a0, a1, a2 = a0 - x * w, a1 - y * w, a2 - z * w
        w = spread(packed[p + 1])
        b0, b1, b2 = b0 - x * w, b1 - y * w, b2 - z * w
        w = spread(packed[p + 2])
        c0, c1, c2 = c0 - x * w, c1 - y * w, c2 - z * w
        w = spread(packed[p + 3])
        d0, d1, d2 = d0 - x * w, d1 - y * w, d2 - z * w
    _keep(target, to, a0, a1, a2)
    _keep(target, b, b0, b1, b2)
    _keep(target, c, c0, c1, c2)
    _keep(target, d, d0, d1, d2)


@jit
def _keep(target, at, x, y, z):
    """Store a column of a tile."""
    store(target, at, x)
    store(target, at + 4, y)
    store(target, at + 8, z)


@jit
def divide(tiles, at, corner, inverse):
    """Replace a tile A of ``tiles`` by A l^-T D^-1, column by column.

    at: start of the tile. corner: start of the factored 4 x 4 block l in its strip. inverse: 1 / d,
    four numbers, zero for missing columns.
    """
    l10, l20, l30 = spread(tiles[corner + 1]), spread(tiles[corner + 2]), spread(tiles[corner + 3])
    second, third = corner + ROWS, corner + 2 * ROWS
    l21, l31, l32 = spread(tiles[second + 2]), spread(tiles[second + 3]), spread(tiles[third + 3])
    p, q, r, s = inverse
    p, q, r, s = spread(p), spread(q), spread(r), spread(s)
    for i in range(at, at + ROWS, 4):
        a = load(tiles, i)
        b = load(tiles, i + ROWS) - l10 * a
        c = load(tiles, i + 2 * ROWS) - l20 * a - l21 * b
        d = load(tiles, i + 3 * ROWS) - l30 * a - l31 * b - l32 * c
        store(tiles, i, a * p)
        store(tiles, i + ROWS, b * q)
        store(tiles, i + 2 * ROWS, c * r)
        store(tiles, i + 3 * ROWS, d * s)


@jit
def times(tiles, at, x, depth, y, to):
    """Subtract a strip times ``x`` (depth,) from twelve entries of ``y``, starting at ``to``."""
    a, b, c = load(y, to), load(y, to + 4), load(y, to + 8)
    for k in range(depth):
        i, w = at + ROWS * k, spread(x[k])
        a = a - load(tiles, i) * w
        b = b - load(tiles, i + 4) * w
        c = c - load(tiles, i + 8) * w
    _keep(y, to, a, b, c)


@jit
def transposed_times(tiles, at, x, of, depth, sums):
    """Subtract the transpose of a strip times the twelve entries of ``x`` that start at ``of`` from
    ``sums`` (4 depth,); each product is the sum of four of these numbers.
    """
    a, b, c = load(x, of), load(x, of + 4), load(x, of + 8)
    for k in range(depth):
        i, to = at + ROWS * k, COLUMNS * k
        one, two = load(tiles, i) * a, load(tiles, i + 4) * b
        store(sums, to, load(sums, to) - one - two - load(tiles, i + 8) * c)
