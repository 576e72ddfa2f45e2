"""Places of blocks in the panels of supernodes, and entries that have no room."""

import numpy as np
import pytest

from kernels.linear.supernodal.analysis import analyse
from kernels.linear.supernodal.matrix import (
    add,
    add_element,
    add_entry,
    clear,
    place,
    places,
    position,
    scatter,
)
from tests.support.kernels.supernodes import assembled, random_blocks, random_dense

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
def test_blocks_are_kept(seed):
    rng = np.random.default_rng(seed)
    sizes, pairs, points = random_blocks(rng, 20, 0.1)
    full, spans = random_dense(rng, sizes, pairs)
    matrix = assembled(sizes, pairs, points, full, spans)
    np.testing.assert_array_equal(entries(matrix), full)


@pytest.mark.parametrize("seed", range(4))
def test_entries_are_kept_and_counted_once(seed):
    rng = np.random.default_rng(seed)
    sizes, pairs, points = random_blocks(rng, 20, 0.1)
    full, _ = random_dense(rng, sizes, pairs)
    matrix = analyse(sizes, pairs, points)
    for i, j in np.argwhere(np.tril(full)):
        ends = (i, j) if rng.uniform() < 0.5 else (j, i)
        add_entry(matrix, *ends, full[i, j])
    np.testing.assert_array_equal(entries(matrix), full)
    clear(matrix)
    assert not entries(matrix).any()


def test_a_block_and_its_mirror_are_the_same_memory():
    rng = np.random.default_rng(2)
    sizes, pairs, points = random_blocks(rng, 12, 0.2)
    matrix = analyse(sizes, pairs, points)
    for i, j in pairs:
        at, down, across = place(matrix, i, j)
        assert (at, across, down) == place(matrix, j, i)
        assert 1 in (down, across)
        assert at == position(matrix, matrix.first[i], matrix.first[j])


def test_a_part_of_an_element_matrix():
    """Rows and columns of a larger array go to a block whose place is known."""
    rng = np.random.default_rng(5)
    sizes = np.array([5, 6])
    matrix = analyse(sizes, np.array([(0, 1)]), np.zeros((2, 3)))
    element = rng.uniform(size=(24, 24))
    scatter(matrix, place(matrix, 0, 1), element, 6, 12, 5, 6)
    scatter(matrix, place(matrix, 1, 0), element.T.copy(), 12, 6, 6, 5)
    np.testing.assert_array_equal(entries(matrix)[:5, 5:], 2.0 * element[6:11, 12:18])


def test_elements_of_four_nodes():
    """Nodes with five, six, two and no unknowns, the first of which is not that of the array."""
    rng = np.random.default_rng(6)
    sizes = np.array([5, 6, 2, 1])
    blocks = np.array([(2, 0, 1, 3), (1, 0, 2, 3)])
    pairs = np.array([(i, j) for i in range(3) for j in range(i)])
    matrix = analyse(sizes, pairs, rng.uniform(size=(4, 3)))
    found, expected = places(matrix, blocks), np.zeros((14, 14))
    lead, ends = np.array([0, 0, 3, 0]), np.cumsum(sizes)
    for e, nodes in enumerate(blocks):
        part = rng.uniform(size=(24, 24))
        part += part.T
        first, count = 6 * np.arange(4) + lead[nodes], np.where(nodes < 3, sizes[nodes], 0)
        add_element(matrix, found[e], part, first, count)
        rows = np.concatenate([f + np.arange(c) for f, c in zip(first, count, strict=True)])
        of = [ends[i] - sizes[i] + np.arange(c) for i, c in zip(nodes, count, strict=True)]
        of = np.concatenate(of).astype(int)
        expected[np.ix_(of, of)] += part[np.ix_(rows, rows)]
    np.testing.assert_allclose(entries(matrix), expected, rtol=1e-15)
    assert matrix.missing[0] == 0
    add_element(matrix, found[0], part, first, np.ones(4, int))
    assert matrix.missing[0] == 1


def test_what_has_no_room_is_missing_until_it_is_analysed():
    sizes, points = np.array([3, 1, 6, 2, 4]), np.zeros((5, 3))
    matrix = analyse(sizes, FAR, points)
    assert place(matrix, 0, 4)[0] == -1
    before = matrix.values.copy()
    add(matrix, 4, 0, np.ones((4, 3)))
    assert matrix.missing[0] == 1
    np.testing.assert_array_equal(matrix.values, before)
    clear(matrix)
    assert matrix.missing[0] == 0
    add_entry(matrix, 0, matrix.first[4], 1.0)
    assert matrix.missing[0] == 1
    matrix = analyse(sizes, np.vstack([FAR, (4, 0)]), points)
    add(matrix, 4, 0, np.ones((4, 3)))
    assert matrix.missing[0] == 0
