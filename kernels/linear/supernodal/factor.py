"""LDL^T factor without pivoting, supernode by supernode.

Pivots that are zero within round-off are treated as in `condensed.block_ldlt`.
"""

from kernels.compile.jit import jit, jit_exact
from kernels.linear.pivots import ROUNDED, SOFT, THROUGH, regularised
from kernels.linear.supernodal.dense import divide, pack, subtract
from kernels.linear.supernodal.fronts import assemble, strip
from kernels.linear.supernodal.matrix import COLUMNS, ROWS, rounded_up, size
from kernels.linear.supernodal.solution import descend_to


@jit_exact
def _is_rounded(matrix, s, place, pivot):
    """Return whether the negative pivot at ``place`` is round-off: see `block_ldlt`."""
    descend_to(matrix, s, place)
    total = 0.0
    for i in range(place + 1):
        total += abs(matrix.own[i]) * matrix.vector[i] ** 2
    return pivot >= ROUNDED * total


@jit_exact
def _pivot(matrix, s, place, value, scale, rounded):
    """Return ``value``, or its replacement if this pivot is zero within round-off."""
    own = matrix.own[place]
    pivot = regularised(value, own, scale, rounded)
    if pivot < 0.0 and rounded != THROUGH and _is_rounded(matrix, s, place, pivot):
        return SOFT * max(abs(own), scale)
    return pivot


@jit_exact
def _factor_corner(matrix, s, k, scale, rounded):
    """Factor the 4 x 4 block on the diagonal from column ``k`` on, in place.

    Return (failed, pivot): place of a negative pivot, -1 if none.
    """
    tiles, place = matrix.tiles, matrix.column[s] + k
    at = strip(matrix, s, k) + ROWS * k + k % ROWS
    for c in range(min(COLUMNS, matrix.column[s + 1] - place)):
        unit = scale[matrix.unknown[place + c]]
        pivot = _pivot(matrix, s, place + c, tiles[at + (ROWS + 1) * c], unit, rounded)
        if not (pivot > 0.0 or rounded == THROUGH):
            return place + c, pivot
        matrix.pivots[place + c], matrix.inverse[place + c] = pivot, 1.0 / pivot
        for b in range(c + 1, COLUMNS):
            share = tiles[at + ROWS * c + b] / pivot
            for a in range(b, COLUMNS):
                tiles[at + ROWS * b + a] -= share * tiles[at + ROWS * c + a]
        for a in range(c + 1, COLUMNS):
            tiles[at + ROWS * c + a] /= pivot
    return -1, 0.0


@jit_exact
def _inverses(matrix, s, k):
    """Return the inverses of the four pivots from column ``k`` on; 0 beyond the last."""
    at, last = matrix.column[s] + k, matrix.column[s + 1]
    inverse = matrix.inverse
    return (
        inverse[at],
        inverse[at + 1] if at + 1 < last else 0.0,
        inverse[at + 2] if at + 2 < last else 0.0,
        inverse[at + 3] if at + 3 < last else 0.0,
    )


@jit_exact
def _divide_beside(matrix, s, k, corner, inverse):
    """Divide the rows between the corner of column ``k`` and the end of its strip."""
    tiles = matrix.tiles
    for row in range(k % ROWS + COLUMNS, ROWS):
        at = strip(matrix, s, k) + ROWS * k + row
        for c in range(COLUMNS):
            for b in range(c):
                tiles[at + ROWS * c] -= tiles[at + ROWS * b] * tiles[corner + ROWS * b + c]
        for c in range(COLUMNS):
            tiles[at + ROWS * c] *= inverse[c]


@jit
def _factor_columns(matrix, s, k, scale, rounded):
    """Factor the four columns of supernode ``s`` from ``k`` on; return (failed, pivot)."""
    (w, r), tiles = size(matrix, s), matrix.tiles
    pack(tiles, strip(matrix, s, k) + k % ROWS, matrix.pivots, matrix.column[s], k, matrix.pack)
    last, step = rounded_up(w, ROWS) + r, ROWS
    for i in range(k // ROWS * ROWS, last, ROWS):
        at = strip(matrix, s, i)
        subtract(tiles, at, matrix.pack, k, tiles, at + ROWS * k, step)
    failed, pivot = _factor_corner(matrix, s, k, scale, rounded)
    if failed >= 0:
        return failed, pivot
    corner, inverse = strip(matrix, s, k) + ROWS * k + k % ROWS, _inverses(matrix, s, k)
    _divide_beside(matrix, s, k, corner, inverse)
    for i in range(k // ROWS * ROWS + ROWS, last, ROWS):
        divide(tiles, strip(matrix, s, i) + ROWS * k, corner, inverse)
    return -1, 0.0


@jit
def _update(matrix, s):
    """Subtract the product of the rows below supernode ``s`` from its update."""
    w, r = size(matrix, s)
    below, step = rounded_up(w, ROWS), rounded_up(r, ROWS)
    for c in range(0, r, COLUMNS):
        of = strip(matrix, s, below + c) + c % ROWS
        pack(matrix.tiles, of, matrix.pivots, matrix.column[s], w, matrix.pack)
        for i in range(c // ROWS * ROWS, r, ROWS):
            at, to = strip(matrix, s, below + i), matrix.update[s] + step * c + i
            subtract(matrix.tiles, at, matrix.pack, w, matrix.updates, to, step)


@jit_exact
def _read_diagonal(matrix, weights, shift):
    """Fill ``own`` with the diagonal and ``shift`` times the ``weights``."""
    for s in range(matrix.column.size - 1):
        w, r = size(matrix, s)
        for k in range(w):
            place = matrix.column[s] + k
            entry = matrix.values[matrix.panel[s] + k * (w + r + 1)]
            matrix.own[place] = entry + shift * weights[matrix.unknown[place]]


@jit_exact
def factor(matrix, scale, weights, shift, rounded):
    """Factor A + shift diag(weights) = L D L^T; ``values`` keeps A.

    Return (failed, pivot): unknown and value of the first negative pivot, -1 if none. scale (n,):
    stiffness of each unknown, in its unit, relative to which a pivot is zero within round-off.
    weights (n,): by unknown. rounded: `ROUNDED` or `THROUGH`.
    """
    _read_diagonal(matrix, weights, shift)
    matrix.failed[0] = -1
    for s in range(matrix.column.size - 1):
        assemble(matrix, s)
        w, _ = size(matrix, s)
        for k in range(0, w, COLUMNS):
            failed, pivot = _factor_columns(matrix, s, k, scale, rounded)
            if failed >= 0:
                matrix.failed[0] = failed
                return matrix.unknown[failed], pivot
        _update(matrix, s)
    return -1, 0.0


@jit_exact
def negatives(matrix):
    """Return the number of negative pivots, which equals the number of negative eigenvalues
    (Sylvester).
    """
    count = 0
    for pivot in matrix.pivots:
        count += pivot < 0.0
    return count


@jit_exact
def stiffest(matrix, mask):
    """Return the largest diagonal entry before the factor, of unknowns in the ``mask`` (n,)."""
    most = 0.0
    for i in range(mask.size):
        if mask[i]:
            most = max(most, matrix.own[matrix.home[i]])
    return most
