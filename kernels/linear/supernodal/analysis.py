"""Analysis of a matrix before it is factored: order of elimination, and room for all entries."""

import numpy as np

from kernels.compile.jit import jit_exact, jit_owning
from kernels.linear import minimum_degree
from kernels.linear.supernodal.dissection import dissect, neighbours
from kernels.linear.supernodal.matrix import COLUMNS, ROWS, Matrix, rounded_up
from kernels.linear.supernodal.symbolic import children, columns, supernodes


@jit_owning
def _by_degree(start, near):
    """Return the order (n,) of minimum degree."""
    n = start.size - 1
    bits = minimum_degree.graph(n)
    for i in range(n):
        for q in range(start[i], start[i + 1]):
            minimum_degree.connect(bits, i, near[q])
    return minimum_degree.minimum_degree(bits)


@jit_exact
def _work(order, first, row, sizes):
    """Return the number of multiplications of a factor with these columns."""
    work = 0.0
    for j in range(order.size):
        height = 0.0
        for q in range(first[j], first[j + 1]):
            height += sizes[order[row[q]]]
        width = sizes[order[j]]
        work += width * (height + 0.5 * width) ** 2
    return work


@jit_owning
def _order(start, near, sizes, points):
    """Return the better order of elimination, by minimum degree or nested dissection, and its
    columns.

    Minimum degree is better by a third for flat lattices of plates, nested dissection by a factor
    of two to five for folded ones in contact.
    """
    order = dissect(start, near, sizes, points)
    parent, first, row = columns(start, near, order)
    other = _by_degree(start, near)
    other_parent, other_first, other_row = columns(start, near, other)
    if _work(other, other_first, other_row, sizes) < _work(order, first, row, sizes):
        return other, other_parent, other_first, other_row
    return order, parent, first, row


@jit_owning
def _sums(numbers):
    """Return the sums (n + 1,) of the first 0, 1, ... n ``numbers``."""
    total = np.zeros(numbers.size + 1, np.int64)
    for i in range(numbers.size):
        total[i + 1] = total[i] + numbers[i]
    return total


@jit_owning
def _rows_up(column, lower, row, parent):
    """Return (up, beside), (m,) each: see `Matrix`."""
    up, beside = np.zeros(row.size, np.int64), np.zeros(row.size, np.int64)
    for s in range(parent.size):
        t = parent[s]
        if t >= 0:
            at, pivots = lower[t], rounded_up(column[t + 1] - column[t], ROWS)
            for q in range(lower[s], lower[s + 1]):
                if row[q] < column[t + 1]:
                    up[q] = row[q] - column[t]
                else:
                    while row[at] != row[q]:
                        at += 1
                    up[q] = pivots + at - lower[t]
                wide = rounded_up(column[t + 1] - column[t], COLUMNS)
                beside[q] = up[q] // ROWS * ROWS * wide + up[q] % ROWS
    return up, beside


@jit_owning
def _runs(lower, up):
    """Return (run_start (ns + 1,), run): see `Matrix`."""
    run_start, run, count = np.empty(lower.size, np.int64), np.empty(up.size + 1, np.int64), 0
    for s in range(lower.size - 1):
        run_start[s] = count
        for q in range(lower[s], lower[s + 1]):
            if q == lower[s] or up[q] != up[q - 1] + 1 or up[q] % ROWS == 0:
                run[count] = q
                count += 1
    run_start[-1], run[count] = count, up.size
    return run_start, run[: count + 1].copy()


@jit_owning
def _update_starts(lower, child_start, child):
    """Return (start (ns,), size): the first free place for each update next to those still waiting
    for their parents, and the total size.
    """
    ns = lower.size - 1
    start, size, live = np.zeros(ns, np.int64), np.zeros(ns, np.int64), np.empty(ns, np.int64)
    count, whole = 0, 0
    for s in range(ns):
        r = lower[s + 1] - lower[s]
        size[s] = rounded_up(r, ROWS) * rounded_up(r, COLUMNS)
        at, before = 0, 0
        while before < count and start[live[before]] - at < size[s]:
            at = start[live[before]] + size[live[before]]
            before += 1
        start[s], whole, kept = at, max(whole, at + size[s]), 0
        for k in range(count, before, -1):
            live[k] = live[k - 1]
        live[before] = s
        for q in range(child_start[s], child_start[s + 1]):
            size[child[q]] = 0
        for k in range(count + 1):
            if size[live[k]] > 0:
                live[kept] = live[k]
                kept += 1
        count = kept
    return start, whole


@jit_owning
def _panels(column, lower):
    """Return (panel, tile, widest, tallest): where panels and tiles start, (ns + 1,) each, and the
    greatest numbers of columns and rows of a front.
    """
    ns, widest, tallest = column.size - 1, 0, 0
    panel, tile = np.zeros(ns + 1, np.int64), np.zeros(ns + 1, np.int64)
    for s in range(ns):
        w, r = column[s + 1] - column[s], lower[s + 1] - lower[s]
        wide, tall = rounded_up(w, COLUMNS), rounded_up(w, ROWS) + rounded_up(r, ROWS)
        panel[s + 1], tile[s + 1] = panel[s] + w * (w + r), tile[s] + wide * tall
        widest, tallest = max(widest, wide), max(tallest, tall)
    return panel, tile, widest, tallest


@jit_owning
def _expanded(sequence, begin, first):
    """Return (home, unknown), (n,) each: the place of each unknown, and the unknown of each
    place.
    """
    home, unknown = np.empty(first[-1], np.int64), np.empty(first[-1], np.int64)
    for p in range(sequence.size):
        for slot in range(begin[p + 1] - begin[p]):
            home[first[sequence[p]] + slot] = begin[p] + slot
            unknown[begin[p] + slot] = first[sequence[p]] + slot
    return home, unknown


@jit_owning
def _unknown_rows(below, rows, begin):
    """Return (offset, lower, row): see `Matrix`."""
    offset, lower = np.empty(rows.size, np.int64), np.zeros(below.size, np.int64)
    for s in range(below.size - 1):
        lower[s + 1] = lower[s]
        for q in range(below[s], below[s + 1]):
            offset[q] = lower[s + 1] - lower[s]
            lower[s + 1] += begin[rows[q] + 1] - begin[rows[q]]
    row = np.empty(lower[-1], np.int64)
    for s in range(below.size - 1):
        for q in range(below[s], below[s + 1]):
            for slot in range(begin[rows[q] + 1] - begin[rows[q]]):
                row[lower[s] + offset[q] + slot] = begin[rows[q]] + slot
    return offset, lower, row


@jit_owning
def analyse(sizes, pairs, points):
    """Return a zero `Matrix`.

    sizes (nb,): unknowns of each block. pairs (k, 2): blocks that couple, in any order, repeats
    allowed. points (nb, 3): positions in m, which affect only the order of elimination.
    """
    nb = sizes.size
    start, near = neighbours(nb, pairs)
    order, parent, first_row, row_of = _order(start, near, sizes, points)
    weight = np.empty(nb, np.int64)
    for p in range(nb):
        weight[p] = sizes[order[p]]
    block, moved, below, rows, above = supernodes(parent, first_row, row_of, weight)
    sequence, place = np.empty(nb, np.int64), np.empty(nb, np.int64)
    for p in range(nb):
        sequence[p] = order[moved[p]]
        place[sequence[p]] = p
        weight[p] = sizes[sequence[p]]
    first, begin, ns = _sums(sizes), _sums(weight), above.size
    column, supernode = np.empty(ns + 1, np.int64), np.empty(nb, np.int64)
    for s in range(ns + 1):
        column[s] = begin[block[s]]
    for s in range(ns):
        for p in range(block[s], block[s + 1]):
            supernode[p] = s
    home, unknown = _expanded(sequence, begin, first)
    offset, lower, row = _unknown_rows(below, rows, begin)
    child_start, child = children(above)
    panel, tile, widest, tallest = _panels(column, lower)
    update, room = _update_starts(lower, child_start, child)
    up, beside = _rows_up(column, lower, row, above)
    run_start, run = _runs(lower, up)
    n = begin[nb]
    return Matrix(
        first, place, home, begin, supernode, unknown, block, column, below, rows, offset, lower,
        row, up, beside, run_start, run, child_start, child, panel, tile, update,
        np.zeros(panel[ns]), np.zeros(tile[ns]), np.zeros(room), np.zeros(n), np.zeros(n),
        np.zeros(n), np.zeros(n), np.zeros(tallest), np.zeros(COLUMNS * widest),
        np.zeros(COLUMNS * max(widest, 1)), np.zeros(1, np.int64), np.full(1, -1),
    )  # fmt: skip
