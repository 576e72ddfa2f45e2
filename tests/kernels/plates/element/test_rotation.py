"""Directors: their rotation, its derivatives, and frames that take it over."""

import numpy as np
import pytest

from kernels.plates.element import rotation
from tests.support.kernels.terms import differences

STATES = [(0.0, 0.0, 0.0), (1e-9, 0.0, 0.0), (0.1, -0.2, 0.05), (0.9, 0.4, -1.1), (0.0, 3.0, 0.0)]
DIRECTORS = [(0.0, 0.0, 1.0), (0.6, 0.0, -0.8), (-0.48, 0.64, 0.6)]


def frame(seed=3):
    """A random rotation (9,)."""
    q, r = np.linalg.qr(np.random.default_rng(seed).normal(size=(3, 3)))
    q *= np.sign(np.diag(r))
    return (q * np.sign(np.linalg.det(q))).ravel()


def matrix(w):
    """R(w) column by column."""
    return np.array([rotation.turned(tuple(w), tuple(e)) for e in np.eye(3)]).T


@pytest.mark.parametrize("axis", [(0.0, 0.0, 1.0), (0.6, -0.8, 0.0)])
@pytest.mark.parametrize("angle", [0.0, 0.3, 2.0, -3.0, 4.5])
def test_the_tangent_of_a_quarter_of_the_angle(axis, angle):
    """Rodrigues' formula."""
    n = np.array(axis)
    turn = np.cross(n, np.eye(3)).T  # v -> n x v
    expected = np.eye(3) + np.sin(angle) * turn + (1 - np.cos(angle)) * turn @ turn
    np.testing.assert_allclose(matrix(np.tan(0.25 * angle) * n), expected, atol=1e-14)


@pytest.mark.parametrize("w", STATES)
@pytest.mark.parametrize("v", DIRECTORS)
def test_derivatives(w, v):
    q, g, at, step = frame(), (0.3, -1.2, 0.7), np.array(w), np.full(3, 1e-3)
    rows = differences(lambda w: np.array(rotation.director(q, tuple(w), v)), at, step)
    slopes = np.array([rotation.slope(q, w, v, k) for k in range(3)])
    np.testing.assert_allclose(rows, slopes, atol=1e-10)
    np.testing.assert_allclose(rotation.moment(q, w, v, g), slopes @ g, atol=1e-14)
    second = differences(lambda w: np.array(rotation.moment(q, tuple(w), v, g)), at, step)
    found = rotation.moment_slopes(q, w, v, g)
    np.testing.assert_allclose(second[np.triu_indices(3)], found, atol=1e-10)


@pytest.mark.parametrize("w", STATES)
def test_a_frame_takes_over_the_rotation(w):
    x, frames = np.arange(12.0), np.array([frame(1), frame(2)])
    x[3:6], x[9:12] = 0.0, w
    before = frames.copy()
    d = [rotation.director(before[1], w, v) for v in DIRECTORS]
    rotation.rebase(frames, x)
    assert np.all(x == [0, 1, 2, 0, 0, 0, 6, 7, 8, 0, 0, 0])
    np.testing.assert_array_equal(frames[0], before[0])
    found = [rotation.placed(frames[1], v) for v in DIRECTORS]
    np.testing.assert_allclose(found, d, atol=1e-14)


def test_frames_stay_rotations():
    frames, r = frame().reshape(1, 9), np.random.default_rng(0)
    for _ in range(2000):
        x = np.append(np.zeros(3), r.uniform(-0.5, 0.5, 3))
        rotation.rebase(frames, x)
    q = frames.reshape(3, 3)
    np.testing.assert_allclose(q @ q.T, np.eye(3), atol=1e-15)
    assert np.linalg.det(q) == pytest.approx(1.0)
