"""A piece of a panel: cut along its sides, whole where it was, and periodic."""

import numpy as np
import pytest

from sweep.report.figures.panel_piece import START, piece, places
from tests.support.results.specimens import tube

ROW = {"sides": "tied, fixed period", "outer_width_m": 2.0, "depth_m": 3.0}


def sheet(n=4):
    """A level sheet of n x n quads, which moves by a wave of one period; images are not merged."""
    corner = np.array([[0, 0], [1, 0], [1, 1], [0, 1]])
    at = (np.indices((n, n)).reshape(2, -1).T[:, None] + corner + 0.3) / n * [2.0, 3.0]
    rest = np.dstack([at, np.zeros((n * n, 4, 1))]).reshape(-1, 3)
    wave = np.sin(np.pi * rest[:, :1]) * np.cos(2.0 / 3.0 * np.pi * rest[:, 1:2])
    return {
        "position_m": np.stack([rest, rest + wave * [0.1, 0.2, 0.4]]),
        "quads": np.arange(4 * n * n).reshape(-1, 4),
        "quad_thickness_m": np.arange(1.0, 1.0 + n * n),
    }


def areas(position, quads):
    one, two = (position[quads[:, k + 2]] - position[quads[:, k]] for k in (0, 1))
    return 0.5 * np.cross(one, two)[:, 2]


@pytest.mark.parametrize("times", [1, 2])
def test_a_piece_fills_its_rectangle_without_overlap(times):
    found = piece(sheet(), ROW, times)
    at, period = found["position_m"][0], np.array([2.0, 3.0])
    np.testing.assert_allclose(at.min(axis=0)[:2], START * period, atol=1e-12)
    np.testing.assert_allclose(at.max(axis=0)[:2], (START + times) * period, atol=1e-12)
    each = areas(at, found["quads"])
    assert each.min() > 0.0
    assert each.sum() == pytest.approx(6.0 * times**2)
    assert set(found["quad_thickness_m"]) == set(sheet()["quad_thickness_m"])
    assert len(np.unique(found["quads"])) == len(at) < len(found["quads"]) * 4


def test_what_is_cut_moves_with_its_quad_and_fits_its_neighbours():
    """Opposite sides of a period move alike."""
    frames, found = sheet(), piece(sheet(), ROW, 1)
    rest, moved = found["position_m"]
    at, period = rest[:, :2], np.array([2.0, 3.0])
    low, high = (np.isclose(at[:, 0], (START + side) * period[0]) for side in (0, 1))
    order = [np.flatnonzero(side)[at[side, 1].argsort()] for side in (low, high)]
    shifts = (moved - rest)[order[0]], (moved - rest)[order[1]]
    assert len(order[0]) > 4
    np.testing.assert_allclose(*shifts, atol=1e-12)
    whole = np.ptp(frames["position_m"][1, :, 2])
    assert 0.8 * whole < np.ptp(moved[:, 2]) <= whole


def test_a_corner_that_is_cut_off_leaves_five_corners():
    """A quad that is turned: the part beyond a side is a triangle, the rest a pentagon."""
    ring = np.array([[1.7, 2.775, 0.0], [2.3, 3.375, 0.0], [1.7, 3.975, 0.0], [1.1, 3.375, 0.0]])
    turned = {"position_m": ring[None], "quads": np.arange(4)[None]}
    found = piece(turned | {"quad_thickness_m": np.ones(1)}, ROW, 1)
    assert areas(found["position_m"][0], found["quads"]).sum() == pytest.approx(0.72)
    assert len(found["quads"]) == 3


def test_what_does_not_repeat_is_left_as_it_is():
    frames = tube()
    assert piece(frames, {"sides": "free"}) is frames
    assert places({"sides": "free"}).tolist() == [[0.0, 0.0]]
    assert places(ROW, 2).tolist() == [[0.0, 0.0], [0.0, 3.0], [2.0, 0.0], [2.0, 3.0]]
