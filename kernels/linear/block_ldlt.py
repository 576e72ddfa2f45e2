"""LDL^T factor of a matrix of 3 x 3 blocks, in place, and its solves.

The target of every update is known from the symbolic factorisation (George & Liu 1981, Computer
Solution of Large Sparse Positive Definite Systems, ch. 5).
"""

import math

from kernels.arrays import zero
from kernels.compile.jit import jit, jit_exact
from kernels.compile.simd import load, spread, store
from kernels.linear.block_matrix import SIZE, STRIDE

ZERO_PIVOT = 1e-11  # a pivot below this share of its diagonal is zero within round-off
SOFT = 1e-6  # share of its diagonal that replaces such a pivot
ROUNDED = -1e-7  # a negative pivot above this share is round-off too: stiff entries cancel
CONVEX = -math.inf  # in a positive semi-definite matrix every negative pivot is round-off
THROUGH = math.inf  # no pivot is replaced, negative ones are no failure: see `negatives`


@jit_exact
def add_diagonal(blocks, scale):
    """Add ``diagonal`` to the blocks and keep the result in ``own``; unused slots are ``scale``."""
    for i in range(blocks.home.size):
        h = blocks.home[i]
        if h >= 0:
            blocks.values[SIZE * (h // 3) + (STRIDE + 1) * (h % 3)] += blocks.diagonal[i]
            blocks.own[h] = -1.0
    for h in range(blocks.own.size):
        at = SIZE * (h // 3) + (STRIDE + 1) * (h % 3)
        if blocks.own[h] != -1.0:
            blocks.values[at] = scale
        blocks.own[h] = blocks.values[at]


@jit_exact
def regularised(pivot, own, scale, rounded):
    """Return ``pivot``, or its replacement if it is zero within round-off.

    Such a pivot, between ``rounded`` and `ZERO_PIVOT` times its diagonal ``own``, belongs to a
    motion without stiffness. It is replaced by a small share of the diagonal (or of ``scale``): the
    solution follows a force along the motion, but hardly the round-off in forces. With `THROUGH` no
    pivot is replaced, as true pivots are as small near limit points.
    """
    size = max(abs(own), 1e-3 * scale)
    return SOFT * max(abs(own), scale) if rounded * size <= pivot <= ZERO_PIVOT * size else pivot


@jit_exact
def _invert(values, at, own, scale, rounded):
    """Replace the diagonal block at ``at`` by its inverse; return the failed slot and its pivot.

    diag(a, b, c) and the unit lower triangle l are the LDL^T factor of the block. Until the block
    is inverted, the completed rows of l^{-T} are stored above its diagonal, for `descend`. Entry
    (r, s) is at 4 s + r. Slot -1: no failure.
    """
    a = regularised(values[at], own[0], scale, rounded)
    if not (a > 0.0 or rounded == THROUGH):
        return 0, a
    a10, a20, a21 = values[at + 1], values[at + 2], values[at + 6]
    l10, l20 = a10 / a, a20 / a
    values[at + 4] = -l10
    b = regularised(values[at + 5] - l10 * a10, own[1], scale, rounded)
    if not (b > 0.0 or rounded == THROUGH):
        return 1, b
    l21 = (a21 - l20 * a10) / b
    m20 = l10 * l21 - l20
    values[at + 8], values[at + 9] = m20, -l21
    c = regularised(values[at + 10] - l20 * a20 - l21 * l21 * b, own[2], scale, rounded)
    if not (c > 0.0 or rounded == THROUGH):
        return 2, c
    values[at + 10] = 1.0 / c
    values[at + 6] = values[at + 9] = -l21 / c
    values[at + 2] = values[at + 8] = m20 / c
    values[at + 5] = 1.0 / b + l21 * l21 / c
    values[at + 1] = values[at + 4] = -l10 / b - l21 * m20 / c
    values[at] = 1.0 / a + l10 * l10 / b + m20 * m20 / c
    return -1, 0.0


@jit
def _columns(values, at):
    """Return the columns of the block at ``at``."""
    return load(values, at), load(values, at + STRIDE), load(values, at + 2 * STRIDE)


@jit
def _weights(values, at):
    """Return the row of a block at ``at``, each of its entries spread over all four lanes."""
    x, y, z = values[at], values[at + STRIDE], values[at + 2 * STRIDE]
    return spread(x), spread(y), spread(z)


@jit
def _combined(sums, columns, weights):
    """Return ``sums`` + the ``columns`` times their weights."""
    for c in range(3):
        sums = sums + columns[c] * weights[c]
    return sums


@jit
def _scale_column(blocks, j, nb):
    """Copy -A of column ``j`` to ``column``, then multiply the blocks A by D^{-1}."""
    values, minus, nothing, offset = blocks.values, spread(-1.0), spread(0.0), 0
    one, two = _weights(values, SIZE * j), _weights(values, SIZE * j + 1)
    three = _weights(values, SIZE * j + 2)
    for at in range(SIZE * (nb + blocks.start[j]), SIZE * (nb + blocks.start[j + 1]), SIZE):
        columns = _columns(values, at)
        for column in columns:
            store(blocks.column, offset, minus * column)
            offset += STRIDE
        store(values, at, _combined(nothing, columns, one))
        store(values, at + STRIDE, _combined(nothing, columns, two))
        store(values, at + 2 * STRIDE, _combined(nothing, columns, three))


@jit
def _update(blocks, j, nb, count):
    """Subtract A_a D^{-1} A_b^T from the blocks (a, b) right of column ``j`` with the blocks A.

    count: number of its first update. Return that of the next column.
    """
    values, column, update, offset = blocks.values, blocks.column, blocks.update, 0
    last = SIZE * (nb + blocks.start[j + 1])
    for first in range(SIZE * (nb + blocks.start[j]), last, SIZE):
        one, two = _weights(column, offset), _weights(column, offset + 1)
        three = _weights(column, offset + 2)
        for at in range(first, last, SIZE):
            left, to = _columns(values, at), update[count]
            x, y, z = _columns(values, to)
            store(values, to, _combined(x, left, one))
            store(values, to + STRIDE, _combined(y, left, two))
            store(values, to + 2 * STRIDE, _combined(z, left, three))
            count += 1
        offset += SIZE
    return count


@jit_exact
def factor(blocks, scale, rounded):
    """Factor in place: A = L D L^T; L replaces the blocks below, D^{-1} the diagonal blocks.

    Return (failed, pivot): home of the first negative pivot, -1 if none. rounded: as in
    `regularised`.
    """
    nb, count = blocks.start.size - 1, 0
    for j in range(nb):
        own = blocks.own[3 * j : 3 * j + 3]
        slot, pivot = _invert(blocks.values, SIZE * j, own, scale, rounded)
        if slot >= 0:
            return 3 * j + slot, pivot
        _scale_column(blocks, j, nb)
        count = _update(blocks, j, nb, count)
    return -1, 0.0


@jit_exact
def stiffest(blocks, lengths):
    """Return the largest diagonal entry before the factor in the first ``lengths`` slots of a
    block, which are coordinates in m.
    """
    most = 0.0
    for j in range(blocks.start.size - 1):
        for slot in range(lengths):
            most = max(most, blocks.own[3 * j + slot])
    return most


@jit_exact
def negatives(blocks):
    """Return the number of negative pivots of the factor, from the inverses of its blocks."""
    count, v = 0, blocks.values
    for at in range(0, SIZE * (blocks.start.size - 1), SIZE):
        a = v[at]
        b = v[at + 5] - v[at + 1] * v[at + 1] / a
        l21 = (v[at + 6] - v[at + 2] * v[at + 1] / a) / b
        c = v[at + 10] - v[at + 2] * v[at + 2] / a - l21 * l21 * b
        count += (a < 0.0) + (b < 0.0) + (c < 0.0)
    return count


@jit
def forward(blocks):
    """Solve L D y = vector, in place."""
    nb, values, v = blocks.start.size - 1, blocks.values, blocks.vector
    for j in range(nb):
        x, y, z = v[3 * j], v[3 * j + 1], v[3 * j + 2]
        for q in range(blocks.start[j], blocks.start[j + 1]):
            at, to = SIZE * (nb + q), 3 * blocks.row[q]
            for r in range(3):
                k = at + r
                v[to + r] -= values[k] * x + values[k + STRIDE] * y + values[k + 2 * STRIDE] * z
        for r in range(3):
            k = SIZE * j + r
            v[3 * j + r] = values[k] * x + values[k + STRIDE] * y + values[k + 2 * STRIDE] * z


@jit
def backward(blocks, first):
    """Solve L^T y = vector, in place, for the blocks before ``first``."""
    nb, values, v = blocks.start.size - 1, blocks.values, blocks.vector
    for j in range(first - 1, -1, -1):
        for q in range(blocks.start[j], blocks.start[j + 1]):
            at, of = SIZE * (nb + q), 3 * blocks.row[q]
            x, y, z = v[of], v[of + 1], v[of + 2]
            for s in range(3):
                k = at + STRIDE * s
                v[3 * j + s] -= values[k] * x + values[k + 1] * y + values[k + 2] * z


@jit_exact
def descend(blocks, failed):
    """Fill ``vector`` with d such that d^T A d is the negative pivot at home ``failed``.

    With A = [[A1, a], [a^T, c]] the vector (-A1^{-1} a, 1, 0 ...) has d^T A d = c - a^T A1^{-1} a.
    """
    v, values = blocks.vector, blocks.values
    zero(v)
    v[failed] = 1.0
    j, slot = failed // 3, failed % 3
    for s in range(slot):
        v[3 * j + s] = values[SIZE * j + STRIDE * slot + s]
    backward(blocks, j)
