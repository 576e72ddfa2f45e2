"""LDL^T factor of a matrix of 3 x 3 blocks, in place, and its solves.

The target of every update is known from the symbolic factorisation (George & Liu 1981, Computer
Solution of Large Sparse Positive Definite Systems, ch. 5).
"""

from kernels.arrays import zero
from kernels.compile.jit import jit, jit_exact
from kernels.compile.simd import load, spread, store
from kernels.linear.condensed.block_matrix import SIZE, STRIDE
from kernels.linear.pivots import ROUNDED, SOFT, THROUGH, regularised


@jit_exact
def _diagonal(home):
    """Return the position in `Blocks.values` of the diagonal entry of a ``home``."""
    return SIZE * (home // 3) + (STRIDE + 1) * (home % 3)


@jit_exact
def add_diagonal(blocks, scale):
    """Add ``diagonal`` to the blocks and keep the result in ``own``; unused slots are ``scale``.

    scale (3,): of each slot.
    """
    for i in range(blocks.home.size):
        h = blocks.home[i]
        if h >= 0:
            blocks.values[_diagonal(h)] += blocks.diagonal[i]
            blocks.own[h] = -1.0
    for h in range(blocks.own.size):
        at = _diagonal(h)
        if blocks.own[h] != -1.0:
            blocks.values[at] = scale[h % 3]
        blocks.own[h] = blocks.values[at]


@jit_exact
def _is_rounded(blocks, failed, pivot):
    """Return whether the negative pivot at home ``failed`` is round-off.

    The pivot is d . A d with the vector d of `descend`. The entries of A have relative errors, so
    that the round-off of this sum is a share of sum A_ii d_i^2. In a motion of the whole lattice,
    such as a rotation, that is far more than the diagonal of the pivot.
    """
    descend(blocks, failed)
    size = 0.0
    for i in range(failed + 1):
        size += abs(blocks.own[i]) * blocks.vector[i] ** 2
    return pivot >= ROUNDED * size


@jit_exact
def _pivot(blocks, home, scale, rounded):
    """Return the pivot at ``home``, or its replacement if it is zero within round-off."""
    own = blocks.own[home]
    pivot = regularised(blocks.values[_diagonal(home)], own, scale, rounded)
    if pivot < 0.0 and rounded != THROUGH and _is_rounded(blocks, home, pivot):
        return SOFT * max(abs(own), scale)
    return pivot


@jit_exact
def _factor_block(blocks, j, scale, rounded):
    """Replace diagonal block ``j`` by its LDL^T factor: l below the diagonal, 1 / d on it.

    Return the failed slot and its pivot. Slot -1: no failure. Entry (r, s) is at 4 s + r.
    """
    values, at = blocks.values, SIZE * j
    a = _pivot(blocks, 3 * j, scale[0], rounded)
    if not (a > 0.0 or rounded == THROUGH):
        return 0, a
    l10, l20 = values[at + 1] / a, values[at + 2] / a
    values[at + 5] -= l10 * values[at + 1]
    values[at + 6] -= l10 * values[at + 2]
    values[at + 10] -= l20 * values[at + 2]
    values[at + 1], values[at + 2] = l10, l20
    b = _pivot(blocks, 3 * j + 1, scale[1], rounded)
    if not (b > 0.0 or rounded == THROUGH):
        return 1, b
    l21 = values[at + 6] / b
    values[at + 10] -= l21 * values[at + 6]
    values[at + 6] = l21
    c = _pivot(blocks, 3 * j + 2, scale[2], rounded)
    if not (c > 0.0 or rounded == THROUGH):
        return 2, c
    values[at], values[at + 5], values[at + 10] = 1.0 / a, 1.0 / b, 1.0 / c
    return -1, 0.0


@jit
def _columns(values, at):
    """Return the columns of the block at ``at``."""
    return load(values, at), load(values, at + STRIDE), load(values, at + 2 * STRIDE)


@jit
def _weights(values, at):
    """Return the row of a block at ``at``, each entry spread over all four lanes."""
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
    """Replace the blocks A of column ``j`` by A l^{-T} D^{-1}; copy -A l^{-T} to ``column``.

    Columns are eliminated one by one instead of multiplied by the inverse of the block: where that
    is large, stiff entries would cancel, and the sign of a soft pivot would be lost.
    """
    values, minus, offset, at = blocks.values, spread(-1.0), 0, SIZE * j
    l10, l20, l21 = spread(-values[at + 1]), spread(-values[at + 2]), spread(-values[at + 6])
    a, b, c = spread(-values[at]), spread(-values[at + 5]), spread(-values[at + 10])
    for at in range(SIZE * (nb + blocks.start[j]), SIZE * (nb + blocks.start[j + 1]), SIZE):
        one, two, three = _columns(values, at)
        one = minus * one
        two = minus * two + l10 * one
        three = minus * three + l20 * one + l21 * two
        for column, weight in ((one, a), (two, b), (three, c)):
            store(blocks.column, offset, column)
            store(values, at + offset % SIZE, column * weight)
            offset += STRIDE


@jit
def _update(blocks, j, nb, count):
    """Subtract A_a D^{-1} A_b^T from the blocks (a, b) right of column ``j`` with the blocks A.

    count: number of its first update. Return the number of the first update of the next column.
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
    """Factor in place: A = L D L^T; L replaces the blocks below, 1 / D the diagonal.

    Return (failed, pivot): home of the first negative pivot, -1 if none. scale (3,), rounded: as in
    `regularised`.
    """
    nb, count = blocks.start.size - 1, 0
    for j in range(nb):
        slot, pivot = _factor_block(blocks, j, scale, rounded)
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
    """Return the number of negative pivots of the factor."""
    count = 0
    for home in range(3 * (blocks.start.size - 1)):
        count += blocks.values[_diagonal(home)] < 0.0
    return count


@jit
def forward(blocks):
    """Solve L D y = vector, in place."""
    nb, values, v = blocks.start.size - 1, blocks.values, blocks.vector
    for j in range(nb):
        k, x = SIZE * j, v[3 * j]
        y = v[3 * j + 1] - values[k + 1] * x
        z = v[3 * j + 2] - values[k + 2] * x - values[k + 6] * y
        for q in range(blocks.start[j], blocks.start[j + 1]):
            at, to = SIZE * (nb + q), 3 * blocks.row[q]
            for r in range(3):
                i = at + r
                v[to + r] -= values[i] * x + values[i + STRIDE] * y + values[i + 2 * STRIDE] * z
        v[3 * j], v[3 * j + 1], v[3 * j + 2] = values[k] * x, values[k + 5] * y, values[k + 10] * z


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
        k = SIZE * j
        v[3 * j + 1] -= values[k + 6] * v[3 * j + 2]
        v[3 * j] -= values[k + 1] * v[3 * j + 1] + values[k + 2] * v[3 * j + 2]


@jit_exact
def descend(blocks, failed):
    """Fill ``vector`` with d such that d^T A d is the negative pivot at home ``failed``.

    With A = [[A1, a], [a^T, c]] the vector (-A1^{-1} a, 1, 0 ...) has d^T A d = c - a^T A1^{-1} a.
    """
    v, values = blocks.vector, blocks.values
    zero(v)
    v[failed] = 1.0
    j, slot = failed // 3, failed % 3
    k = SIZE * j
    if slot == 2:
        v[3 * j + 1] = -values[k + 6]
        v[3 * j] = -values[k + 2] - values[k + 1] * v[3 * j + 1]
    elif slot == 1:
        v[3 * j] = -values[k + 1]
    backward(blocks, j)
