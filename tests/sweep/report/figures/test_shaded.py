"""Plates as a camera sees them: order in depth, light, and scale."""

import numpy as np
import pytest

from sweep.report.figures.shaded import AMBIENT, LIGHT, cut_open, faces, platen, seen
from tests.support.results.specimens import tube


def test_screen_and_depth_are_a_rotation_that_leaves_up_upwards():
    points = np.random.default_rng(1).normal(size=(20, 3))
    screen, near = seen(points)
    lengths = np.linalg.norm(points, axis=1)
    assert np.hypot(np.linalg.norm(screen, axis=1), near) == pytest.approx(lengths)
    (_, up), _ = seen(np.array([[0.0, 0, 1.0], [0.0, 0, 0]]))[0]
    assert 0.5 < up < 1.0
    assert seen(np.array([[0.0, 0, 1.0]]))[0][0, 0] == pytest.approx(0.0)


def test_faces_are_drawn_from_back_to_front():
    frames = tube()
    found = faces(frames["position_m"][0], frames["quads"])
    middle = frames["position_m"][0][frames["quads"]].mean(axis=1)
    order = np.argsort(seen(middle)[1])
    corners = seen(frames["position_m"][0])[0][frames["quads"]][order]
    np.testing.assert_allclose(found.corners, corners)


def test_a_face_is_brightest_towards_the_light_on_either_side():
    toward = LIGHT / np.linalg.norm(LIGHT)
    one = np.cross(toward, [0.0, 0.0, 1.0])
    other = np.cross(toward, one)
    square = np.array([np.zeros(3), one, one + other, other])
    edgewise = np.array([np.zeros(3), toward, toward + one, one])
    shades = [
        faces(points, np.array([corners])).shades[0]
        for points in (square, edgewise)
        for corners in ([0, 1, 2, 3], [3, 2, 1, 0])
    ]
    assert shades == pytest.approx([1.0, 1.0, AMBIENT, AMBIENT])


def test_platen_is_as_wide_as_the_plan_and_its_margin():
    ring = platen(np.array([[0.0, 0.0], [2.0, 1.0]]), 3.0, 0.5)
    corners = seen(np.array([[-0.5, -0.5, 3.0], [2.5, -0.5, 3.0], [2.5, 1.5, 3], [-0.5, 1.5, 3]]))
    np.testing.assert_allclose(ring, corners[0])


def test_half_of_a_tube_is_cut_away():
    """Two of its four walls are behind the middle."""
    left = cut_open(tube())
    assert len(left["quads"]) == len(left["quad_thickness_m"]) == 2
    near = seen(tube()["position_m"][0][tube()["quads"]].mean(axis=1))[1]
    kept = [tube()["quads"].tolist().index(quad) for quad in left["quads"].tolist()]
    assert set(kept) == set(np.argsort(near)[:2])
