"""Symmetric matrix of blocks in the panels of supernodes.

A *block* holds the 1 to 6 unknowns of one point. The caller numbers blocks and unknowns; *places*
number both in the order of elimination. Supernode s has w columns and r rows below them. Its panel
in `values` holds the lower half of its columns, w + r rows each, one column after the other;
entries above the diagonal are not read. Every entry of the factor has room in a panel, even if
`analyse` was not given its pair of blocks.
"""

from typing import NamedTuple

import numpy as np

from kernels.arrays import first_at_least, piece, zero
from kernels.compile.jit import jit, jit_exact

ROWS = 12  # of a tile: see `dense`
COLUMNS = 4


class Matrix(NamedTuple):
    """Matrix of nb blocks, n unknowns and ns supernodes, children before their parents.

    By block or unknown of the caller: first (nb + 1,): first unknown of each block. place (nb,): of
    each block. home (n,): place of each unknown. By place: begin (nb + 1,): place of the first
    unknown of each block. supernode (nb,): of each block. unknown (n,): inverse of home.

    By supernode: block, column (ns + 1,): place of its first block and unknown. below (ns + 1,):
    its rows of blocks are below[s]:below[s + 1] of `rows`, their places, and of `offset`, the row
    of their first unknown below the columns. lower (ns + 1,): its rows are lower[s]:lower[s + 1]
    of `row`, their places, of `up`, their rows in the front of the parent, and of `beside`, where
    those start in its tiles (see `fronts`). run_start (ns + 1,), run: neighbours in a strip of the
    parent are the rows from run[run_start[s]] on, from run[run_start[s] + 1] on, and so on.
    child_start (ns + 2,), child: see `symbolic.children`. panel, tile (ns + 1,), update (ns,):
    where its panel in `values`, its tiles in `tiles` and its update in `updates` start.

    values: entries. tiles: factor. updates: passed on to parents. own, pivots, inverse (n,):
    diagonal before the factor, pivots and their inverses. vector (n,), front, sums, pack: scratch.
    missing (1,): set to 1 when an entry has no room. failed (1,): place of the first negative
    pivot, -1 if none.
    """

    first: np.ndarray
    place: np.ndarray
    home: np.ndarray
    begin: np.ndarray
    supernode: np.ndarray
    unknown: np.ndarray
    block: np.ndarray
    column: np.ndarray
    below: np.ndarray
    rows: np.ndarray
    offset: np.ndarray
    lower: np.ndarray
    row: np.ndarray
    up: np.ndarray
    beside: np.ndarray
    run_start: np.ndarray
    run: np.ndarray
    child_start: np.ndarray
    child: np.ndarray
    panel: np.ndarray
    tile: np.ndarray
    update: np.ndarray
    values: np.ndarray
    tiles: np.ndarray
    updates: np.ndarray
    own: np.ndarray
    pivots: np.ndarray
    inverse: np.ndarray
    vector: np.ndarray
    front: np.ndarray
    sums: np.ndarray
    pack: np.ndarray
    missing: np.ndarray
    failed: np.ndarray


@jit_exact
def rounded_up(number, step):
    """Return the least multiple of ``step`` that is at least ``number``."""
    return (number + step - 1) // step * step


@jit_exact
def size(matrix, s):
    """Return the number of columns of supernode ``s`` and the number of rows below them."""
    return matrix.column[s + 1] - matrix.column[s], matrix.lower[s + 1] - matrix.lower[s]


@jit
def clear(matrix):
    """Set all entries to zero."""
    zero(matrix.values)
    matrix.missing[0] = 0


@jit_exact
def _row(matrix, s, p):
    """Return the row of the first unknown of the block at place ``p`` in the panel of supernode
    ``s``, -1 if it has none.
    """
    if p < matrix.block[s + 1]:
        return matrix.begin[p] - matrix.column[s]
    end = matrix.below[s + 1]
    k = first_at_least(matrix.rows, p, matrix.below[s], end)
    if k == end or matrix.rows[k] != p:
        return -1
    return matrix.column[s + 1] - matrix.column[s] + matrix.offset[k]


@jit_exact
def place(matrix, i, j):
    """Return (at, down, across): entry (r, c) of block (i, j) is at + r down + c across in
    ``values``; at = -1 if it has no room.

    Block (j, i) is the same memory. If i == j, the entries above the diagonal are not read.
    """
    p, q = matrix.place[i], matrix.place[j]
    s = matrix.supernode[min(p, q)]
    row, (width, below) = _row(matrix, s, max(p, q)), size(matrix, s)
    if row < 0:
        return -1, 0, 0
    step = width + below
    at = matrix.panel[s] + (matrix.begin[min(p, q)] - matrix.column[s]) * step + row
    return (at, step, 1) if p < q else (at, 1, step)


@jit_exact
def position(matrix, i, j):
    """Return the position in ``values`` of the entry of unknowns (i, j), -1 if it has no room."""
    p, q = matrix.home[i], matrix.home[j]
    p, q = max(p, q), min(p, q)
    a, b = piece(matrix.begin, p), piece(matrix.begin, q)
    s = matrix.supernode[b]
    row, (width, below) = _row(matrix, s, a), size(matrix, s)
    if row < 0:
        return -1
    return matrix.panel[s] + (q - matrix.column[s]) * (width + below) + row + p - matrix.begin[a]


@jit
def add_entry(matrix, i, j, value):
    """Add ``value`` to the entries of unknowns (i, j) and (j, i), once if i == j."""
    at = position(matrix, i, j)
    if at < 0:
        matrix.missing[0] = 1
    else:
        matrix.values[at] += value
