"""Folds: two arms of a joint, or the elements at a hinge, never close on one another."""

from dataclasses import replace

import numpy as np
import pytest

from kernels.terms import bend, elements, fold
from kernels.terms.barrier import barrier
from tests.support.frames import Frame, bend_of, frame, walls_of
from tests.support.terms import Term, bending_of, derivative_error, least_share, of_points, room

HINGE = frame([(0, 0), (2.0, 0)], [(0, 1)], 2)
LIMIT = np.radians(20.0)
KINKED = replace(HINGE, points=np.array([[0.0, 0], [2.0, 0], [1.0, 0.4]]))


def closing(of: Frame, opening: float, side: int) -> np.ndarray:
    """A wall of two elements whose second one is folded to this opening, clockwise if side < 0."""
    x, (one, two) = of.rest.copy(), of.l0
    x[:2], x[4:6] = 0.0, (one, 0.0)
    back = side * (np.pi - opening)
    x[2:4] = one + two * np.cos(back), two * np.sin(back)
    return x


def term_of(of: Frame) -> Term:
    return bending_of(walls_of(of), bend_of(of))


def hinge_alone(of: Frame) -> bend.Bend:
    """Bending of a wall whose arms are limp."""
    bending = bend_of(of)
    return bending._replace(arm_stiffness=np.zeros_like(bending.arm_stiffness))


def fold_of_hinge(of: Frame, opening: float, side: int) -> float:
    """K (g0 / 2)^2 b(g / g_f), written out; g0: opening at rest on that side."""
    bending = bend_of(of)
    rest = np.pi - side * bending.hinge_angle[0]
    return bending.hinge_stiffness[0] * (0.5 * rest) ** 2 * barrier(opening / LIMIT)[0]


@pytest.mark.parametrize("of", [HINGE, KINKED], ids=["straight", "kinked"])
@pytest.mark.parametrize("side", [1, -1])
@pytest.mark.parametrize("share", [0.02, 0.3, 0.9, 1 - 1e-3, 1 + 1e-3])
def test_derivatives_of_a_folded_wall(share, side, of):
    x, step = closing(of, share * LIMIT, side), min(1e-4, 1e-3 * share)
    assert derivative_error(term_of(of), x, of.unit, step) < 1e-6


@pytest.mark.parametrize("side", [1, -1])
@pytest.mark.parametrize("share", [0.01, 0.4, 0.99, 1.01])
def test_energy_of_a_folded_wall(share, side):
    """That of its hinge and its barrier; either side of a straight wall is the same."""
    x, stiffness = closing(HINGE, share * LIMIT, side), bend_of(HINGE).hinge_stiffness[0]
    elastic = 0.5 * stiffness * (np.pi - share * LIMIT) ** 2
    hinge = bending_of(walls_of(HINGE), hinge_alone(HINGE))
    found = hinge.energy(x) - elastic
    assert found == pytest.approx(fold_of_hinge(HINGE, share * LIMIT, side), rel=1e-9, abs=1e-12)
    assert (found > 1e-9) == (share < 1)


@pytest.mark.parametrize("side", [1, -1])
def test_the_fold_of_a_kinked_wall_is_that_of_its_own_angle(side):
    """Not of its turn from rest; its stiffness goes with the opening that it has at rest."""
    x, bending = closing(KINKED, 0.5 * LIMIT, side), hinge_alone(KINKED)
    turn = side * (np.pi - 0.5 * LIMIT) - bending.hinge_angle[0]
    elastic = 0.5 * bending.hinge_stiffness[0] * turn**2
    expected = elastic + fold_of_hinge(KINKED, 0.5 * LIMIT, side)
    assert abs(bending.hinge_angle[0]) > 0.5
    assert bending_of(walls_of(KINKED), bending).energy(x) == pytest.approx(expected, rel=1e-9)


@pytest.mark.parametrize("side", [1, -1])
def test_folding_a_wall_flat_takes_infinite_energy(side):
    term = term_of(HINGE)
    energies = [term.energy(closing(HINGE, g, side)) for g in LIMIT * np.logspace(-1e-3, -9, 50)]
    assert np.all(np.diff(energies) > 0)
    assert energies[-1] > 3 * term.energy(closing(HINGE, LIMIT, side))
    assert not term.energy(closing(HINGE, 0.0, side)) < np.inf


@pytest.mark.parametrize("side", [1, -1])
@pytest.mark.parametrize("share", [0.01, 0.3, 0.95])
def test_a_folded_wall_projected_is_semi_definite(share, side):
    x = closing(HINGE, share * LIMIT, side)
    assert least_share(term_of(HINGE), x, HINGE.unit) > -1e-12
    assert np.linalg.eigvalsh(term_of(HINGE).hessian(x))[0] < -1e-2


@pytest.mark.parametrize("side", [1, -1])
@pytest.mark.parametrize("opening", [0.01, 0.5, 2.0])
def test_turns_returns_the_least_opening_of_a_hinge(opening, side):
    """Of the two walls: one kinked, the other one folded."""
    of = frame([(0, 0), (2.0, 0), (2.0, 3.0)], [(0, 1), (1, 2)], 2)
    of.points[3, 1] = 0.1
    bending, walls, x = bend_of(of), walls_of(of), of.rest.copy()
    one, two = of.l0[2:]
    back = side * (np.pi - opening)
    x[8:10] = 2.0, one
    x[4:6] = x[8:10] + two * np.array([-np.sin(back), np.cos(back)])
    shape, _ = room(walls)
    aimed = np.full((4, 3), np.inf)
    bend.renew_frame(x, walls, bending, aimed)
    elements.measure(x, walls, shape)
    assert bend.turns(x, walls, bending, aimed, shape) == pytest.approx(opening, rel=1e-9)


FOLD = fold.Fold(np.array([[0, 1, 2]]), np.array([LIMIT]), np.array([3.0]))
CORNER = of_points(
    lambda x, g: fold.evaluate(x, FOLD, g)[0],
    lambda x, matrix, projected: fold.hessian(x, FOLD, matrix, projected),
)


def folded(opening: float, turn: float = 0.4, arms=(1.3, 0.8)) -> np.ndarray:
    """Two arms of node 1 that open anticlockwise by ``opening``."""
    one, two = arms[0] * np.exp(1j * turn), arms[1] * np.exp(1j * (turn + opening))
    return np.array([0.2 + one.real, one.imag, 0.2, 0, 0.2 + two.real, two.imag])


@pytest.mark.parametrize("length", [1.0, 1e-3, 1e3])
@pytest.mark.parametrize(
    "share", [1e-3, 0.02, 0.3, 0.9, 1 - 1e-3, 1 + 1e-3, 4.0, 4.6, 9.0, 9.01, 17.99]
)
def test_derivatives_of_a_fold(share, length):
    x, step = length * folded(share * LIMIT), min(1e-4, 1e-3 * share)
    assert derivative_error(CORNER, x, length, step) < 1e-6


@pytest.mark.parametrize("opening", [1e-3, 0.2, 0.7])
def test_evaluate_returns_the_least_opening_below_half_a_right_angle(opening):
    assert fold.evaluate(folded(opening), FOLD, np.zeros(6))[1] == pytest.approx(opening)


@pytest.mark.parametrize("opening", [0.8, 1.6, 3.0, 4.0, 6.0])
def test_evaluate_never_claims_more_opening_than_there_is(opening):
    """Beyond half a right angle it need not be exact: what a step may close is bounded by it."""
    assert 0.5 < fold.evaluate(folded(opening), FOLD, np.zeros(6))[1] <= opening


@pytest.mark.parametrize("share", [1e-6, 0.3, 0.99])
def test_energy_of_a_fold(share):
    expected = -3.0 * (share - 1) ** 2 * np.log(share)
    assert CORNER.energy(folded(share * LIMIT)) == pytest.approx(expected, rel=1e-9)


@pytest.mark.parametrize(
    "opening", [LIMIT + 1e-9, 0.5, np.pi / 2, 2.0, np.pi, 4.0, 6.0, 2 * np.pi - 1e-9]
)
def test_a_fold_beyond_its_limit_costs_nothing(opening):
    x = folded(opening)
    assert CORNER.energy(x) == 0.0
    assert np.all(CORNER.gradient(x) == 0.0)


def test_closing_takes_infinite_energy():
    x = np.array([2.0, 0, 0, 0, 1.0, 0])
    assert CORNER.energy(x) == np.inf
    energies = [CORNER.energy(folded(g)) for g in LIMIT * np.logspace(-1e-3, -12, 50)]
    assert np.all(np.diff(energies) > 0)


@pytest.mark.parametrize("share", [1e-3, 0.05, 0.5, 0.95])
def test_projected_fold_is_semi_definite(share):
    x = folded(share * LIMIT)
    assert least_share(CORNER, x) > -1e-12
    assert np.linalg.eigvalsh(CORNER.hessian(x))[0] < -1e-2


@pytest.mark.parametrize("turn", [1.0, 2.8, -2.0])
def test_a_fold_is_the_same_wherever_it_points(turn):
    before, after = (CORNER.energy(folded(0.3 * LIMIT, t)) for t in (0.4, turn))
    assert after == pytest.approx(before, rel=1e-10)
