"""Derivatives of distances in space: every feature, on both sides of where it changes."""

import numpy as np
import pytest

from kernels.geometry.space import closest, derivatives
from kernels.geometry.space.closest import FACE
from tests.support.kernels.terms import Term, derivative_error


def corner_points(y):
    return tuple(tuple(row) for row in y.reshape(4, 3))


def of_triangle(y):
    """Nodes, shares and free parameters of the closest points of a point and a triangle."""
    p, a, b, c = corner_points(y)
    feature, v, w = closest.on_triangle(p, a, b, c)
    if feature == FACE:
        return (0, 1, 2, 3), (1.0, v + w - 1.0, -v, -w), 3
    if feature < 3:
        return (0, feature + 1, feature + 1, feature + 1), (1.0, -1.0, 0.0, 0.0), 0
    one, two = ((1, 2), (2, 3), (3, 1))[feature - 3]
    s = closest.on_edge(p, *(corner_points(y)[i] for i in (one, two)))
    return (0, one, two, two), (1.0, s - 1.0, -s, 0.0), 1


def of_edges(y):
    s, t = closest.on_edges(*corner_points(y))
    free = (1 if 0.0 < s < 1.0 else 0) + (2 if 0.0 < t < 1.0 else 0)
    return (0, 1, 2, 3), (1.0 - s, s, t - 1.0, -t), free


def distance(find, slopes, stiffness=0.0, force=1.0) -> Term:
    """Energy with the derivatives ``force`` and ``stiffness`` in the distance."""

    def at(y):
        nodes, share, free = find(y)
        points = corner_points(y)
        return nodes, share, free, tuple(points[i] for i in nodes)

    def slope(y, g):
        nodes, share, _, points = at(y)
        n, d = derivatives.gap(share, points)
        for i in range(4):
            g[3 * nodes[i] : 3 * nodes[i] + 3] += force * share[i] * np.array(n)
        return force * d

    def second(y):
        nodes, share, free, points = at(y)
        K, matrix = np.full((12, 12), np.nan), np.zeros((12, 12))
        derivatives.fill(points, slopes, share, free, stiffness, force, K)
        place = (3 * np.array(nodes)[:, None] + np.arange(3)).ravel()
        np.add.at(matrix, np.ix_(place, place), K)
        return matrix

    return Term(slope, second)


TRIANGLE = distance(of_triangle, derivatives.TRIANGLE)
EDGES = distance(of_edges, derivatives.EDGES)
CORNERS = [[0, 0, 0], [2, 0, 0], [0.5, 1.5, 0]]
PLACES = [
    (-0.3, -0.2), (2.4, -0.1), (0.4, 1.9), (1.0, -0.4), (1.6, 1.1), (-0.2, 0.9), (0.8, 0.5),
    (1.0, 1e-3), (1.0, -1e-3), (-1e-3, -1e-3), (1e-3, 5e-4),
]  # fmt: skip


def turned(points, size):
    basis, _ = np.linalg.qr(np.random.default_rng(1).normal(size=(3, 3)))
    return (size * np.array(points, float) @ basis.T).ravel()


@pytest.mark.parametrize("size", [1.0, 1e-3])
@pytest.mark.parametrize("height", [0.03, 0.8])
@pytest.mark.parametrize("place", PLACES)
def test_of_a_point_and_a_triangle(place, height, size):
    y = turned([(*place, height), *CORNERS], size)
    assert derivative_error(TRIANGLE, y, size, 2e-4 * min(height, 0.2)) < 1e-6


@pytest.mark.parametrize("size", [1.0, 1e-3])
@pytest.mark.parametrize("tilt", [1.0, 0.05])
@pytest.mark.parametrize("shift", [-0.3, -1.999e-1, 0.4, 0.999, 1.3])
def test_of_two_edges(shift, tilt, size):
    """Edges that are closest in the middle, beyond the ends, or nearly parallel."""
    begin, along = np.array([shift, -0.2 * tilt, 0.3]), np.array([1.0, tilt, 0.1])
    y = turned([(0, 0, 0), (1, 0, 0), begin, begin + along], size)
    assert derivative_error(EDGES, y, size, 2e-5 * tilt) < 1e-5


def test_the_gradient_is_continuous_over_sides_and_corners():
    for place in ((1.0, 0.0), (0.0, 0.0), (2.0, 0.0), (1.25, 0.75), (0.25, 0.75)):
        slopes = []
        for angle in np.linspace(0, 6, 7):
            off = 1e-9 * np.array([np.cos(angle), np.sin(angle)])
            slopes.append(TRIANGLE.gradient(turned([(*(place + off), 0.3), *CORNERS], 1.0)))
        np.testing.assert_allclose(slopes, np.tile(slopes[0], (7, 1)), atol=1e-7)
