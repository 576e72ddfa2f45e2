"""Constraints as one matrix R (n, k): x = R q, so that forces on q are R^T g."""

import numpy as np
import pytest

from tests.support.kernels.solving import whole
from tests.support.kernels.states import bent, driven

PLATENS = ["glued", "sliding", "contact"]
MOVE = -1e-4  # m


@pytest.fixture(params=PLATENS)
def scene(request):
    return driven(request.param)


def random(scene, seed):
    return np.random.default_rng(seed).uniform(-1, 1, scene.x_rest.size)


def own(scene):
    """Coordinates (k,) that follow no other: the free ones and the driven one."""
    leader = scene.terms.layout.leader
    return np.flatnonzero(leader == np.arange(leader.size))


def reduction(scene):
    return (scene.terms.layout.leader[:, None] == own(scene)).astype(float)


def column(scene):
    """Column of R that belongs to the driven coordinate."""
    return reduction(scene)[:, own(scene) == scene.terms.layout.driven][:, 0]


def test_forces_on_tied_coordinates_act_on_their_leader(scene):
    g, residual = random(scene, 0), random(scene, 1)
    whole(scene, scene.x_rest).problem.reduce(g, residual)
    expected = np.zeros(g.size)
    expected[own(scene)] = reduction(scene).T @ g
    np.testing.assert_allclose(residual, expected, rtol=1e-14, atol=1e-14)


def test_tied_coordinates_follow_their_leader(scene):
    vector = random(scene, 2)
    held = scene.terms.layout.leader < 0
    expected = np.where(held, vector, reduction(scene) @ vector[own(scene)])
    whole(scene, scene.x_rest).problem.tie(vector)
    np.testing.assert_array_equal(vector, expected)


def test_a_prescribed_move_takes_along_all_that_is_led(scene):
    move = np.zeros(scene.x_rest.size)
    whole(scene, scene.x_rest).problem.lead(MOVE, move)
    np.testing.assert_array_equal(move, MOVE * column(scene))
    assert np.count_nonzero(move) > 0


def test_a_prescribed_move_pulls_with_its_column_of_the_hessian(scene):
    x = bent(scene)
    args, change = whole(scene, x), np.zeros(x.size)
    args.factor(x)
    args.problem.pull(MOVE, change)
    others = reduction(scene)[:, own(scene) != scene.terms.layout.driven]
    expected = others.T @ args.hessian(x) @ column(scene) * MOVE
    scale = abs(expected).max()
    assert scale > 0.0
    np.testing.assert_allclose(others.T @ change, expected, rtol=1e-9, atol=1e-9 * scale)
