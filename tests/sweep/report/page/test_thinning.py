"""Curves with few points, and the work that is done until a force is exceeded."""

import numpy as np
import pytest

from sweep.report.page.thinning import (
    force_stairs,
    numbers,
    thin_curves,
    thin_stairs,
    thinned,
)
from sweep.simulation.up_to_force import absorbed_until, stroke_until


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
def test_stairs_tell_the_same_work_and_stroke_as_the_curve(seed):
    rng = np.random.default_rng(seed)
    force = np.abs(np.cumsum(rng.normal(size=200)))
    work, travel = np.cumsum(rng.random((2, 200)), axis=1)
    highest, done, way = force_stairs(force, work, travel)
    assert (np.diff(highest) >= 0.0).all()
    for limit in [*np.linspace(0.01, 1.1, 60) * force.max(), force[0], force.max()]:
        true = absorbed_until(limit, force, work), stroke_until(limit, force, travel)
        stairs = absorbed_until(limit, highest, done), stroke_until(limit, highest, way)
        assert stairs == pytest.approx(true, rel=1e-12)


@pytest.mark.parametrize("seed", range(3))
def test_thin_stairs_tell_small_works_too(seed):
    """A steep rise, a long plateau with dips, and packing."""
    rng = np.random.default_rng(seed)
    travel = np.linspace(0.0, 1.0, 400)
    plateau = 10.0 + np.cumsum(rng.normal(size=400)) * 0.05
    force = np.minimum(1e3 * travel, plateau) + 100.0 * np.clip(travel - 0.7, 0.0, None) ** 2
    work = np.append(0.0, np.cumsum(0.5 * (force[1:] + force[:-1]) * np.diff(travel)))
    highest, done, _ = force_stairs(force, work, travel)
    kept = thin_stairs(highest, done, 60)
    thin = highest[kept], done[kept]
    assert len(kept) <= 60
    for limit in np.linspace(1.0, force.max(), 200):
        true = absorbed_until(limit, force, work)
        assert absorbed_until(limit, *thin) == pytest.approx(true, rel=0.02), limit


def test_numbers_have_few_digits_and_no_nan():
    assert numbers([1.23456789, 5.0, np.nan, -0.00012345678]) == [1.235, 5, None, -0.0001235]
