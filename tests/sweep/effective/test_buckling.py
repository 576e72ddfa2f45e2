"""Buckling stresses against theory."""

import numpy as np
import pytest

from sweep.effective.buckling import buckling_stress, geometric_stiffness
from sweep.effective.cell import frame_of, infill_of
from tests.support.designs.slender import DEPTH, MODULUS, slender

RATIO = 0.01


def stress(kind, axis, ratio=RATIO):
    """The stress over E (t / l)^3."""
    frame = frame_of(infill_of(slender(kind, ratio)))
    return buckling_stress(frame, DEPTH, axis) / MODULUS / ratio**3


def work(d, frame, k, force, moments):
    """Work of constant N and M in the deformations of element k, of its coordinates d (6,)."""
    chord = frame.length[k] * frame.along[k] + d[3:5] - d[0:2]
    turned = np.arctan2(*chord[::-1]) - np.arctan2(*frame.along[k][::-1])
    turns = turned - d[[2, 5]]
    own, mixed = frame.arc[:, k]
    arc = own * turns @ turns + mixed * turns[0] * turns[1]
    strain = np.hypot(*chord) / frame.length[k] - 1.0 + arc
    return force * frame.length[k] * strain + moments @ turns


def test_geometric_stiffness_is_the_second_derivative_of_the_deformations():
    """Central differences, in units of the length of an element."""
    frame, random = frame_of(infill_of(slender("hex", 0.1))), np.random.default_rng(4)
    count = len(frame.length)
    force, moments = random.normal(size=count), 1e-3 * random.normal(size=(count, 2))
    found = geometric_stiffness(frame, force, moments.sum(axis=1))
    step = 1e-4
    for k in random.choice(count, 5, replace=False):
        unit = np.where(np.arange(6) % 3 == 2, 1.0, frame.length[k])
        moves = step * np.diag(unit)
        expected = np.empty((6, 6))
        for i, j in np.ndindex(6, 6):
            corners = [(a * moves[i] + b * moves[j], a * b) for a in (1, -1) for b in (1, -1)]
            values = [sign * work(d, frame, k, force[k], moments[k]) for d, sign in corners]
            expected[i, j] = sum(values) / (4 * step**2)
        scaled = found[k] * np.outer(unit, unit)
        np.testing.assert_allclose(scaled, expected, atol=1e-5 * np.abs(scaled).max())


def test_squares_sway_row_against_row():
    """A column whose ends sway and turn against two halves of beams, 6 E I / l each: w tan w = 3
    with w = sqrt(P l^2 / E I) / 2, by bisection.
    """
    low, high = 0.0, 0.5 * np.pi
    for _ in range(60):
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
