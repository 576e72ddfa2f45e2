"""Fronts: a supernode with the updates that its children leave for it (Duff & Reid 1983, ACM Trans.
Math. Softw. 9: The multifrontal solution of indefinite sparse symmetric linear equations).

The front of w columns and r rows below them has ceil(w / 12) strips of pivot rows, and then
ceil(r / 12) strips of the rows below, so that a row below is row 12 ceil(w / 12) + i of the front.
Columns are filled up with zeros to a multiple of four. The *update* is the lower half of the r x r
block below the columns, column by column.
"""

from kernels.compile.jit import jit, jit_exact
from kernels.compile.simd import LANES, load, store
from kernels.linear.supernodal.matrix import COLUMNS, ROWS, rounded_up, size


@jit_exact
def strip(matrix, s, row):
    """Return the index in ``tiles`` at which the strip of ``row`` of the front of supernode ``s``
    starts.
    """
    w, _ = size(matrix, s)
    return matrix.tile[s] + row // ROWS * ROWS * rounded_up(w, COLUMNS)


@jit
def _fill_strip(values, panel, step, width, count, tiles, at):
    """Copy ``count`` rows of a panel, whose columns are ``step`` apart, to the strip at ``at``."""
    if count == ROWS:
        for k in range(width):
            of, to = panel + step * k, at + ROWS * k
            store(tiles, to, load(values, of))
            store(tiles, to + 4, load(values, of + 4))
            store(tiles, to + 8, load(values, of + 8))
    else:
        for k in range(width):
            of, to = panel + step * k, at + ROWS * k
            for i in range(count):
                tiles[to + i] = values[of + i]
            for i in range(count, ROWS):
                tiles[to + i] = 0.0
    for i in range(at + ROWS * width, at + ROWS * rounded_up(width, COLUMNS)):
        tiles[i] = 0.0


@jit
def _fill(matrix, s):
    """Copy the panel of supernode ``s`` to its tiles, with ``own`` on the diagonal."""
    w, r = size(matrix, s)
    panel, step, below = matrix.panel[s], w + r, rounded_up(w, ROWS)
    for i in range(0, w, ROWS):
        at, count = strip(matrix, s, i), min(ROWS, w - i)
        _fill_strip(matrix.values, panel + i, step, w, count, matrix.tiles, at)
        for k in range(count):
            matrix.tiles[at + ROWS * (i + k) + k] = matrix.own[matrix.column[s] + i + k]
    for i in range(0, r, ROWS):
        at = strip(matrix, s, below + i)
        _fill_strip(
            matrix.values, panel + w + i, step, w, min(ROWS, r - i), matrix.tiles, at
        )  # fmt: skip


@jit
def _add_run(source, of, target, to, count):
    """Add ``count`` entries of ``source``, starting at ``of``, to the entries of ``target``
    starting at ``to``.
    """
    whole = count // LANES * LANES
    for i in range(0, whole, LANES):
        store(target, to + i, load(target, to + i) + load(source, of + i))
    for i in range(whole, count):
        target[to + i] += source[of + i]


@jit
def _pass_on(matrix, child, s):
    """Add the update of ``child`` to the front of its parent ``s``."""
    (w, r), (_, count) = size(matrix, s), size(matrix, child)
    first, up, run = matrix.lower[child], matrix.up, matrix.run
    height, step, pivots = rounded_up(r, ROWS), rounded_up(count, ROWS), rounded_up(w, ROWS)
    p, last = matrix.run_start[child], matrix.run_start[child + 1]
    for c in range(first, first + count):
        p += run[p + 1] == c
        of, k = matrix.update[child] + step * (c - first) - first, up[c]
        if k < w:
            to = matrix.tile[s] + ROWS * k
            for i in range(p, last):
                row = max(run[i], c)
                at = to + matrix.beside[row]
                _add_run(matrix.updates, of + row, matrix.tiles, at, run[i + 1] - row)
        else:
            to = matrix.update[s] + (k - pivots) * height - pivots
            for i in range(p, last):
                row = max(run[i], c)
                _add_run(matrix.updates, of + row, matrix.updates, to + up[row], run[i + 1] - row)


@jit
def _clear_update(matrix, s):
    """Set the strips of the lower half of the update of supernode ``s`` to zero."""
    _, r = size(matrix, s)
    height = rounded_up(r, ROWS)
    for c in range(rounded_up(r, COLUMNS)):
        at = matrix.update[s] + c * height
        for i in range(at + c // ROWS * ROWS, at + height):
            matrix.updates[i] = 0.0


@jit
def assemble(matrix, s):
    """Fill the front of supernode ``s``: tiles and update."""
    _fill(matrix, s)
    _clear_update(matrix, s)
    for q in range(matrix.child_start[s], matrix.child_start[s + 1]):
        _pass_on(matrix, matrix.child[q], s)
