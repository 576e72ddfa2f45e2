"""Constraints as one matrix: moves of all coordinates by those of the unknowns and of the platen.

In scenes with a driven platen some coordinates are led, under a striker they are tied to it.
"""

import numpy as np
import pytest

from tests.support.kernels.pressed_plates import CASES, bent, pinched, reduction, scene, unit, whole
from tests.support.kernels.terms import differences

MOVE = -1e-4  # m


def random(of, seed):
    return np.random.default_rng(seed).uniform(-1, 1, of.x_rest.size)


def own(of):
    """Coordinates (k,) that follow no other: the free ones and the driven one."""
    leader = of.terms.layout.leader
    return np.flatnonzero(leader == np.arange(leader.size))


def moves(of):
    """Moves (n, k) of all coordinates by those that follow no other."""
    layout = of.terms.layout
    return (layout.leader[:, None] == own(of)) * layout.ratio[:, None]


@pytest.mark.parametrize("name", CASES)
def test_forces_on_tied_coordinates_act_on_their_leader(name):
    of = scene(name)
    g, residual, expected = random(of, 0), random(of, 1), np.zeros(of.x_rest.size)
    expected[own(of)] = moves(of).T @ g
    whole(of, of.x_rest).problem.reduce(g, residual)
    np.testing.assert_allclose(residual, expected, rtol=1e-14, atol=1e-14)


@pytest.mark.parametrize("name", CASES)
def test_tied_coordinates_follow_their_leader(name):
    of = scene(name)
    vector = random(of, 2)
    held = of.terms.layout.leader < 0
    expected = np.where(held, vector, moves(of) @ vector[own(of)])
    whole(of, of.x_rest).problem.tie(vector)
    np.testing.assert_array_equal(vector, expected)


@pytest.mark.parametrize("name", CASES)
def test_solutions_obey_the_constraints(name):
    of = scene(name)
    args = whole(of, bent(of))
    args.factored(bent(of), through=True)
    y, R = args.solve(random(of, 3)), reduction(of)
    short = np.linalg.lstsq(R, y)[0]
    np.testing.assert_allclose(R @ short, y, rtol=0, atol=1e-12 * np.abs(y).max())


@pytest.mark.parametrize("name", ["glued", "loose quarter"])
def test_a_prescribed_move_takes_along_all_that_is_led(name):
    of = scene(name)
    move, driven = np.zeros(of.x_rest.size), of.terms.layout.driven
    whole(of, of.x_rest).problem.lead(MOVE, move)
    np.testing.assert_array_equal(move, MOVE * moves(of)[:, own(of) == driven][:, 0])
    assert np.count_nonzero(move) == (1 if name == "loose quarter" else 1 + len(of.mesh.top))


@pytest.mark.parametrize("name", ["glued", "loose quarter"])
def test_a_prescribed_move_changes_the_gradient_by_its_pull(name):
    """Of all coordinates that are not held, the driven one included."""
    of = scene(name)
    x, change, lead = pinched(of), np.zeros(of.x_rest.size), np.zeros(of.x_rest.size)
    args, layout = whole(of, x), of.terms.layout
    args.factored(x, through=True)
    args.problem.pull(MOVE, change)
    args.problem.lead(1.0, lead)
    step = np.array([1e-5 * of.mesh.size.mean()])
    found = differences(lambda s: args.gradient(x + s[0] * lead), np.zeros(1), step)[0]
    kept, size = moves(of)[:, own(of) != layout.driven], unit(of)
    for expected, pulled in (
        (kept.T @ (size * found) * MOVE, kept.T @ (size * change)),
        (lead @ found * MOVE, lead @ change),
    ):
        scale = np.abs(expected).max()
        assert scale > 0.0
        np.testing.assert_allclose(pulled, expected, rtol=0, atol=1e-7 * scale)
