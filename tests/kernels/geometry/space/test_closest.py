"""Closest points of points, edges and triangles, against minimisation and the toolkit of IPC."""

import ipctk
import numpy as np
import pytest

from kernels.geometry.space import closest
from kernels.geometry.space.closest import FACE

CORNERS = np.array([[0.0, 0.0, 0.0], [2.0, 0.0, 0.0], [0.5, 1.5, 0.0]])
REGIONS = [
    (0, (-0.3, -0.2)), (1, (2.4, -0.1)), (2, (0.4, 1.9)),
    (3, (1.0, -0.4)), (4, (1.6, 1.1)), (5, (-0.2, 0.9)), (FACE, (0.8, 0.5)),
]  # fmt: skip


def turned(points, seed=0):
    """Points after a random rotation and shift."""
    rng = np.random.default_rng(seed)
    basis, _ = np.linalg.qr(rng.normal(size=(3, 3)))
    return [tuple(row) for row in np.atleast_2d(points) @ basis.T + rng.normal(size=3)]


def on_grid(a, b, c, fine=400):
    """Points of a triangle."""
    v, w = np.meshgrid(np.linspace(0, 1, fine), np.linspace(0, 1, fine))
    inside = v + w <= 1.0 + 1e-12
    v, w = v[inside, None], w[inside, None]
    return np.array(a) + v * (np.array(b) - a) + w * (np.array(c) - a)


@pytest.mark.parametrize("height", [0.0, 1e-9, 0.7])
@pytest.mark.parametrize(("feature", "place"), REGIONS)
def test_regions_of_a_triangle(feature, place, height):
    p, a, b, c = turned(np.vstack([[*place, height], CORNERS]))
    found, v, w = closest.on_triangle(p, a, b, c)
    assert found == feature
    gap = np.linalg.norm(np.array(a) + v * (np.array(b) - a) + w * (np.array(c) - a) - p)
    sampled = np.linalg.norm(on_grid(a, b, c) - p, axis=1).min()
    assert sampled - 1e-2 <= gap <= sampled + 1e-14
    assert closest.squared_to_triangle(p, a, b, c) == pytest.approx(gap**2, rel=1e-12, abs=1e-28)
    if feature < FACE:
        assert min(v, w, 1.0 - v - w) == pytest.approx(0.0, abs=1e-15)


def ordinary(seed):
    """Four random points."""
    return [tuple(row) for row in np.random.default_rng(seed).normal(size=(4, 3))]


def in_plane(seed):
    """Four points in one plane."""
    return turned(np.random.default_rng(seed).normal(size=(4, 3)) * [1, 1, 0], seed)


def parallel(seed):
    """Two edges of one direction."""
    rng = np.random.default_rng(seed)
    a, u, w = rng.normal(size=(3, 3))
    far, begin, end = rng.normal(size=3)
    return [tuple(p) for p in (a, a + u, a + w * far + begin * u, a + w * far + end * u)]


def nearly_parallel(seed):
    rng = np.random.default_rng(seed)
    return [tuple(p) for p in np.array(parallel(seed)) + 1e-7 * rng.normal(size=(4, 3))]


SHAPES = [ordinary, in_plane, parallel, nearly_parallel]


@pytest.mark.parametrize("shape", SHAPES)
def test_distances_agree_with_the_toolkit(shape):
    for seed in range(60):
        points = shape(seed)
        arrays = [np.array(p) for p in points]
        ours = closest.squared_to_triangle(*points), closest.squared_between_edges(*points)
        theirs = ipctk.point_triangle_distance(*arrays), ipctk.edge_edge_distance(*arrays)
        np.testing.assert_allclose(ours, theirs, rtol=1e-6, atol=1e-13)


@pytest.mark.parametrize("shape", SHAPES)
def test_edges_against_samples_and_their_ends(shape):
    for seed in range(20):
        a, b, c, d = (np.array(p) for p in shape(seed))
        s, t = closest.on_edges(tuple(a), tuple(b), tuple(c), tuple(d))
        gap = np.linalg.norm(a + s * (b - a) - c - t * (d - c))
        grid = np.linspace(0, 1, 201)[:, None]
        one, two = a + grid * (b - a), c + grid * (d - c)
        sampled = np.linalg.norm(one[:, None] - two[None], axis=2).min()
        size = max(np.linalg.norm(b - a), np.linalg.norm(d - c))
        assert sampled - 0.005 * size <= gap <= sampled + 1e-12
        assert closest.squared_between_edges(*map(tuple, (a, b, c, d))) == pytest.approx(
            gap**2, rel=1e-12, abs=1e-25
        )


@pytest.mark.parametrize(("along", "share"), [(-0.2, 0.0), (0.0, 0.0), (0.3, 0.3), (1.7, 1.0)])
def test_closest_point_of_an_edge(along, share):
    p, a, b = turned([[2.0 * along, 0.4, 0.3], [0, 0, 0], [2, 0, 0]])
    assert closest.on_edge(p, a, b) == pytest.approx(share, abs=1e-15)
    off = 2.0 * (along - share)
    assert closest.squared_to_edge(p, a, b) == pytest.approx(0.25 + off**2)
