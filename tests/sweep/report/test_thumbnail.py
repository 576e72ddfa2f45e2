"""Small drawings: their lines, their size, and omitted drawings."""

import re

import numpy as np
import pytest

from sweep.report import thumbnail as module
from sweep.report.thumbnail import SIZE, thumbnail
from tests.support.results.specimens import squeezed_cell, tube


def lines(svg):
    """Ends of the lines of an SVG (n, 2, 2)."""
    numbers = re.findall(r"M(\S+) (\S+)L(\S+) (\S+?)(?=M|\")", svg)
    return np.array(numbers, dtype=float).reshape(-1, 2, 2)


def test_the_shape_at_rest_is_drawn():
    drawn = lines(thumbnail(squeezed_cell()))
    assert len(drawn) == 4
    assert np.ptp(drawn[..., 0]) == np.ptp(drawn[..., 1]) == SIZE - 2


def test_elements_of_a_straight_wall_are_one_line():
    """A cross with arms of three elements each, and a kinked wall next to it."""
    arms = [[k * x, k * y] for x, y in ((1, 0), (0, 1), (-1, 0), (0, -1)) for k in (1, 2, 3)]
    kinked = [[5, 0], [6, 0], [6.5, 1]]
    edges = [edge for a in (1, 4, 7, 10) for edge in ((0, a), (a, a + 1), (a + 1, a + 2))]
    edges += [(13, 14), (14, 15)]
    points = np.array([[0, 0], *arms, *kinked], float)
    drawn = lines(thumbnail({"position_m": points[None], "edges": np.array(edges)}))
    assert len(drawn) == 6
    lengths = np.sort(np.linalg.norm(drawn[:, 1] - drawn[:, 0], axis=1))
    assert lengths[-1] == pytest.approx(3 * lengths[0], rel=0.05)


def test_a_drawing_stands_upright():
    points = np.array([[0, 0], [0, 1], [1, 0]], float)
    drawn = lines(thumbnail({"position_m": points[None], "edges": np.array([[0, 1], [0, 2]])}))
    (upright,) = [line for line in drawn if line[0, 0] == line[1, 0]]
    assert upright[0, 1] > upright[1, 1]  # y of SVG points down


def test_of_a_print_that_stands_its_plan_is_drawn():
    drawn = lines(thumbnail(tube()))
    assert len(drawn) == 4
    assert np.ptp(drawn[..., 0]) == np.ptp(drawn[..., 1])


def test_nothing_and_too_much_are_left_out(monkeypatch):
    assert thumbnail({}) == ""
    monkeypatch.setattr(module, "MOST", 3)
    assert thumbnail(squeezed_cell()) == ""
