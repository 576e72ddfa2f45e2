"""Curves with few points, and the work that is done until a force is exceeded."""

import numpy as np
import pytest

from sweep.report.page.thinning import (
    force_stairs,
    numbers,
    stair_strokes,
    thin_curves,
    thin_stairs,
    thinned,
    work_until,
)
from sweep.simulation.summary import absorbed_until


def test_corners_of_a_polyline_are_enough_and_the_farthest_point_comes_first():
    x = np.linspace(0.0, 3.0, 31)
    y = np.interp(x, [0.0, 1.0, 2.0, 3.0], [0.0, 1.0, 0.0, 2.0])
    assert thinned(np.column_stack([x, y]), 31, 1e-12) == [0, 10, 20, 30]
    points = np.array([[0.0, 0.0], [1.0, 1.0], [2.0, 3.0], [3.0, 0.0]])
    assert thinned(points, 3) == thinned(points, 4, 2.0) == [0, 2, 3]
    for count in range(3):
        assert thinned(np.zeros((count, 2)), 60) == list(range(count))


def test_error_falls_with_the_number_of_points():
    x = np.linspace(0.0, 1.0, 400)
    y = np.sin(20.0 * x)

    def error(most):
        thin = thin_curves((x, y), most)
        assert len(thin[0]) <= most
        return np.abs(np.interp(x, *thin) - y).max()

    assert error(60) < 0.5 * error(30) < 0.1
    assert error(60) < 0.04


def test_rows_without_a_number_are_left_out():
    x, y = thin_curves(([0.0, 1.0, 2.0], [1.0, np.nan, 3.0]), 60)
    assert (x.tolist(), y.tolist()) == ([0.0, 2.0], [1.0, 3.0])


@pytest.mark.parametrize("seed", range(5))
def test_stairs_tell_the_same_work_as_the_curve(seed):
    rng = np.random.default_rng(seed)
    force = np.abs(np.cumsum(rng.normal(size=200)))
    work = np.cumsum(rng.random(200))
    highest, done = force_stairs(force, work)
    assert (np.diff(highest) >= 0.0).all()
    for limit in [*np.linspace(0.01, 1.1, 60) * force.max(), force[0], force.max()]:
        expected = absorbed_until(limit, force, work)
        assert work_until(limit, highest, done) == pytest.approx(expected, rel=1e-12)


@pytest.mark.parametrize("seed", range(3))
def test_thin_stairs_tell_small_works_too(seed):
    """A steep rise, a long plateau with dips, and packing."""
    rng = np.random.default_rng(seed)
    travel = np.linspace(0.0, 1.0, 400)
    plateau = 10.0 + np.cumsum(rng.normal(size=400)) * 0.05
    force = np.minimum(1e3 * travel, plateau) + 100.0 * np.clip(travel - 0.7, 0.0, None) ** 2
    work = np.append(0.0, np.cumsum(0.5 * (force[1:] + force[:-1]) * np.diff(travel)))
    highest, done = force_stairs(force, work)
    kept = thin_stairs(highest, done, 60)
    thin = highest[kept], done[kept]
    assert len(kept) <= 60
    for limit in np.linspace(1.0, force.max(), 200):
        true = absorbed_until(limit, force, work)
        assert work_until(limit, *thin) == pytest.approx(true, rel=0.02), limit


@pytest.mark.parametrize("seed", range(3))
def test_strokes_of_stairs_are_those_at_which_a_force_is_first_exceeded(seed):
    rng = np.random.default_rng(seed)
    travel = np.cumsum(rng.uniform(0.1, 1.0, 60))
    force = 1.0 + np.abs(np.cumsum(rng.normal(size=60)))
    highest, _ = force_stairs(force, travel)
    strokes = stair_strokes(force, travel)
    for limit in np.linspace(force[0] + 1e-6, force.max() - 1e-6, 50):
        k, step = np.argmax(force > limit), np.argmax(highest > limit)
        true = np.interp(limit, force[k - 1 : k + 1], travel[k - 1 : k + 1])
        stair = np.interp(limit, highest[step - 1 : step + 1], strokes[step - 1 : step + 1])
        assert stair == pytest.approx(true, rel=1e-12)


def test_numbers_have_few_digits_and_no_nan():
    assert numbers([1.23456789, 5.0, np.nan, -0.00012345678]) == [1.235, 5, None, -0.0001235]
