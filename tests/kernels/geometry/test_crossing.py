"""Crossings of elements: certain ones are counted, pairs within round-off are passed on.

The exact check of these pairs is tested in tests/sweep/simulation/test_shape_checks.py.
"""

import numpy as np
import pytest

from kernels.geometry import crossing

CROSS = [[-1, -1], [1, 1], [-1, 1], [1, -1]]
PAIR = np.array([[0, 1], [2, 3]])


def counted(shapes, edges=PAIR, room=8):
    """Sure crossings of each shape (f, n, 2), and pairs with their shape to look at closely."""
    at = np.moveaxis(np.array(shapes, float), 0, -1).transpose(1, 0, 2).copy()
    ends = at[:, edges].transpose(1, 0, 2, 3).reshape(len(edges), 2, -1)
    low, high = ends.min(axis=2), ends.max(axis=2)
    order = np.argsort(low[:, 0])
    crossed, unsure = np.full(at.shape[2], 7), np.full((room, 3), -1)
    found = crossing.count(at, low, high, order, edges, crossed, unsure)
    return crossed.tolist(), found, [set(row[:2]) | {("shape", row[2])} for row in unsure[:found]]


def test_each_shape_has_its_own_crossings():
    apart = [[-1, -1], [1, 1], [2, 1], [3, -1]]
    crossed, found, _ = counted([CROSS, apart, CROSS])
    assert (crossed, found) == ([1, 0, 1], 0)


@pytest.mark.parametrize(
    "shape",
    [
        [[0, 0], [2, 0], [1, 0], [1, 1]],  # an end on the other element
        [[0, 0], [2, 0], [1, 0], [3, 0]],  # along one another
        [[0, 0], [2, 2], [2, 2], [3, 0]],  # ends that coincide
        [[0, 0], [0.3, 0.1], [0.15, 0.05], [1, 1]],  # to within rounding
        [[0, 0], [0, 0], [0, 0], [1, 1]],  # without length
    ],
)
def test_what_touches_is_looked_at_again(shape):
    crossed, found, undecided = counted([CROSS, shape])
    assert (crossed, found) == ([1, 0], 1)
    assert undecided == [{0, 1, ("shape", 1)}]


@pytest.mark.parametrize(
    "shape",
    [
        [[0, 0], [2, 0], [1, 1e-6], [1, 1]],  # just above
        [[0, 0], [3, 3], [1, 2], [0, 3]],  # boxes overlap
        [[0, 0], [1, 0], [2, -1], [2, 1]],  # would meet if longer
    ],
)
def test_what_is_apart_is_neither(shape):
    assert counted([shape])[:2] == ([0], 0)


def test_elements_with_a_common_node_never_cross():
    fan = np.array([[0, 1], [1, 2], [2, 0], [3, 1]])
    assert counted([CROSS], fan[[0, 1, 3]])[:2] == ([0], 0)


def test_more_than_there_is_room_for_are_counted_all_the_same():
    touching = [[0, 0], [2, 0], [1, 0], [1, 1]]
    assert counted([touching] * 5, room=2)[1] == 5


def test_random_elements_cross_as_often_as_their_sides_say():
    random = np.random.default_rng(8)
    shapes, edges = random.random((3, 24, 2)), np.arange(24).reshape(12, 2)

    def side(p, q, r):
        return np.sign((q[0] - p[0]) * (r[1] - p[1]) - (q[1] - p[1]) * (r[0] - p[0]))

    expected = [
        sum(
            side(*s[a], s[b[0]]) != side(*s[a], s[b[1]])
            and side(*s[b], s[a[0]]) != side(*s[b], s[a[1]])
            for k, a in enumerate(edges)
            for b in edges[:k]
        )
        for s in shapes
    ]
    assert min(expected) > 5
    assert counted(shapes, edges)[:2] == (expected, 0)
