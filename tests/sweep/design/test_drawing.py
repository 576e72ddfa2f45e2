"""Drawings: counted without drawing, clipped, outlined, welded."""

import numpy as np
import pytest

from sweep.design.drawing import (
    Sketch,
    counts,
    joints_and_walls,
    on_outline,
    sample,
    sketch,
    welded,
)
from tests.support.designs.infills import EDGES, KINDS, lattice_of


@pytest.mark.parametrize("edge", EDGES)
@pytest.mark.parametrize(("kind", "way"), KINDS)
def test_counts_are_known_without_drawing(kind, way, edge):
    lattice = lattice_of(kind, way, (13, 14), width=0.1, height=0.1, **EDGES[edge])
    drawn = sketch(lattice.geometry)
    assert counts(drawn) == tuple(map(len, joints_and_walls(drawn)))


@pytest.mark.parametrize(("kind", "way"), KINDS)
def test_an_outline_goes_all_round_and_nothing_lies_outside(kind, way):
    box = (0.03, 0.02)
    points, walls = joints_and_walls(Sketch(kind, way, (3, 2), box, closed=True, capped=True))
    assert points.min(axis=0).tolist() == [0.0, 0.0]
    assert points.max(axis=0).tolist() == list(box)
    lengths = np.linalg.norm(points[walls[:, 1]] - points[walls[:, 0]], axis=1)
    for axis in (0, 1):
        for side in (0.0, box[axis]):
            on = on_outline(points, walls, side, axis)
            assert lengths[on].sum() == pytest.approx(box[1 - axis], rel=1e-12)


def test_segments_that_meet_share_a_joint_and_doubles_are_one():
    line = np.array(
        [[[0.0, 0.0], [0.0, 1.0]], [[1e-12, 1.0], [2.0, 1.0]], [[2.0, 1.0], [0.0, 1.0]]]
    )
    points, walls = welded(line, 1e-9)
    np.testing.assert_allclose(points, [[0.0, 0.0], [0.0, 1.0], [2.0, 1.0]], atol=1e-11)
    assert walls.tolist() == [[1, 2], [0, 1]]  # the level one first


def test_a_sample_has_cells_of_the_same_size():
    drawn = sample(Sketch("hex", "pointy", (9, 2), (9.5, 3.0)))
    assert (drawn.cells, drawn.box) == ((4, 2), pytest.approx((4.5, 3.0)))
