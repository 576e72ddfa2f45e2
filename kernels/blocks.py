"""LDL^T factor of a matrix of 3 x 3 blocks, in place, and its solves.

Every update knows its target beforehand (George & Liu 1981, Computer Solution of Large Sparse
Positive Definite Systems, ch. 5).
"""

import math

from kernels.entries import SIZE
from kernels.jit import jit, jit_exact
from kernels.rows import zero

NEUTRAL = 1e-11  # a pivot below this share of its diagonal is round-off around zero
SOFT = 1e-6  # share of its diagonal that it is given then
ROUNDED = -1e-7  # so is a negative one above this: what stiff neighbours leave when they cancel
CONVEX = -math.inf  # and any in a matrix that is positive semi-definite


@jit_exact
def settle(blocks, scale):
    """Add the diagonal entries of the coordinates to their blocks; unused slots become 1."""
    for i in range(blocks.home.size):
        h = blocks.home[i]
        if h >= 0:
            blocks.values[SIZE * (h // 3) + 4 * (h % 3)] += blocks.diagonal[i]
            blocks.own[h] = -1.0
    for h in range(blocks.own.size):
        at = SIZE * (h // 3) + 4 * (h % 3)
        if blocks.own[h] != -1.0:
            blocks.values[at] = scale
        blocks.own[h] = blocks.values[at]


@jit_exact
def pivoted(pivot, own, scale, rounded):
    """Return the pivot to use. One that is zero within round-off, above ``rounded`` x its diagonal,
    marks a motion without stiffness: it is given a small share of its own diagonal (or ``scale``),
    so that the solution moves along it where a force asks for it, and hardly by what forces leave
    in round-off.
    """
    size = max(abs(own), 1e-3 * scale)
    return SOFT * max(abs(own), scale) if rounded * size <= pivot <= NEUTRAL * size else pivot


@jit_exact
def _invert(values, at, own, scale, rounded):
    """Replace the diagonal block at ``at`` by its inverse; return the failed slot and its pivot.

    d = diag(a, b, c) and the unit lower triangle l are the block's own LDL^T. Above the diagonal
    stands l^{-T}, so far as it is known, until the block is inverted.
    """
    a = pivoted(values[at], own[0], scale, rounded)
    if not a > 0.0:
        return 0, a
    l10, l20 = values[at + 3] / a, values[at + 6] / a
    values[at + 1] = -l10
    b = pivoted(values[at + 4] - l10 * values[at + 3], own[1], scale, rounded)
    if not b > 0.0:
        return 1, b
    l21 = (values[at + 7] - l20 * values[at + 3]) / b
    m20 = l10 * l21 - l20
    values[at + 2], values[at + 5] = m20, -l21
    c = values[at + 8] - l20 * values[at + 6] - l21 * l21 * b
    c = pivoted(c, own[2], scale, rounded)
    if not c > 0.0:
        return 2, c
    values[at + 8] = 1.0 / c
    values[at + 7] = values[at + 5] = -l21 / c
    values[at + 6] = values[at + 2] = m20 / c
    values[at + 4] = 1.0 / b + l21 * l21 / c
    values[at + 3] = values[at + 1] = -l10 / b - l21 * m20 / c
    values[at] = 1.0 / a + l10 * l10 / b + m20 * m20 / c
    return -1, 0.0


@jit
def _scale_column(blocks, j, nb):
    """Keep column ``j`` and multiply it by the inverse of its diagonal block."""
    values, column = blocks.values, blocks.column
    inverse = values[SIZE * j : SIZE * j + SIZE]
    for q in range(blocks.start[j], blocks.start[j + 1]):
        at, kept = SIZE * (nb + q), SIZE * (q - blocks.start[j])
        for r in range(3):
            x, y, z = values[at + 3 * r], values[at + 3 * r + 1], values[at + 3 * r + 2]
            for s in range(3):
                column[kept + 3 * r + s] = values[at + 3 * r + s]
                values[at + 3 * r + s] = x * inverse[s] + y * inverse[3 + s] + z * inverse[6 + s]


@jit
def _update(blocks, j, nb, count):
    """Subtract what column ``j`` adds to the blocks behind it; ``count``: its first update."""
    values, column, update = blocks.values, blocks.column, blocks.update
    for a in range(blocks.start[j + 1] - blocks.start[j]):
        left = values[SIZE * (nb + blocks.start[j] + a) : SIZE * (nb + blocks.start[j] + a + 1)]
        for b in range(a + 1):
            to, kept = update[count], SIZE * b
            count += 1
            for r in range(3):
                x, y, z = left[3 * r], left[3 * r + 1], left[3 * r + 2]
                for s in range(3):
                    k = kept + 3 * s
                    values[to + 3 * r + s] -= x * column[k] + y * column[k + 1] + z * column[k + 2]
    return count


@jit_exact
def factor(blocks, scale, rounded):
    """Factor in place: A = L D L^T, L D^{-1} below, D^{-1} in the diagonal blocks.

    Return (failed, pivot): home of the first negative pivot, -1 if none. ``rounded``: as in
    `pivoted`.
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


@jit
def forward(blocks):
    """Solve L D y = vector, in place."""
    nb, values, v = blocks.start.size - 1, blocks.values, blocks.vector
    for j in range(nb):
        x, y, z = v[3 * j], v[3 * j + 1], v[3 * j + 2]
        for q in range(blocks.start[j], blocks.start[j + 1]):
            at, to = SIZE * (nb + q), 3 * blocks.row[q]
            for r in range(3):
                k = at + 3 * r
                v[to + r] -= values[k] * x + values[k + 1] * y + values[k + 2] * z
        at = SIZE * j
        for r in range(3):
            k = at + 3 * r
            v[3 * j + r] = values[k] * x + values[k + 1] * y + values[k + 2] * z


@jit
def backward(blocks, first):
    """Solve L^T y = vector, in place, for the blocks before ``first``."""
    nb, values, v = blocks.start.size - 1, blocks.values, blocks.vector
    for j in range(first - 1, -1, -1):
        for q in range(blocks.start[j], blocks.start[j + 1]):
            at, of = SIZE * (nb + q), 3 * blocks.row[q]
            for r in range(3):
                for s in range(3):
                    v[3 * j + s] -= values[at + 3 * r + s] * v[of + r]


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
        v[3 * j + s] = values[SIZE * j + 3 * s + slot]
    backward(blocks, j)
