"""Loops over arrays: the same results as numpy."""

import numpy as np
import pytest

from kernels import arrays

ROWS = np.array([[3, 1, 2], [7, 5, 6]])


@pytest.fixture
def vectors():
    return np.random.default_rng(0).uniform(-1, 1, (2, 9))


def test_rows_are_tuples():
    assert arrays.pair(ROWS, 1) == (7, 5)
    assert arrays.triple(ROWS, 0) == (3, 1, 2)


def test_vectors_are_copied_added_and_cleared(vectors):
    one, other = vectors
    to, expected = one.copy(), one + other
    arrays.add(other, to)
    np.testing.assert_array_equal(to, expected)
    arrays.copy(other, to)
    np.testing.assert_array_equal(to, other)
    arrays.zero(to)
    assert not to.any()
    arrays.zero_rows(vectors)
    assert not vectors.any()


@pytest.mark.parametrize("value", [-1.0, 0.0, 0.5, 2.0, 3.5, 4.0, 9.0])
def test_places_among_ascending_numbers(value):
    """The same places as by bisection, of the whole or of a part; a piece lies between the
    bounds.
    """
    ascending = np.array([0.0, 1.0, 2.0, 2.0, 3.5, 4.0])
    for low, high in ((0, 6), (1, 4), (3, 3)):
        expected = low + np.searchsorted(ascending[low:high], value)
        assert arrays.first_at_least(ascending, value, low, high) == expected
    bounds = np.unique(ascending)
    inside = np.clip(np.searchsorted(bounds, value, side="right") - 1, 0, len(bounds) - 2)
    assert arrays.piece(bounds, value) == inside


def test_sums_and_the_largest(vectors):
    one, other = vectors
    assert arrays.dot(one, other) == pytest.approx(one @ other, rel=1e-13)
    assert arrays.total(one) == pytest.approx(one.sum(), rel=1e-13)
    assert arrays.greatest(one) == one.max() > 0.0
    assert arrays.greatest(-np.abs(one)) == arrays.greatest(one[:0]) == 0.0


@pytest.mark.parametrize("group", [[2, 0, 2, 3, 0, 2], [1, 1], []])
def test_members_are_grouped_in_their_order(group):
    start, order = arrays.grouped(np.array(group, np.int64), 5)
    np.testing.assert_array_equal(order, np.argsort(group, kind="stable"))
    np.testing.assert_array_equal(np.diff(start), np.bincount(np.array(group, int), minlength=5))
