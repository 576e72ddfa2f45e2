"""Analysis: order, fill of lattices of plates, and memory."""

import numpy as np
import pytest

from kernels.linear import minimum_degree
from kernels.linear.supernodal.analysis import analyse
from kernels.linear.supernodal.dissection import neighbours
from kernels.linear.supernodal.symbolic import columns
from tests.support.kernels.supernodes import random_blocks
from tests.support.kernels.wall_graph import folded, lattice_of_plates, near_pairs


def stored(matrix):
    """Entries of the lower half of all panels."""
    w, r = np.diff(matrix.column), np.diff(matrix.lower)
    return (w * (w + 1) // 2 + w * r).sum()


@pytest.mark.parametrize("seed", range(4))
def test_numbers_agree(seed):
    rng = np.random.default_rng(seed)
    sizes, pairs, points = random_blocks(rng, 50, 0.05)
    matrix = analyse(sizes, pairs, points)
    n = sizes.sum()
    np.testing.assert_array_equal(matrix.unknown[matrix.home], np.arange(n))
    for i in range(50):
        span = np.arange(matrix.first[i], matrix.first[i + 1])
        np.testing.assert_array_equal(
            matrix.home[span], matrix.begin[matrix.place[i]] + span - span[0]
        )
    for s in range(len(matrix.column) - 1):
        for q in range(matrix.below[s], matrix.below[s + 1]):
            at = matrix.lower[s] + matrix.offset[q]
            assert matrix.row[at] == matrix.begin[matrix.rows[q]]


def test_updates_that_wait_do_not_overlap():
    sizes, pairs, points = lattice_of_plates(1, 4, 6)
    matrix = analyse(sizes, pairs, points)
    ns = len(matrix.column) - 1
    parent = np.full(ns, ns)
    for s in range(ns):
        parent[matrix.child[matrix.child_start[s] : matrix.child_start[s + 1]]] = s
    r = np.diff(matrix.lower)
    room = (r + 11) // 12 * 12 * ((r + 3) // 4 * 4)
    for s in range(ns):
        for t in range(s):
            if parent[t] >= s:
                apart = matrix.update[s] >= matrix.update[t] + room[t]
                assert apart or matrix.update[s] + room[s] <= matrix.update[t]
    assert np.max(matrix.update + room) == matrix.updates.size


@pytest.mark.parametrize(("cells", "most"), [(1, 0.29e6), (3, 2.1e6)])
def test_the_fill_of_lattices_of_plates(cells, most):
    """24 walls of 6 x 18 quads on 16 joint lines; one cell is a tube."""
    matrix = analyse(*lattice_of_plates(cells, 6, 18))
    assert stored(matrix) < most


def test_walls_in_contact_are_dissected():
    """Minimum degree alone leaves more than a third more entries in the factor."""
    sizes, pairs, points = lattice_of_plates(3, 6, 18)
    points = folded(points, 0.2)
    pairs = np.vstack([pairs, near_pairs(points, 0.25)])
    start, of = neighbours(len(sizes), pairs)
    bits = minimum_degree.graph(len(sizes))
    for i, j in pairs:
        minimum_degree.connect(bits, i, j)
    order = minimum_degree.minimum_degree(bits)
    _, first, row = columns(start, of, order)
    weight = sizes[order]
    by_degree = (np.repeat(weight, np.diff(first)) * weight[row]).sum()
    assert by_degree > 1.33 * stored(analyse(sizes, pairs, points))
