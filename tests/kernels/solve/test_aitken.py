"""Aitken's extrapolation: a fixed-point iteration that creeps or swings ends soon."""

from types import SimpleNamespace

import numpy as np
import pytest

from kernels.solve import aitken
from kernels.solve.problem import FREE, Coordinates


def coordinates(n, leap=1.0):
    """What the iteration knows of its coordinates: lengths of 1 m and 2 m."""
    scale, one = np.where(np.arange(n) % 2 == 0, 1.0, 2.0), np.ones(n)
    return Coordinates(np.full(n, FREE), scale, 1.0 / scale, one, one, one, -1, 1.0, leap, 1.0)


def iterated(image, y, loops, leap=1.0):
    """Argument after so many loops, and the shares taken."""
    change, share, shares, known = np.zeros(y.size), 0.0, [], coordinates(y.size, leap)
    for _ in range(loops):
        share = aitken.relax(image(y), y, change, known, share)
        shares.append(share)
    return y, shares


def test_the_first_move_is_to_the_image():
    y, shares = iterated(lambda y: 0.8 * y + 1.0, np.array([1.0, 2.0]), 1)
    np.testing.assert_allclose(y, [1.8, 2.6], rtol=1e-15)
    assert shares == [1.0]


@pytest.mark.parametrize("rate", [0.8, 0.5, -0.5, -1.0, -1.5])
def test_one_rate_for_all_is_exact_at_the_second_move(rate):
    """Whether it creeps, swings or would swing ever wider."""
    fixed = np.array([0.1, -0.05, 0.02])
    y, shares = iterated(lambda y: fixed + rate * (y - fixed), np.zeros(3), 2)
    np.testing.assert_allclose(y, fixed, rtol=0, atol=1e-15)
    assert shares[1] == pytest.approx(1.0 / (1.0 - rate))


def test_many_rates_converge_far_sooner_than_plain_iteration():
    rng = np.random.default_rng(0)
    rates, fixed = np.array([0.8, 0.3, -0.2, 0.05]), 0.1 * rng.uniform(-1, 1, 4)
    image = SimpleNamespace(calls=0)

    def step(y):
        image.calls += 1
        return fixed + rates * (y - fixed)

    y, _ = iterated(step, np.zeros(4), 15)
    assert np.abs(y - fixed).max() < 1e-4 * 0.8**15
    assert image.calls == 15


def test_a_large_move_is_neither_stretched_nor_cut():
    y, shares = iterated(lambda y: 0.8 * y + 1.0, np.zeros(2), 3, leap=1e-3)
    np.testing.assert_allclose(y, 5.0 * (1.0 - 0.8**3), rtol=1e-14)
    assert shares == [1.0, 1.0, 1.0]
