"""How far a minimisation moves: no wall passes another, and no wall stops short of another."""

import numpy as np
import pytest

from kernels.solve import outcomes, residual
from sweep.config.case import Case
from sweep.scene.lattice import build_scene
from tests.support.designs.scenes import grid
from tests.support.kernels.solving import descend, floating, shaken, whole


def test_a_wall_that_lies_upon_another_is_refused():
    """Its energy is infinite, near a joint too, where walls are only kept from crossing."""
    case = grid(2.0, "contact", "barrier", 20)
    scene = build_scene(case)
    x, h = scene.x_rest.copy(), scene.mesh.rest_length.mean()
    above = np.argmin(np.linalg.norm(scene.mesh.points - (0.0, 2.0 * h), axis=1))
    x[2 * above : 2 * above + 2] = 1.5 * h, 0.0
    found = descend(case, scene, x, whole(scene, scene.x_rest))
    assert found.outcome == outcomes.NOT_FINITE
    np.testing.assert_array_equal(found.x, x)


@pytest.mark.parametrize("seed", range(8))
def test_the_first_move_goes_as_far_as_is_admissible(seed):
    """Two walls that fly at one another on a diagonal do not pass, in whatever direction."""
    case = grid(2.0, "contact", "barrier")
    scene = build_scene(case)
    rng = np.random.default_rng(seed)
    start, bearing = shaken(scene, scene.x_rest, seed, 0.1), rng.uniform(-np.pi, np.pi)
    start[[-2, -1]] += -1e-3, 1e-3
    move = np.zeros_like(start)
    points = 2 * len(scene.mesh.points)
    move[:points] = rng.choice([-1.0, 1.0], points // 2).repeat(2) * np.tile(
        [np.cos(bearing), np.sin(bearing)], points // 2
    )
    move *= 10.0 ** rng.uniform(-3.5, -2)
    args = whole(scene, start, reach=3e-2)
    share = args.limit(start, move)
    found = descend(case, scene, start, args, move=move, iterations=0)
    assert found.outcome == outcomes.ITERATIONS
    np.testing.assert_allclose(found.x, start + share * move, rtol=0, atol=1e-15)


@pytest.mark.parametrize("angle", [0.0, 0.5, np.pi / 4, 1.0])
def test_walls_that_fly_at_one_another_do_not_pass(angle):
    """Whichever way they go: a node is faster than either of its coordinates."""
    size, reach = 6e-3, 3.4e-3
    case = Case.of(
        lattice=dict(cells_x=1, cells_y=1, width=size, height=size, imperfection=0.0),
        loading=dict(force=1.0),
    )
    scene = floating(case)
    points, across = scene.mesh.points, np.array([np.cos(angle), np.sin(angle)])
    turn = np.array([across, [-across[1], across[0]]])
    start, move = scene.x_rest.copy(), np.zeros_like(scene.x_rest)
    start[: points.size] = (points @ turn).ravel()
    start[points.size : -2] += angle
    for side, way in ((0.0, 1.0), (size, -1.0)):
        inside = (points[:, 0] == side) & (points[:, 1] > 0.0) & (points[:, 1] < size)
        move[: points.size].reshape(-1, 2)[inside] = way * reach * across
    args = whole(scene, start, reach=3e-2)
    found = descend(case, scene, start, args, move=move, iterations=0)
    expected = start + 0.9 * 0.5 * size / reach * move
    np.testing.assert_allclose(found.x, expected, rtol=0, atol=1e-12)


@pytest.mark.parametrize("moves", [15.5, 30.5])
def test_a_step_of_too_many_shortened_moves_is_given_up(moves):
    """A free lattice flies so many times the longest move: in time a shorter step is easier."""
    case = grid(2.0)
    scene = floating(case)
    start, v, cap = scene.x_rest, np.zeros_like(scene.x_rest), scene.terms.coordinates.cap
    v[: scene.mesh.points.size : 2] = moves * cap / 1e-3
    found = descend(case, scene, start, whole(scene, start, dt=1e-3, v=v, factor=0.0))
    gone = (found.x[0] - start[0]) / cap
    if moves < residual.MOST_CUT_MOVES:
        assert (found.outcome, gone) == (outcomes.CONVERGED, pytest.approx(moves))
    else:
        most = pytest.approx(residual.MOST_CUT_MOVES)
        assert (found.outcome, found.iterations, gone) == (outcomes.ITERATIONS, most, most)
