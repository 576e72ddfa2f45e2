"""Symmetric matrix of 3 x 3 blocks with a static pattern.

A block holds the unknowns of one point: x, y and the rotation of a joint. Blocks are numbered in
the order of elimination. The lower half is stored in `values`: all diagonal blocks, then the blocks
below them, column by column. A block is three columns of four entries, the fourth of which is zero.

The *home* of a coordinate is 3 x block + slot, or one of the codes below.
"""

from typing import NamedTuple

import numpy as np

from kernels.arrays import first_at_least, zero
from kernels.compile.jit import jit, jit_exact, jit_owning
from kernels.compile.simd import LANES

HELD, INNER, DRIVEN = -1, -2, -3  # fixed; eliminated inside its wall; prescribed
IMAGE = -4  # row 0 of `periodic_images`; -5 is row 1, and so on
STRIDE = LANES  # between columns of a block
SIZE = 3 * STRIDE


class Blocks(NamedTuple):
    """Matrix of nb diagonal blocks and nl blocks below them.

    home (n,): of each coordinate. whole (n,): block whose first two slots are a coordinate and the
    next one, else -1. start (nb + 1,), row (nl,): rows of the blocks below each diagonal block.
    update (nu,): targets of updates in the order of `block_ldlt.factor`. values (12 (nb + nl),):
    entries. own (3 nb,): diagonal before the factor. diagonal, pull (n,): by coordinate, diagonal
    entries and couplings with the driven coordinate. ratio (n,), images (k, 4): as in
    `analysis.Layout`. vector (3 nb,), column (12 x longest column,): scratch. missing (1,): set to
    1 when an entry has no room.
    """

    home: np.ndarray
    whole: np.ndarray
    start: np.ndarray
    row: np.ndarray
    update: np.ndarray
    values: np.ndarray
    own: np.ndarray
    diagonal: np.ndarray
    pull: np.ndarray
    ratio: np.ndarray
    images: np.ndarray
    vector: np.ndarray
    column: np.ndarray
    missing: np.ndarray


@jit_exact
def home_of(block, slot):
    """Return the home of a ``slot`` of a ``block``."""
    return 3 * block + slot


@jit_exact
def find(start, row, i, j):
    """Return the index in ``row`` of block (i, j), i > j; -1 if there is none."""
    end = start[j + 1]
    k = first_at_least(row, i, start[j], end)
    return k if k < end and row[k] == i else -1


@jit_owning
def updates(start, row):
    """Return the targets of all updates, column by column, as positions in `values`."""
    nb = start.size - 1
    count = 0
    for j in range(nb):
        height = start[j + 1] - start[j]
        count += height * (height + 1) // 2
    update, count = np.empty(count, np.int64), 0
    for j in range(nb):
        for b in range(start[j], start[j + 1]):
            update[count] = SIZE * row[b]
            count += 1
            q = start[row[b]]  # the column of b has all rows that follow b in column j
            for a in range(b + 1, start[j + 1]):
                while row[q] < row[a]:
                    q += 1
                update[count] = SIZE * (nb + q)
                count += 1
    return update


@jit_owning
def _whole(home):
    """Return `Blocks.whole`."""
    whole = np.full(home.size, -1)
    for i in range(home.size - 1):
        if home[i] >= 0 and home[i] % 3 == 0 and home[i + 1] == home[i] + 1:
            whole[i] = home[i] // 3
    return whole


@jit_owning
def zero_matrix(home, start, row, ratio, images):
    """Return a zero matrix of this pattern."""
    nb, n = start.size - 1, home.size
    longest = 0
    for j in range(nb):
        longest = max(longest, start[j + 1] - start[j])
    return Blocks(
        home, _whole(home), start, row, updates(start, row),
        np.zeros(SIZE * (nb + row.size)), np.zeros(3 * nb), np.zeros(n), np.zeros(n),
        ratio, images, np.zeros(3 * nb), np.zeros(SIZE * longest), np.zeros(1, np.int64),
    )  # fmt: skip


@jit_exact
def clear(blocks):
    """Set all entries to zero."""
    zero(blocks.values)
    zero(blocks.diagonal)
    zero(blocks.pull)
    blocks.missing[0] = 0


@jit_exact
def position(home, start, row, i, j):
    """Return the position in `values` of the entry of coordinates (i, j); -1 if it has no room."""
    p, q = home[i] // 3, home[j] // 3
    r, s = home[i] - 3 * p, home[j] - 3 * q
    if p == q:
        return SIZE * p + STRIDE * min(r, s) + max(r, s)
    if p < q:
        p, q, r, s = q, p, s, r
    slot = find(start, row, p, q)
    return SIZE * (start.size - 1 + slot) + STRIDE * s + r if slot >= 0 else -1


@jit
def add(blocks, i, j, value):
    """Add ``value`` to entries (i, j) and (j, i), once if i == j; neither is an image."""
    if i == j:
        blocks.diagonal[i] += value
        return
    a, b = blocks.home[i], blocks.home[j]
    if a == HELD or b == HELD or (a == DRIVEN and b == DRIVEN):
        return
    if a == DRIVEN:
        blocks.pull[j] += blocks.ratio[i] * value
    elif b == DRIVEN:
        blocks.pull[i] += blocks.ratio[j] * value
    elif a == INNER or b == INNER:
        blocks.missing[0] = 1
    else:
        at = position(blocks.home, blocks.start, blocks.row, i, j)
        if at < 0:
            blocks.missing[0] = 1
        else:
            blocks.values[at] += 2.0 * value if a == b else value


@jit_exact
def _leader(blocks, c, which):
    """Return the first or second (``which`` 0, 1) coordinate that ``c`` follows, and its factor."""
    home = blocks.home[c]
    if home > IMAGE:
        return c, 1 - which
    image = blocks.images[IMAGE - home]
    return (image[2], image[3]) if which == 1 else (max(image[1], 0), 1 if image[1] >= 0 else 0)


@jit_exact
def add_image(blocks, i, j, value, pulls):
    """Add ``value`` to entries (i, j) and (j, i) of images: to the coordinates that they follow.

    pulls: couplings with the driven coordinate are added too.
    """
    share = 0.5 if i == j else 1.0
    for k in range(4):
        p, one = _leader(blocks, i, k // 2)
        q, two = _leader(blocks, j, k % 2)
        entry = share * one * two * value
        if entry != 0.0:
            if p == q:
                blocks.diagonal[p] += 2.0 * entry
            elif pulls or (blocks.home[p] != DRIVEN and blocks.home[q] != DRIVEN):
                add(blocks, p, q, entry)


@jit_exact
def _add_images(blocks, i, j, block):
    """Add a 2 x 2 block of two points, at least one of which is an image."""
    for k in range(4):
        if k != 1 or i != j:
            add_image(blocks, i + k // 2, j + k % 2, block[k], True)


@jit
def add_block(blocks, i, j, xx, xy, yx, yy):
    """Add the 2 x 2 block of two points with x coordinates ``i``, ``j`` (lower half if equal)."""
    p, q, at = blocks.whole[i], blocks.whole[j], -1
    if p < 0 or q < 0 or (p == q and i != j):
        _add_entries(blocks, i, j, xx, xy, yx, yy)
        return
    if p == q:
        at, xy = SIZE * p, 0.0
    else:
        at = find(blocks.start, blocks.row, max(p, q), min(p, q))
        if at < 0:
            blocks.missing[0] = 1
            return
        at = SIZE * (blocks.start.size - 1 + at)
    if p < q:
        xy, yx = yx, xy
    values = blocks.values
    values[at] += xx
    values[at + 1] += yx
    values[at + STRIDE] += xy
    values[at + STRIDE + 1] += yy


@jit
def _add_entries(blocks, i, j, xx, xy, yx, yy):
    """Add a 2 x 2 block entry by entry: a point has no block of its own, or is an image."""
    if blocks.home[i] <= IMAGE or blocks.home[j] <= IMAGE:
        _add_images(blocks, i, j, (xx, xy, yx, yy))
        return
    add(blocks, i, j, xx)
    add(blocks, i + 1, j, yx)
    add(blocks, i + 1, j + 1, yy)
    if i != j:
        add(blocks, i, j + 1, xy)
