"""Intervals: kept in order, and measured together."""

import numpy as np
import pytest

from kernels.geometry.intervals import covered, insert

LEFT, RIGHT = np.array([0.0, 1.0, 1.5, 5.0, 5.0]), np.array([2.0, 3.0, 1.75, 5.0, 6.0])


@pytest.mark.parametrize(
    ("first", "last", "length"),
    [(0, 0, 0.0), (0, 1, 2.0), (0, 2, 3.0), (0, 3, 3.0), (0, 5, 4.0), (2, 5, 1.25)],
)
def test_what_overlaps_is_counted_once(first, last, length):
    assert covered(LEFT, RIGHT, first, last) == pytest.approx(length)


def test_an_interval_that_ends_before_it_begins_covers_nothing():
    assert covered(np.array([0.0, 1.0]), np.array([1.0, 0.5]), 0, 2) == 1.0


@pytest.mark.parametrize("first", [0, 2])
def test_each_finds_its_place_behind_the_first(first):
    """Equal ones keep the order in which they come; those before the first are left alone."""
    left, right = np.full(8, 9.0), np.full(8, 9.0)
    begins, places = [3.0, 1.0, 2.0, 1.0, 5.0], []
    for k, begin in enumerate(begins):
        places.append(insert(left, right, first + k, first, begin, float(k)) - first)
    assert places == [0, 0, 1, 1, 4]
    assert left[first : first + 5].tolist() == [1.0, 1.0, 2.0, 3.0, 5.0]
    assert right[first : first + 5].tolist() == [1.0, 3.0, 2.0, 0.0, 4.0]
    assert (left[:first] == 9.0).all()


def test_random_intervals_cover_what_a_fine_grid_says():
    random = np.random.default_rng(2)
    left, right = np.empty(30), np.empty(30)
    for k, (begin, size) in enumerate(random.integers(0, [1000, 40], (30, 2))):
        insert(left, right, k, 0, float(begin), float(begin + size))
    cells = np.arange(1100) + 0.5
    inside = ((left[:, None] < cells) & (cells < right[:, None])).any(axis=0)
    assert covered(left, right, 0, 30) == inside.sum() < (right - left).sum()
