"""Analysis: order, fill of lattices of plates, and memory."""

import numpy as np
import pytest

from kernels.linear import minimum_degree
from kernels.linear.supernodal.analysis import analyse
from kernels.linear.supernodal.dissection import neighbours
from kernels.linear.supernodal.symbolic import columns
from tests.support.kernels.wall_graph import folded, lattice_of_plates, near_pairs


def stored(matrix):
    """Entries of the lower half of all panels."""
    w, r = np.diff(matrix.column), np.diff(matrix.lower)
    return (w * (w + 1) // 2 + w * r).sum()


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
