"""Symmetric matrix of 3 x 3 blocks with a static pattern, and where every entry goes.

A block holds the unknowns of one point: x, y and the rotation of a joint. Blocks are numbered in
the order of their elimination; the lower half is stored by columns, each diagonal block first in
`values`, then the blocks below.

A coordinate has a *home*: 3 x block + slot, or one of the codes below.
"""

from typing import NamedTuple

import numpy as np

from kernels.jit import jit, jit_exact, jit_owning
from kernels.rows import zero

HELD, INNER, DRIVEN = -1, -2, -3  # never moves; eliminated inside its wall; led
IMAGE = -4  # of the first row of `image`, -5 of the second ...
SIZE = 9


class Blocks(NamedTuple):
    """Matrix of nb blocks.

    home (n,): of each coordinate. start (nb + 1,), row (nl,): blocks below each diagonal block.
    update (nu,): targets in the order in which `factor` meets them. values (9 (nb + nl) + 1,): the
    last one takes what belongs nowhere. own (3 nb,): diagonal before the factor. diagonal, pull
    (n,): by coordinate, diagonal entries and couplings with what is led. ratio (n,), images
    (k, 4): as in `pattern.Layout`. vector (3 nb,), column (9 x longest,): scratch. missing (1,):
    set when an entry has no room.
    """

    home: np.ndarray
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
    update, first = np.empty(count, np.int64), 0
    for j in range(nb):
        height = start[j + 1] - start[j]
        for b in range(height):
            update[first + b * (b + 3) // 2] = SIZE * row[start[j] + b]
            q = start[row[start[j] + b]]  # through the rows of column b, which has all behind b
            for a in range(b + 1, height):
                while row[q] < row[start[j] + a]:
                    q += 1
                update[first + a * (a + 1) // 2 + b] = SIZE * (nb + q)
        first += height * (height + 1) // 2
    return update


@jit_owning
def shaped(home, start, row, ratio, images):
    """Return a zero matrix with this pattern."""
    nb, n = start.size - 1, home.size
    longest = 0
    for j in range(nb):
        longest = max(longest, start[j + 1] - start[j])
    return Blocks(
        home, start, row, updates(start, row), np.zeros(SIZE * (nb + row.size) + 1),
        np.zeros(3 * nb), np.zeros(n), np.zeros(n), ratio, images,
        np.zeros(3 * nb), np.zeros(SIZE * longest), np.zeros(1, np.int64),
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
        return SIZE * p + 3 * max(r, s) + min(r, s)
    if p < q:
        p, q, r, s = q, p, s, r
    found = find(start, row, p, q)
    return SIZE * (start.size - 1 + found) + 3 * r + s if found >= 0 else -1


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
def _is_whole(home, i):
    """Return whether x and y of the point whose x is coordinate ``i`` share a block."""
    return home[i] >= 0 and home[i + 1] == home[i] + 1


@jit
def add_block(blocks, i, j, xx, xy, yx, yy):
    """Add the 2 x 2 block of points whose x are coordinates ``i``, ``j`` (lower half if equal)."""
    home, values = blocks.home, blocks.values
    if home[i] != home[j] and _is_whole(home, i) and _is_whole(home, j):
        at = position(home, blocks.start, blocks.row, i, j)
        if at < 0:
            blocks.missing[0] = 1
            return
        across, down = (1, 3) if home[i] > home[j] else (3, 1)
        values[at] += xx
        values[at + across] += xy
        values[at + down] += yx
        values[at + 4] += yy
        return
    if home[i] <= IMAGE or home[j] <= IMAGE:
        _add_images(blocks, i, j, (xx, xy, yx, yy))
        return
    add(blocks, i, j, xx)
    add(blocks, i + 1, j, yx)
    add(blocks, i + 1, j + 1, yy)
    if i != j:
        add(blocks, i, j + 1, xy)
