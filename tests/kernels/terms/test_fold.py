"""Folds: two neighbouring elements of a node never close on one another."""

import numpy as np
import pytest

from kernels.terms import fold
from tests.support.kernels.terms import derivative_error, of_points

LIMIT = fold.LIMIT
FOLD = fold.Fold(np.array([[0, 1, 2]]), np.array([LIMIT]), np.array([3.0]))
CORNER = of_points(
    lambda x, g: fold.evaluate(x, FOLD, g)[0],
    lambda x, matrix: fold.hessian(x, FOLD, matrix),
)


def folded(opening: float, turn: float = 0.4, arms=(1.3, 0.8)) -> np.ndarray:
    """Two elements of node 1 that open anticlockwise by ``opening``."""
    one, two = arms[0] * np.exp(1j * turn), arms[1] * np.exp(1j * (turn + opening))
    return np.array([0.2 + one.real, one.imag, 0.2, 0, 0.2 + two.real, two.imag])


@pytest.mark.parametrize("length", [1.0, 1e-3])
@pytest.mark.parametrize("share", [1e-3, 0.02, 0.3, 1 - 1e-3, 1 + 1e-3, 4.6, 9.0, 17.99])
def test_derivatives_of_a_fold(share, length):
    x, step = length * folded(share * LIMIT), min(1e-4, 1e-3 * share)
    assert derivative_error(CORNER, x, length, step) < 1e-6


@pytest.mark.parametrize("opening", [1e-3, 0.2, 0.7, 0.8, 1.6, 3.0, 4.0, 6.0])
def test_evaluate_never_claims_more_opening_than_there_is(opening):
    """Beyond half a right angle it need not be exact: what a step may close is bounded by it."""
    found = fold.evaluate(folded(opening), FOLD, np.zeros(6))[1]
    assert found == pytest.approx(opening) if opening < 0.75 else 0.5 < found <= opening


@pytest.mark.parametrize("turn", [0.4, 2.8, -2.0])
@pytest.mark.parametrize("share", [1e-6, 0.3, 0.99])
def test_energy_of_a_fold(share, turn):
    expected = -3.0 * (share - 1) ** 2 * np.log(share)
    assert CORNER.energy(folded(share * LIMIT, turn)) == pytest.approx(expected, rel=1e-9)


@pytest.mark.parametrize(
    "opening", [LIMIT + 1e-9, 0.5, np.pi / 2, 2.0, np.pi, 4.0, 6.0, 2 * np.pi - 1e-9]
)
def test_a_fold_beyond_its_limit_costs_nothing(opening):
    x = folded(opening)
    assert CORNER.energy(x) == 0.0
    assert np.all(CORNER.gradient(x) == 0.0)


def test_closing_takes_infinite_energy():
    assert CORNER.energy(np.array([2.0, 0, 0, 0, 1.0, 0])) == np.inf
    energies = [CORNER.energy(folded(g)) for g in LIMIT * np.logspace(-1e-3, -6.5, 50)]
    assert np.all(np.diff(energies) > 0)
