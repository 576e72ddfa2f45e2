"""Chains and outlines of rigid profiles."""

from itertools import pairwise

import numpy as np
import pytest
from shapely import Point, Polygon

from sweep.design.profile import circle, hull, punch, rib, wedge

SHAPES = {
    "round": circle(2.0, 1.5),
    "edge": wedge(2.0, 1.0, 0.4, 9.0),
    "sharp": wedge(2.0, 1.0, 0.0, 9.0),
    "punch": punch(2.0, 3.0, 0.5, 9.0),
    "rib": rib(2.0, 0.6, 9.0).upside_down(),
}


@pytest.mark.parametrize("shape", SHAPES)
def test_the_tip_is_at_zero_in_the_middle(shape):
    outline = SHAPES[shape].outline()
    assert outline[:, 1].min() == pytest.approx(0.0, abs=1e-12)
    assert 0.5 * (outline[:, 0].min() + outline[:, 0].max()) == pytest.approx(2.0)
    assert Polygon(outline).is_valid
    assert Polygon(outline).contains(Point(2.0, 1.0))


def test_widths_and_angles():
    assert np.ptp(SHAPES["punch"].outline()[:, 0]) == pytest.approx(3.0)
    assert np.ptp(SHAPES["rib"].outline()[:, 0]) == pytest.approx(1.2)
    assert np.ptp(SHAPES["round"].outline(), axis=0) == pytest.approx([3.0, 3.0])
    left, tip, right = SHAPES["sharp"].chain
    one, other = left - tip, right - tip
    assert one @ other / (np.linalg.norm(one) * np.linalg.norm(other)) == pytest.approx(np.cos(1.0))


@pytest.mark.parametrize("shape", ["edge", "punch"])
def test_what_a_chain_encloses_is_on_its_left(shape):
    for a, b in pairwise(SHAPES[shape].chain):
        along, inward = b - a, np.array([2.0, 1.0]) - a
        assert along[0] * inward[1] - along[1] * inward[0] > 0.0


def test_the_hull_of_a_grid_is_its_corners():
    grid = np.array([(i, j) for i in range(4) for j in range(3)], float)
    assert hull(grid).tolist() == [[0, 0], [3, 0], [3, 2], [0, 2]]


def test_a_rib_points_up_from_below():
    assert rib(0.0, 1.0, 5.0).outline()[:, 1].max() == pytest.approx(0.0, abs=1e-12)
