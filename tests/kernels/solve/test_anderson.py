"""Anderson's extrapolation: a fixed-point iteration that creeps, swings or diverges ends soon."""

import numpy as np
import pytest

from kernels.solve import anderson
from kernels.solve.problem import FREE, Coordinates


def coordinates(n, leap=10.0):
    """What the iteration knows of its coordinates: lengths of 1 m and 2 m."""
    scale, one = np.where(np.arange(n) % 2 == 0, 1.0, 2.0), np.ones(n)
    return Coordinates(np.full(n, FREE), scale, 1.0 / scale, one, one, one, -1, 1.0, leap, 1.0)


def iterated(image, y, loops, leap=10.0):
    """Argument after so many loops."""
    past, known = anderson.no_past(y.size), coordinates(y.size, leap)
    past.y[:], past.r[:] = 7.0, 7.0  # of the step before
    for loop in range(loops):
        anderson.extrapolate(image(y), y, known, loop, past)
    return y


def test_the_first_move_is_to_the_image():
    y = iterated(lambda y: 0.8 * y + 1.0, np.array([1.0, 2.0]), 1)
    np.testing.assert_allclose(y, [1.8, 2.6], rtol=1e-15)


@pytest.mark.parametrize("rate", [0.8, 0.5, -0.5, -1.0, -1.5, 2.0])
def test_one_rate_for_all_is_exact_at_the_second_move(rate):
    """Whether it creeps, swings, would swing ever wider or run away."""
    fixed = np.array([0.1, -0.05, 0.02])
    y = iterated(lambda y: fixed + rate * (y - fixed), np.zeros(3), 2)
    np.testing.assert_allclose(y, fixed, rtol=0, atol=1e-14)


@pytest.mark.parametrize("rates", [(0.9, -0.8, 0.4, -0.3), (2.5, -3.0, 0.7, -0.9)])
def test_a_linear_map_of_four_rates_is_exact_at_the_fifth_move(rates):
    """Even one that the plain iteration leaves: friction of a coefficient above 1."""
    rng = np.random.default_rng(0)
    turn, _ = np.linalg.qr(rng.uniform(-1, 1, (4, 4)))
    matrix, fixed = turn @ np.diag(rates) @ turn.T, rng.uniform(-1, 1, 4)
    y = iterated(lambda y: fixed + matrix @ (y - fixed), np.zeros(4), 5, leap=1e3)
    np.testing.assert_allclose(y, fixed, rtol=0, atol=1e-11)


def test_more_rates_than_changes_are_kept_converge_far_sooner_than_plain_iteration():
    rates = np.linspace(-0.9, 0.9, 40)
    y = iterated(lambda y: 0.1 + rates * (y - 0.1), np.zeros(40), 30)
    assert np.abs(y - 0.1).max() < 1e-2 * 0.9**30


def test_a_change_that_says_nothing_new_is_left_out():
    """Where the map is constant, residuals change as arguments do and all changes are parallel."""
    y = iterated(lambda y: np.array([3.0 + 0.5 * y[0], 0.0]), np.zeros(2), 8)
    np.testing.assert_allclose(y, [6.0, 0.0], rtol=1e-14)


def test_a_large_move_is_not_extrapolated():
    y = iterated(lambda y: 0.8 * y + 1.0, np.zeros(2), 3, leap=1e-3)
    np.testing.assert_allclose(y, 5.0 * (1.0 - 0.8**3), rtol=1e-14)
