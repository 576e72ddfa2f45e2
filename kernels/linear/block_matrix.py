"""Symmetric matrix of 3 x 3 blocks with a static pattern, and where every entry goes.

A block holds the unknowns of one point: x, y and the rotation of a joint. Blocks are numbered in
the order of their elimination; the lower half is stored by columns, each diagonal block first in
`values`, then the blocks below. A block is three columns of four entries, the fourth of them zero.

A coordinate has a *home*: 3 x block + slot, or one of the codes below.
"""

from typing import NamedTuple

import numpy as np

from kernels.arrays import zero
from kernels.compile.jit import jit, jit_exact, jit_owning
from kernels.compile.simd import LANES

HELD, INNER, DRIVEN = -1, -2, -3  # never moves; eliminated inside its wall; led
IMAGE = -4  # of the first row of `periodic_images`, -5 of the second ...
STRIDE = LANES  # from one column of a block to the next
SIZE = 3 * STRIDE


class Blocks(NamedTuple):
    """Matrix of nb blocks.

    home (n,): of each coordinate. whole (n,): block of a coordinate and the next, -1 if they share
    none. start (nb + 1,), row (nl,): blocks below each diagonal block. update (nu,): targets in the
    order in which `factor` meets them. values (12 (nb + nl) + 1,): the last one takes what belongs
    nowhere. own (3 nb,): diagonal before the factor. diagonal, pull (n,): by coordinate, diagonal
    entries and couplings with what is led. ratio (n,), images (k, 4): as in `analysis.Layout`.
    vector (3 nb,), column (12 x longest,): scratch. missing (1,): set when an entry has no
    room.
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
    """Return the home of what is in this slot of a block."""
    return 3 * block + slot


@jit_exact
def find(start, row, i, j):
    """Return which block below the diagonals is (i, j), i > j; -1 if there is none."""
    low, high = start[j], start[j + 1]
    while low < high:
        middle = (low + high) // 2
        if row[middle] < i:
            low = middle + 1
        else:
            high = middle
    return low if low < start[j + 1] and row[low] == i else -1


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
            q = start[row[b]]  # through the rows of column b, which has all behind b
            for a in range(b + 1, start[j + 1]):
                while row[q] < row[a]:
                    q += 1
                update[count] = SIZE * (nb + q)
                count += 1
    return update


@jit_owning
def _whole(home):
    """Return the block of every coordinate that is its first unknown, with the next its second."""
    whole = np.full(home.size, -1)
    for i in range(home.size - 1):
        if home[i] >= 0 and home[i] % 3 == 0 and home[i + 1] == home[i] + 1:
            whole[i] = home[i] // 3
    return whole


@jit_owning
def shaped(home, start, row, ratio, images):
    """Return a zero matrix with this pattern."""
    nb, n = start.size - 1, home.size
    longest = 0
    for j in range(nb):
        longest = max(longest, start[j + 1] - start[j])
    return Blocks(
        home, _whole(home), start, row, updates(start, row),
        np.zeros(SIZE * (nb + row.size) + 1), np.zeros(3 * nb), np.zeros(n), np.zeros(n),
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
    """Return where entry (i, j) of homes is in `values`; -1 if it has no room."""
    p, q = home[i] // 3, home[j] // 3
    r, s = home[i] - 3 * p, home[j] - 3 * q
    if p == q:
        return SIZE * p + STRIDE * min(r, s) + max(r, s)
    if p < q:
        p, q, r, s = q, p, s, r
    found = find(start, row, p, q)
    return SIZE * (start.size - 1 + found) + STRIDE * s + r if found >= 0 else -1


@jit
def add(blocks, i, j, value):
    """Add a symmetric pair of entries at ``i``, ``j`` (once where i == j), no images."""
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
def _followed(blocks, c, which):
    """Return the first or the second coordinate that ``c`` follows, and how many times."""
    home = blocks.home[c]
    if home > IMAGE:
        return c, 1 - which
    image = blocks.images[IMAGE - home]
    return (image[2], image[3]) if which == 1 else (max(image[1], 0), 1 if image[1] >= 0 else 0)


@jit_exact
def add_image(blocks, i, j, value, pulls):
    """Add a pair of entries, or one if i == j, of images: to what each of them follows.

    Without ``pulls`` what is led is left out.
    """
    share = 0.5 if i == j else 1.0
    for k in range(4):
        p, one = _followed(blocks, i, k // 2)
        q, two = _followed(blocks, j, k % 2)
        entry = share * one * two * value
        if entry != 0.0:
            if p == q:
                blocks.diagonal[p] += 2.0 * entry
            elif pulls or (blocks.home[p] != DRIVEN and blocks.home[q] != DRIVEN):
                add(blocks, p, q, entry)


@jit_exact
def _add_images(blocks, i, j, block):
    """Add a block of points of which one is an image at least."""
    for k in range(4):
        if k != 1 or i != j:
            add_image(blocks, i + k // 2, j + k % 2, block[k], True)


@jit
def add_block(blocks, i, j, xx, xy, yx, yy):
    """Add the 2 x 2 block of points whose x are coordinates ``i``, ``j`` (lower half if equal)."""
    p, q, at = blocks.whole[i], blocks.whole[j], -1
    if p < 0 or q < 0 or (p == q and i != j):
        _add_apart(blocks, i, j, xx, xy, yx, yy)
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
def _add_apart(blocks, i, j, xx, xy, yx, yy):
    """Add a block of points whose coordinates do not share a block, entry by entry."""
    if blocks.home[i] <= IMAGE or blocks.home[j] <= IMAGE:
        _add_images(blocks, i, j, (xx, xy, yx, yy))
        return
    add(blocks, i, j, xx)
    add(blocks, i + 1, j, yx)
    add(blocks, i + 1, j + 1, yy)
    if i != j:
        add(blocks, i, j + 1, xy)
