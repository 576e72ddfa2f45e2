"""A drawing as walls of its thickness; curves are one wall, not one for each straight piece."""

import numpy as np
import pytest

from sweep.design.drawn import build_drawn, loose_ends
from sweep.design.geometry import Drawing


def chain(angles, shares=()):
    """Walls of unit length end to end, each turned further, in degrees."""
    along = np.radians(np.cumsum(angles))
    steps = np.column_stack([np.cos(along), np.sin(along)])
    joints = np.concatenate([[[0.0, 0.0]], np.cumsum(steps, axis=0)])
    walls = [(k, k + 1) for k in range(len(angles))]
    return Drawing(tuple(map(tuple, joints.tolist())), tuple(walls), shares)


def test_elements_of_a_bent_wall_are_shared_by_its_pieces():
    """Below 15 degrees two walls are one; a corner, or another thickness, ends it."""
    bent = build_drawn(chain([0, 10, 10, 10, 90, 14, 16]), 0.1)
    assert bent.part == pytest.approx([0.25] * 4 + [0.5] * 2 + [1.0])
    assert bent.pieces(8).tolist() == [2] * 4 + [4] * 2 + [8]
    assert bent.pieces(1).tolist() == [1] * 7
    stepped = build_drawn(chain([0, 10, 10], (1.0, 1.0, 2.0)), 0.1)
    assert stepped.part == pytest.approx([0.5, 0.5, 1.0])
    assert stepped.wall_thickness == pytest.approx([0.1, 0.1, 0.2])


def test_a_wall_ends_where_a_third_one_meets_it():
    """A closed ring has no end; with a spoke it has one."""
    ring = chain([0, *[36] * 9])
    joints = (*ring.joints[:-1], (0.5, 1.5))
    closed = (*ring.walls[:-1], (9, 0))
    assert build_drawn(Drawing(joints[:-1], closed), 0.1).part == pytest.approx([1.0] * 10)
    even = chain([0, *[10] * 35])
    walls = (*even.walls[:-1], (35, 0))
    assert build_drawn(Drawing(even.joints[:-1], walls), 0.1).part == pytest.approx([1 / 36] * 36)
    spoke = Drawing((*even.joints[:-1], (0.0, 3.0)), (*walls, (0, 36)))
    assert build_drawn(spoke, 0.1).part == pytest.approx([1 / 36] * 36 + [1.0])


def test_ends_between_the_rows_are_loose():
    """Ends that stand on a platen are not."""
    joints = ((0.0, 0.0), (2.0, 0.0), (0.0, 2.0), (2.0, 2.0), (1.0, 1.0))
    network = build_drawn(Drawing(joints, ((0, 2), (1, 3), (0, 1), (0, 4))), 0.1)
    assert loose_ends(network).tolist() == [4]
    assert network.bottom.tolist() == [0, 1]
    assert network.top.tolist() == [2, 3]
