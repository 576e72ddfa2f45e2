"""Curves become straight pieces that turn evenly; straight curves stay one piece."""

from math import cos, pi, tan

import numpy as np
import pytest

from sweep.config.drawings import curves
from sweep.config.drawings.curves import TURN, straightened, without_marks
from sweep.config.faults import MisfitError

K = 4.0 / 3.0 * tan(pi / 8.0)
QUARTER = np.array([[1.0, 0.0], [1.0, K], [K, 1.0], [0.0, 1.0]])


def test_an_arc_turns_by_equal_angles_of_less_than_twelve_degrees():
    pieces = straightened([QUARTER])
    assert len(pieces) == 8
    np.testing.assert_array_equal(pieces[[0, -1], [0, 1]], [[1.0, 0.0], [0.0, 1.0]])
    along = np.diff(pieces, axis=1)[:, 0]
    turned = np.diff(np.unwrap(np.arctan2(along[:, 1], along[:, 0])))
    assert turned == pytest.approx(0.5 * pi / 8, rel=0.02)
    middle = np.linalg.norm(pieces.mean(axis=1), axis=1)
    assert middle == pytest.approx(cos(0.5 * 0.5 * pi / 8), rel=1e-3)
    assert middle.min() > 1.0 - 0.006


def test_straight_curves_are_one_piece_and_sharp_ones_end_where_they_end():
    line = np.array([[0.0, 0.0], [3.0, 1.0]])
    even = np.array([[0.0, 0.0], [1.0, 1.0], [2.0, 2.0], [3.0, 3.0]])
    assert straightened([line, even]).tolist() == [line.tolist(), even[[0, -1]].tolist()]
    wave = np.array([[0.0, 0.0], [4.0, 3.0], [-1.0, 3.0], [3.0, 0.0]])
    pieces = straightened([wave])
    np.testing.assert_array_equal(pieces[1:, 0], pieces[:-1, 1])
    along = np.diff(pieces, axis=1)[:, 0]
    turned = np.diff(np.unwrap(np.arctan2(along[:, 1], along[:, 0])))
    assert np.abs(turned).max() < 1.5 * TURN
    dot = np.zeros((4, 2))
    assert straightened([dot]).tolist() == [[[0.0, 0.0], [0.0, 0.0]]]


def test_too_many_and_endless_numbers_are_refused(monkeypatch):
    monkeypatch.setattr(curves, "MOST_LINES", 100)
    with pytest.raises(MisfitError, match="more than 100 straight lines"):
        straightened([QUARTER] * 13)
    with pytest.raises(MisfitError, match="no finite numbers"):
        straightened([np.array([[0.0, 0.0], [np.nan, 1.0]])])


def circle(centre, radius, pieces=32):
    angle = np.linspace(0.0, 2.0 * np.pi, pieces + 1)
    at = centre + radius * np.stack([np.cos(angle), np.sin(angle)], axis=1)
    return np.stack([at[:-1], at[1:]], axis=1)


LINES = np.array([[[0.0, 0.0], [10.0, 0.0]], [[10.0, 0.0], [10.0, 8.0]]])


@pytest.mark.parametrize(
    "ring",
    [
        circle([10.0, 0.0], 2.1),  # above a quarter of the shorter line
        circle([5.0, 0.0], 1.0),  # no end
        circle([0.0, 0.0], 1.0, pieces=6),  # a hexagon
        circle([0.0, 0.0], 1.0)[:-1],  # open
        circle([0.0, 0.0], 1.0) * [1.5, 1.0],  # an ellipse
    ],
)
def test_other_rings_are_walls(ring):
    ends, notes = without_marks(np.concatenate([LINES, ring]))
    assert (len(ends), notes) == (len(LINES) + len(ring), [])
