"""Axes of a quad that is no rectangle: orthonormal, and the derivatives of tensors in them."""

import numpy as np
import pytest

from kernels.plates.element import axes

METRIC = np.array([[1.3, 0.4], [0.4, 0.8]])
ABC = np.array(axes.orthonormal(1.3, 0.8, 0.4)[:3])
TURN = np.array([[ABC[0], ABC[1]], [0.0, ABC[2]]])  # columns: t1 and t2 in (x,s; x,z)


def packed(*tensors):
    return np.array([v for m in tensors for v in (m[0, 0], m[1, 1], m[0, 1])])


def drawn(seed):
    m = np.random.default_rng(seed).uniform(-1, 1, (2, 2))
    return m + m.T


def matrix():
    """P of all three tensors, (9, 9), from turned unit vectors."""
    columns = []
    for unit in np.eye(9):
        m = unit.copy()
        axes.turn(ABC, m)
        columns.append(m)
    return np.array(columns).T


def test_axes_are_orthonormal_at_rest():
    np.testing.assert_allclose(TURN.T @ METRIC @ TURN, np.eye(2), atol=1e-15)
    assert axes.orthonormal(1.3, 0.8, 0.4)[3] == pytest.approx(np.sqrt(np.linalg.det(METRIC)))


def test_those_of_a_rectangle_are_its_own():
    assert axes.orthonormal(1.0, 1.0, 0.0) == (1.0, 0.0, 1.0, 1.0)


def test_tensors_turn_as_bilinear_forms():
    tensors = [drawn(seed) for seed in range(3)]
    m = packed(*tensors)
    axes.turn(ABC, m)
    np.testing.assert_allclose(m, packed(*(TURN.T @ one @ TURN for one in tensors)), rtol=1e-14)


def test_slopes_and_second_derivatives_are_pulled_back():
    r, p = np.random.default_rng(4), matrix()
    slope, second = r.uniform(-1, 1, 9), r.uniform(-1, 1, (9, 9))
    second += second.T
    own, both = slope.copy(), second.copy()
    axes.pull_back(ABC, own)
    axes.pull_back_second(ABC, both)
    np.testing.assert_allclose(own, slope @ p, rtol=0, atol=1e-14)
    np.testing.assert_allclose(both, p.T @ second @ p, rtol=0, atol=1e-13)
