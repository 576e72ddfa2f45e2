"""Inertia of backward Euler: its derivatives, closed forms, and the kinetic energy."""

import numpy as np
import pytest

from kernels.solve.energy_book import kinetic
from kernels.terms import inertia
from tests.support.kernels.terms import Term, derivative_error

MASS = np.array([2.0, 2.0, 0.5, 0.5, 0.0, 0.0])  # two nodes, then rotations


def term_of(x_pred, mass, dt) -> Term:
    """Inertia with its Hessian."""

    def second(x):
        diagonal = np.zeros_like(x)
        inertia.hessian(mass, dt, diagonal)
        return np.diag(diagonal)

    return Term(lambda x, g: inertia.evaluate(x, x_pred, mass, dt, g), second)


def states(seed, length=1.0):
    """Two states (6,), the second one predicted."""
    return length * np.random.default_rng(seed).uniform(-1, 1, (2, MASS.size))


@pytest.mark.parametrize("dt", [1e-4, 1.0, 30.0])
@pytest.mark.parametrize("length", [1e-3, 1.0, 1e3])
@pytest.mark.parametrize("seed", range(2))
def test_derivatives(seed, length, dt):
    x, x_pred = states(seed, length)
    assert derivative_error(term_of(x_pred, length**-2 * MASS, dt), x, length) < 1e-10


def test_derivatives_where_it_was_going():
    x, _ = states(0)
    term = term_of(x.copy(), MASS, 0.1)
    assert term.energy(x) == 0.0
    assert not term.gradient(x).any()
    assert derivative_error(term, x) < 1e-10


def test_closed_form_of_one_node():
    x, x_pred = np.array([0.3, 0.0]), np.array([0.1, 0.0])
    term = term_of(x_pred, np.array([2.0, 2.0]), 0.5)
    assert term.energy(x) == pytest.approx(0.5 * 2.0 * 0.2**2 / 0.25)
    np.testing.assert_allclose(term.gradient(x), [2.0 * 0.2 / 0.25, 0.0])


def test_a_change_of_velocity_costs_its_kinetic_energy():
    change, x_pred = states(3)
    energy = term_of(x_pred, MASS, 0.2).energy(x_pred + 0.2 * change)
    assert energy == pytest.approx(kinetic(change, MASS), rel=1e-13)
    assert energy == pytest.approx(0.5 * np.sum(MASS * change**2), rel=1e-13)


def test_what_has_no_mass_has_no_force():
    x, x_pred = states(4)
    assert not term_of(x_pred, MASS, 0.1).gradient(x)[4:].any()


def test_the_gradient_is_added_to_what_is_there():
    x, x_pred = states(5)
    g = np.ones_like(x)
    inertia.evaluate(x, x_pred, MASS, 0.1, g)
    np.testing.assert_allclose(g, 1.0 + MASS * (x - x_pred) / 0.01)


def test_the_hessian_is_added_to_what_is_there():
    diagonal = np.ones_like(MASS)
    inertia.hessian(MASS, 0.1, diagonal)
    np.testing.assert_allclose(diagonal, 1.0 + MASS / 0.01)
