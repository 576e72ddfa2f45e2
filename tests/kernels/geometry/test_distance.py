"""Distance of a point from a segment: closest points, and derivatives against differences."""

import numpy as np
import pytest

from kernels.geometry import distance
from tests.support.kernels.terms import derivative_error, of_points

POINT, START, END = 0, 1, 2
SEGMENT = [0.2, -0.1, 1.4, 0.5]  # along (2, 1)
ALONG, ACROSS = np.array([1.2, 0.6]), np.array([-0.6, 1.2])


def placed(along, across):
    """Coordinates with the point at shares of the segment along it and across it."""
    return np.array([*(np.array(SEGMENT[:2]) + along * ALONG + across * ACROSS), *SEGMENT])


def term_of(distance_at, push, stiffen):
    """Energy 1/2 (d - 1)^2 of a distance."""

    def slope(x, g):
        d = distance_at(x)
        push(g, x, d - 1.0)
        return 0.5 * (d - 1.0) ** 2

    return of_points(slope, lambda x, matrix: stiffen(matrix, x, 1.0, distance_at(x) - 1.0))


SEGMENT_TERM = term_of(
    lambda x: np.sqrt(distance.squared_distance(x, POINT, START, END)),
    lambda g, x, force: distance.push(g, x, POINT, START, END, force),
    lambda matrix, x, *slopes: distance.push_stiffen(matrix, x, POINT, START, END, *slopes),
)
NODE_TERM = term_of(
    lambda x: distance.direction(x, START, POINT)[2],
    lambda g, x, force: distance.push_point(g, x, POINT, START, force),
    lambda matrix, x, *slopes: distance.push_point_stiffen(matrix, x, POINT, START, *slopes),
)


@pytest.mark.parametrize(
    ("along", "across", "tau", "inside", "d"),
    [
        (0.3, 0.5, 0.3, True, 0.5),
        (0.7, -0.2, 0.7, True, 0.2),
        (-0.5, 0.0, 0.0, False, 0.5),
        (1.3, 0.4, 1.0, False, 0.5),
        (0.4, 0.0, 0.4, True, 0.0),
    ],
)
def test_closest_points_by_hand(along, across, tau, inside, d):
    x, length = placed(along, across), np.hypot(*ALONG)
    found, within = distance.closest(x, POINT, START, END)
    assert (found, within) == (pytest.approx(tau), inside)
    squared = distance.squared_distance(x, POINT, START, END)
    assert squared == pytest.approx((d * length) ** 2, rel=1e-12, abs=1e-30)
    nx, ny, apart = distance.normal(x, POINT, START, END, tau)
    assert apart == pytest.approx(d * length, abs=1e-15)
    if d > 0.0:
        assert np.hypot(nx, ny) == pytest.approx(1.0)
        reached = placed(tau, 0.0)[:2] + apart * np.array([nx, ny])
        np.testing.assert_allclose(reached, x[:2], atol=1e-15)


def test_a_point_on_the_segment_has_no_normal_and_is_not_pushed():
    x, g = np.array([1.0, 0.0, 0.0, 0.0, 2.0, 0.0]), np.zeros(6)
    assert distance.normal(x, POINT, START, END, 0.5) == (0.0, 0.0, 0.0)
    distance.push(g, x, POINT, START, END, 3.0)
    assert not g.any()


def test_a_segment_without_length_is_a_point():
    x = np.array([3.0, 4.0, 0.0, 0.0, 0.0, 0.0])
    assert distance.closest(x, POINT, START, END) == (0.0, False)
    assert distance.squared_distance(x, POINT, START, END) == 25.0


@pytest.mark.parametrize("length", [1.0, 1e-3])
@pytest.mark.parametrize(
    ("along", "across"),
    [(0.3, 0.5), (0.7, -0.2), (0.01, 0.4), (0.99, -0.3), (-0.5, 0.1), (1.4, 0.8), (0.5, 1e-2)],
)
def test_derivatives_against_differences(along, across, length):
    """Beside the segment, near its ends, beyond them, close to it; in other units.

    The length 1 of the energy stays, so that forces push in one unit and pull in the other.
    """
    x = length * placed(along, across)
    assert derivative_error(SEGMENT_TERM, x, length, 1e-4) < 1e-8
    assert derivative_error(NODE_TERM, x, length, 1e-4) < 1e-8


@pytest.mark.parametrize("tau", [0.0, 1.0])
def test_the_slope_is_continuous_where_the_closest_point_reaches_an_end(tau):
    sides = [SEGMENT_TERM.gradient(placed(tau + e, 0.5)) for e in (-1e-9, 1e-9)]
    np.testing.assert_allclose(*sides, rtol=0, atol=1e-8)
