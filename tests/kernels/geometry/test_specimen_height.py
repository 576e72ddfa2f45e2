"""How high a lattice stands: between the means of two rows, or as a caliper reads it."""

import numpy as np
import pytest

from kernels.geometry.specimen_height import height

X = np.array([9.0, 1.0, 7.0, -2.0, 5.0, 4.0, 3.0, 6.0])
NONE = np.empty(0, np.int64)


def test_height_is_between_the_means_of_both_rows():
    assert height(X, np.array([5, 7]), np.array([1, 3])) == pytest.approx(5.0 - (-0.5))


def test_without_a_top_it_is_the_extent_of_the_base():
    assert height(X, NONE, np.array([1, 3, 5, 7])) == 8.0
    assert height(X, NONE, np.array([3])) == 0.0


def test_it_does_not_depend_on_where_the_specimen_is():
    for top, base in ((np.array([5, 7]), np.array([1, 3])), (NONE, np.array([1, 3, 5]))):
        assert height(X + 64.0, top, base) == height(X, top, base)
