"""Distance of points and walls from rigid profiles, and moves that never lead through one."""

from itertools import pairwise

import numpy as np
import pytest

from kernels.geometry import profile
from tests.support.kernels.frames import frame
from tests.support.kernels.profiles import SHAPES, of_frame
from tests.support.kernels.terms import differences

WALL = frame([(-2.0, 0.0), (2.0, 0.0)], [(0, 1)], 1)


def sampled(shape, n=20_001):
    """Points along the chain, closely."""
    share, last = np.linspace(0.0, 1.0, n)[:, None], shape.chain[-1:]
    lines = pairwise([*shape.chain, *last])
    return np.concatenate([a + share * (b - a) for a, b in lines])


def outside(of, seed, spread=4.0):
    """A point outside of a profile."""
    draw = np.random.default_rng(seed)
    while True:
        p = draw.uniform(-spread, spread, 2)
        if profile.distance(of, 0, *p)[2] > 0.01:
            return p


@pytest.mark.parametrize("shape", SHAPES)
def test_the_distance_is_that_of_the_nearest_point(shape):
    of, points, radius = of_frame(WALL, SHAPES[shape]), sampled(SHAPES[shape]), SHAPES[shape].radius
    for seed in range(20):
        p = outside(of, seed)
        nearest = np.linalg.norm(points - p, axis=1).min()
        assert profile.distance(of, 0, *p)[2] == pytest.approx(nearest - radius, abs=2e-5)
    if shape in ("edge", "sharp", "punch", "cornered"):
        assert profile.distance(of, 0, 0.1, 2.0)[2] < 0.0


@pytest.mark.parametrize("seed", range(3))
@pytest.mark.parametrize("shape", SHAPES)
def test_normal_and_curvature_are_the_derivatives_of_the_distance(shape, seed):
    of = of_frame(WALL, SHAPES[shape])
    p, step = outside(of, seed), np.full(2, 1e-5)
    nx, ny, d, bend = profile.distance(of, 0, *p)
    n = np.array([nx, ny])
    by_distance = differences(lambda q: profile.distance(of, 0, *q)[2], p, step)
    by_normal = differences(lambda q: np.array(profile.distance(of, 0, *q)[:2]), p, step)
    np.testing.assert_allclose(n, by_distance, atol=1e-7)
    np.testing.assert_allclose(bend * (np.eye(2) - np.outer(n, n)), by_normal, atol=1e-6)
    assert np.hypot(nx, ny) == pytest.approx(1.0)
    assert d > 0.0


@pytest.mark.parametrize("seed", range(3))
@pytest.mark.parametrize("shape", SHAPES)
def test_the_gap_of_a_wall_separates_it_from_the_profile(shape, seed):
    of, shaped = of_frame(WALL, SHAPES[shape]), SHAPES[shape]
    a, b = outside(of, seed), outside(of, seed + 100)
    wall = a + np.linspace(0.0, 1.0, 501)[:, None] * (b - a)
    least = min(profile.distance(of, 0, *p)[2] for p in wall)
    if least > 0.0:
        nx, ny, d = profile.gap(of, 0, *a, *b)
        n = np.array([nx, ny])
        assert d == pytest.approx(least, abs=5e-3)
        assert min(a @ n, b @ n) - (shaped.chain @ n).max() - shaped.radius > d - 1e-9


@pytest.mark.parametrize("seed", range(3))
@pytest.mark.parametrize("shape", SHAPES)
def test_no_move_leads_through_a_profile(shape, seed):
    """The wall stays apart up to the share; if that is less than 1, a little more would touch."""
    of, draw = of_frame(WALL, SHAPES[shape]), np.random.default_rng(seed)
    a = b = outside(of, seed)
    while profile.gap(of, 0, *a, *b)[2] <= 0.01 or crosses(of, a, b):
        a, b = outside(of, draw.integers(1 << 30)), outside(of, draw.integers(1 << 30))
    da, db = draw.uniform(-9, 9, (2, 2)) * 10.0 ** draw.uniform(-2, 1)
    begun, share = profile.gap(of, 0, *a, *b)[2], profile.advance(of, 0, a, b, da, db)
    for s in np.linspace(0.0, share, 60):
        at = a + s * da, b + s * db
        assert profile.gap(of, 0, *at[0], *at[1])[2] > 0.099 * begun
        assert not crosses(of, *at)
    if share < 1.0:
        assert profile.gap(of, 0, *(a + share * da), *(b + share * db))[2] < 0.111 * begun


def crosses(of, a, b):
    """Whether a wall is inside of a profile somewhere."""
    return any(
        profile.distance(of, 0, *(a + t * (b - a)))[2] <= 0.0 for t in np.linspace(0.0, 1.0, 41)
    )


@pytest.mark.parametrize("shape", ["punch", "cornered"])
def test_sliding_along_a_face_is_not_limited(shape):
    of, aside = of_frame(WALL, SHAPES[shape]), np.array([30.0, 0.0])
    a, b = np.array([-0.5, -1e-6]), np.array([0.5, -1e-6])
    assert profile.advance(of, 0, a, b, aside, aside) == 1.0


@pytest.mark.parametrize("far", [0.99, 1.01])
def test_boxes_have_all_of_a_profile(far):
    of = of_frame(WALL, SHAPES["round"])
    assert profile.is_far(of, 0, 1.0, -4.0 * far, -4.0 * far, 3.0, 3.0) == (far > 1.0)
    assert profile.is_far(of, 0, 1.0, 0.0, 0.0, -1.0 * far, -1.0 * far) == (far > 1.0)
