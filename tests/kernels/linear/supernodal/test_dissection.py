"""Nested dissection: an order with separators that are small."""

import numpy as np
import pytest

from kernels.linear.supernodal.dissection import SMALLEST, dissect, neighbours
from kernels.linear.supernodal.symbolic import columns
from tests.support.kernels.wall_graph import lattice_of_plates


@pytest.mark.parametrize("axis", range(3))
def test_a_long_grid_is_cut_across(axis):
    """The last blocks are a plane of 3 x 4 blocks that separates both halves."""
    shape = np.insert([3, 4], axis, 30)
    points = np.ascontiguousarray(np.argwhere(np.ones(shape)), float)
    near = np.abs(points[:, None] - points[None]).max(axis=2) == 1.0
    pairs = np.ascontiguousarray(np.argwhere(near))
    order = dissect(*neighbours(len(points), pairs), np.full(360, 3), points)
    along = points[order][:, axis]
    assert np.ptp(along[-12:]) == 0.0
    assert abs(along[-1] - 14.5) < 30 / 4
    first = along < along[-1]
    assert abs(np.diff(first[:-12].astype(int))).sum() == 1


def test_blocks_of_the_same_position_are_not_cut():
    n = 4 * SMALLEST
    pairs = np.ascontiguousarray(np.argwhere(np.tri(n, k=-1)))
    order = dissect(*neighbours(n, pairs), np.ones(n, int), np.zeros((n, 3)))
    np.testing.assert_array_equal(np.sort(order), np.arange(n))


def test_a_crowded_block_is_the_last():
    sizes, pairs, points = lattice_of_plates(1, 6, 12)
    n = len(sizes)
    pairs = np.vstack([pairs, [(i, n) for i in range(n)]])
    points = np.vstack([points, points[:1]])
    order = dissect(*neighbours(n + 1, pairs), np.append(sizes, 1), points)
    assert order[-1] == n


def test_the_fill_of_a_lattice_grows_as_that_of_a_plate():
    """Entries of the factor per block grow with the logarithm of the number of blocks."""
    per_block = []
    for quads in (4, 8, 16):
        sizes, pairs, points = lattice_of_plates(1, quads, 2 * quads)
        start, near = neighbours(len(sizes), pairs)
        _, first, _ = columns(start, near, dissect(start, near, sizes, points))
        per_block.append(first[-1] / len(sizes))
    assert np.all(np.diff(per_block) < 12.0)
