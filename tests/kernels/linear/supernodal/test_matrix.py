"""Places of blocks in the panels of supernodes, and entries that have no room."""

import numpy as np
import pytest

from kernels.linear.supernodal.analysis import analyse
from kernels.linear.supernodal.matrix import add_entry, clear, place, position
from tests.support.kernels.supernodes import random_blocks, random_dense

FAR = np.array([(0, 1), (1, 2), (3, 4)])  # two parts of a graph


def entries(matrix):
    """The array (n, n) by unknown that the panels hold."""
    n = matrix.home.size
    full = np.zeros((n, n))
    for i in range(n):
        for j in range(n):
            at = position(matrix, i, j)
            full[i, j] = matrix.values[at] if at >= 0 else 0.0
    return full


@pytest.mark.parametrize("seed", range(4))
def test_entries_are_kept_and_counted_once(seed):
    rng = np.random.default_rng(seed)
    sizes, pairs, points = random_blocks(rng, 20, 0.1)
    full = random_dense(rng, sizes, pairs)
    matrix = analyse(sizes, pairs, points)
    for i, j in np.argwhere(np.tril(full)):
        ends = (i, j) if rng.uniform() < 0.5 else (j, i)
        add_entry(matrix, *ends, full[i, j])
    np.testing.assert_array_equal(entries(matrix), full)
    clear(matrix)
    assert not entries(matrix).any()


def test_what_has_no_room_is_missing_until_it_is_analysed():
    sizes, points = np.array([3, 1, 6, 2, 4]), np.zeros((5, 3))
    matrix = analyse(sizes, FAR, points)
    assert place(matrix, 0, 4)[0] == -1
    before = matrix.values.copy()
    add_entry(matrix, 0, matrix.first[4], 1.0)
    assert matrix.missing[0] == 1
    np.testing.assert_array_equal(matrix.values, before)
    clear(matrix)
    assert matrix.missing[0] == 0
    matrix = analyse(sizes, np.vstack([FAR, (4, 0)]), points)
    assert place(matrix, 0, 4)[0] >= 0
    add_entry(matrix, 0, matrix.first[4], 1.0)
    assert matrix.missing[0] == 0
