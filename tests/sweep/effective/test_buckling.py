"""Buckling stresses against theory."""

import numpy as np
import pytest

from sweep.effective.buckling import buckling_stress
from sweep.effective.cell import frame_of, infill_of
from tests.support.designs.slender import DEPTH, MODULUS, slender

RATIO = 0.01


def stress(kind, axis, ratio=RATIO):
    """The stress over E (t / l)^3."""
    frame = frame_of(infill_of(slender(kind, ratio)))
    return buckling_stress(frame, DEPTH, axis) / MODULUS / ratio**3


def test_squares_sway_row_against_row():
    """Columns with elastic ends that sway: w tan w = 6 with w = sqrt(P l^2 / E I) / 2 ..."""
    low, high = 0.0, 0.5 * np.pi
    for _ in range(60):  # bisection: P of a column whose ends two beams of 6 E I / l hold
        w = 0.5 * (low + high)
        low, high = (w, high) if w * np.tan(w) < 3.0 else (low, w)
    expected = 4.0 * low**2 / 12.0
    assert stress("square", 1) == pytest.approx(expected, rel=1e-3)
    assert stress("square", 0) == pytest.approx(expected, rel=1e-3)


def test_hexagons_and_triangles_buckle_as_published():
    """docs/published.md has the sources: 0.211 along walls, 2.88 across horizontal lines."""
    assert stress("hex", 1) == pytest.approx(0.211, rel=5e-3)
    assert stress("triangle", 1) == pytest.approx(2.88, rel=5e-3)


def test_slender_walls_buckle_in_proportion_to_the_cube_of_their_thickness():
    assert stress("hex", 1, 0.005) == pytest.approx(stress("hex", 1, 0.01), rel=1e-3)
