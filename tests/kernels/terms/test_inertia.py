"""Inertia of backward Euler: its derivatives, and the kinetic energy."""

import numpy as np
import pytest

from kernels.solve.energy_book import kinetic
from kernels.terms import inertia
from tests.support.kernels.terms import Term, derivative_error

MASS = np.array([2.0, 2.0, 0.5, 0.5, 0.0, 0.0])  # two nodes, then rotations


def term_of(x_pred, mass, dt) -> Term:
    """Inertia with its Hessian."""

    def second(x):
        diagonal = np.ones_like(x)
        inertia.hessian(mass, dt, diagonal)
        return np.diag(diagonal - 1.0)

    return Term(lambda x, g: inertia.evaluate(x, x_pred, mass, dt, g), second)


def states(seed, length=1.0):
    """Two states (6,), the second one predicted."""
    return length * np.random.default_rng(seed).uniform(-1, 1, (2, MASS.size))


@pytest.mark.parametrize("dt", [1e-4, 1.0, 30.0])
@pytest.mark.parametrize("length", [1e-3, 1.0, 1e3])
def test_derivatives(length, dt):
    x, x_pred = states(0, length)
    assert derivative_error(term_of(x_pred, MASS, dt), x, length) < 1e-10
    assert derivative_error(term_of(x_pred, MASS, dt), x_pred, length) < 1e-10


def test_a_change_of_velocity_costs_its_kinetic_energy():
    change, x_pred = states(3)
    g = np.ones_like(x_pred)
    energy = inertia.evaluate(x_pred + 0.2 * change, x_pred, MASS, 0.2, g)
    assert energy == pytest.approx(kinetic(change, MASS), rel=1e-13)
    assert energy == pytest.approx(0.5 * np.sum(MASS * change**2), rel=1e-13)
    np.testing.assert_allclose(g, 1.0 + MASS * change / 0.2)  # added to what is there
