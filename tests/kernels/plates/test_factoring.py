"""The factor of a step of plates: of the exact Hessian, and of the shifted one."""

import numpy as np
import pytest
from scipy.linalg import eigh

from kernels.plates.neighbour_lists import make_matrix
from kernels.solve.problem import NEGATIVE, NO_ROOM, POSITIVE
from tests.support.kernels.pressed_plates import (
    CASES,
    SIDE,
    STATES,
    pinched,
    reduction,
    scene,
    shaken,
    unit,
    whole,
)
from tests.support.kernels.solving import neighbours_of
from tests.support.kernels.terms import differences

MOVE = -1e-4  # m


def near_rest(of):
    return shaken(of, of.x_rest, 1, 1e-3)


def forces(size):
    return np.random.default_rng(3).uniform(-1, 1, size)


@pytest.mark.parametrize("name", CASES)
def test_solutions_are_those_of_the_dense_matrix(name):
    of = scene(name)
    x, R = near_rest(of), reduction(of)
    args = whole(of, x)
    assert args.factored(x)[0] == POSITIVE
    g = forces(x.size)
    expected = R @ np.linalg.solve(args.entries(), R.T @ g)
    np.testing.assert_allclose(args.solve(g), expected, rtol=0, atol=1e-9 * np.abs(expected).max())


@pytest.mark.parametrize("state", STATES)
@pytest.mark.parametrize("name", CASES)
def test_directions_of_descent_have_the_negative_pivot(name, state):
    """A factor that goes through has one negative pivot for each negative eigenvalue."""
    of = scene(name)
    x, R = STATES[state](of), reduction(of)
    args = whole(of, x)
    result, pivot = args.factored(x)
    H = args.entries()
    assert (result == NEGATIVE) == (np.linalg.eigvalsh(H)[0] < 0.0)
    if result == NEGATIVE:
        d = args.escape()
        short = np.linalg.lstsq(R, d)[0]
        np.testing.assert_allclose(R @ short, d, rtol=0, atol=1e-12 * np.abs(d).max())
        assert pivot < 0.0
        assert short @ H @ short == pytest.approx(pivot, rel=1e-6)
        args.factored(x, through=True)
        assert args.problem.unstable() == np.count_nonzero(np.linalg.eigvalsh(H) < 0.0)


def test_a_shift_is_added_to_the_hessian():
    """So many times the weights that all pivots are positive; the matrix itself stays exact."""
    of = scene("glued")
    x, W, R = pinched(of), np.diag(of.terms.layout.weight), reduction(of)
    args = whole(of, x)
    assert args.factored(x)[0] == NEGATIVE
    H = args.entries()
    least = -eigh(H, W, eigvals_only=True, subset_by_index=[0, 0])[0]
    assert args.factored(x, 0.99 * least)[0] == NEGATIVE
    assert args.factored(x, 1.01 * least)[0] == POSITIVE
    assert args.factored(x, 2.0 * least)[0] == POSITIVE
    np.testing.assert_array_equal(args.entries(), H)
    g = forces(x.size)
    expected = R @ np.linalg.solve(H + 2.0 * least * W, R.T @ g)
    np.testing.assert_allclose(args.solve(g), expected, rtol=0, atol=1e-8 * np.abs(expected).max())


def test_the_stiffest_length_is_the_largest_on_the_diagonal():
    of = scene("struck")
    args = whole(of, near_rest(of))
    args.factored(near_rest(of))
    diagonal = np.diag(args.entries())[of.terms.layout.is_length]
    assert args.problem.stiffest() == pytest.approx(diagonal.max(), rel=1e-12)


def test_what_has_come_near_needs_room_and_gets_it():
    """A matrix made at rest has none for contacts that came later; one that is renewed has."""
    of = scene("glued")
    x = pinched(of)
    args = whole(of, x)
    at_rest = neighbours_of(of.x_rest, of.terms, 2.0 * SIDE)
    lacking = args.beside(at_rest)
    assert lacking.energy(x) == pytest.approx(
        args.lagging(at_rest.lagged_contacts).energy(x), rel=1e-12
    )
    assert lacking.problem.factor(x, args.step, lacking.found(x)[1], 0.0, False)[0] == NO_ROOM
    renewed = of.terms.renew_neighbours(at_rest, x, 0.0)
    there = args.beside(renewed)
    assert there.problem.factor(x, args.step, there.found(x)[1], 0.0, False)[0] != NO_ROOM
    again = of.terms.renew_neighbours(renewed, x, 0.0)
    assert np.shares_memory(again.matrix.values, renewed.matrix.values)


def test_lagged_friction_has_room_also_where_its_walls_have_parted():
    """Friction of a step acts on the contacts of its start, although they may open within it."""
    of = scene("glued")
    touching = neighbours_of(pinched(of), of.terms)
    touching.matrix.missing[0] = 1
    apart = of.terms.renew_neighbours(touching, of.x_rest, 0.0)
    args = whole(of, of.x_rest)
    nothing = neighbours_of(of.x_rest, of.terms).lagged_contacts
    without = apart._replace(matrix=make_matrix(of.terms, apart.pairs, nothing))
    for neighbours, has_room in ((apart, True), (without, False)):
        there = args.beside(neighbours)
        result, _ = there.problem.factor(
            of.x_rest, args.step, there.found(of.x_rest)[1], 0.0, False
        )
        assert (result != NO_ROOM) == has_room


@pytest.mark.parametrize("name", ["glued", "loose quarter"])
def test_a_prescribed_move_changes_the_gradient_by_its_pull(name):
    """The gradient in all coordinates that are not held, including the driven one."""
    of = scene(name)
    x, change, lead = pinched(of), np.zeros(of.x_rest.size), np.zeros(of.x_rest.size)
    args = whole(of, x)
    args.factored(x, through=True)
    args.problem.pull(MOVE, change)
    args.problem.lead(1.0, lead)
    step = np.array([1e-5 * of.mesh.size.mean()])
    found = differences(lambda s: args.gradient(x + s[0] * lead), np.zeros(1), step)[0]
    kept, size = reduction(of), unit(of)
    for expected, pulled in (
        (kept.T @ (size * found) * MOVE, kept.T @ (size * change)),
        (lead @ found * MOVE, lead @ change),
    ):
        scale = np.abs(expected).max()
        assert scale > 0.0
        np.testing.assert_allclose(pulled, expected, rtol=0, atol=1e-7 * scale)
