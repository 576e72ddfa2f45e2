"""Barrier on the angle between directors and normals: derivatives from its start to a fold."""

import numpy as np
import pytest

from kernels.laws.barrier import barrier
from kernels.plates.element import fold
from tests.support.kernels import shells
from tests.support.kernels.terms import Term, derivative_error

STIFFNESS, CORNERS, AREAS = 3.0, np.full(4, 0.4), np.full(4, 1.0)
FLAT = np.array([[0, 0, 0], [0.5, 0, 0], [0.5, 0.8, 0], [0, 0.8, 0.0]])
ANGLES = {"near the start": 71.0, "beyond": 80.0, "deep": 89.0}


def state(degrees, seed=None):
    """A flat element whose directors lean by this angle, each to its own side."""
    lean, to = np.radians(degrees), np.array([0.3, 1.9, 2.6, 5.0])
    directors = np.column_stack(
        [np.sin(lean) * np.cos(to), np.sin(lean) * np.sin(to), np.full(4, np.cos(lean))]
    )
    q = np.hstack([FLAT, directors]).ravel()
    return q if seed is None else q + np.random.default_rng(seed).uniform(-0.1, 0.1, 24)


def slope(q, g):
    return fold.evaluate(q, CORNERS, AREAS, STIFFNESS, g)


def second(q):
    full = np.zeros((24, 24))
    fold.hessian(q, CORNERS, AREAS, STIFFNESS, np.empty(24), full)
    return full


FOLD = Term(slope, second)


@pytest.mark.parametrize("angle", ANGLES)
def test_derivatives(angle):
    q = state(ANGLES[angle])
    assert FOLD.energy(q) > 0.0
    assert derivative_error(FOLD, q, 1.0, 1e-5 if angle == "deep" else 1e-4) < 1e-6


@pytest.mark.parametrize("seed", range(3))
def test_derivatives_where_the_element_is_bent_too(seed):
    q = state(75.0, seed)
    assert not fold.is_folded(q)
    assert FOLD.energy(q) > 0.0
    assert derivative_error(FOLD, q, 1.0, 1e-5) < 1e-6


def test_each_corner_counts_by_its_cosine():
    q = state(0.0)
    q[3:6] = np.sin(np.radians(80.0)), 0.0, np.cos(np.radians(80.0))
    value, _, _ = barrier(np.cos(np.radians(80.0)) / fold.START)
    assert FOLD.energy(q) == pytest.approx(STIFFNESS * value, rel=1e-12)


def test_so_does_an_element_of_which_little_is_left():
    q = state(0.0).reshape(4, 6)
    q[:, :3] *= np.sqrt(0.2)
    value, _, _ = barrier(0.2 / fold.START)
    assert FOLD.energy(q.ravel()) == pytest.approx(4.0 * STIFFNESS * value, rel=1e-12)


def test_up_to_the_start_there_is_nothing():
    q = state(np.degrees(np.arccos(fold.START)) - 1e-6)
    assert FOLD.energy(q) == 0.0
    assert not FOLD.gradient(q).any()
    assert not FOLD.hessian(q).any()


def test_a_director_beyond_a_right_angle_is_folded():
    assert not fold.is_folded(state(89.9))
    assert fold.is_folded(state(90.1))


@pytest.mark.parametrize("turn", [72.0, 80.0])
def test_derivatives_of_the_whole_element(turn):
    """Derivatives by coordinate of all that an element stores; one director turns about the side
    along s.
    """
    plate = shells.plate(1, 1)
    x = shells.shaken(plate, 0, 0.02, 0.02)
    x[3] = np.tan(np.radians(0.25 * turn))
    assert derivative_error(shells.term_of(plate), x, plate.unit, 1e-4) < 1e-6
