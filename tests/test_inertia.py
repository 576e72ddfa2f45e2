"""Inertia of backward Euler: its derivatives, closed forms, and the kinetic energy."""

from types import SimpleNamespace

import numpy as np
import pytest

from kernels import inertia
from tests.terms import derivative_error, gradient_of, hessian_of

MASS = np.array([2.0, 2.0, 0.5, 0.5, 0.0, 0.0])  # two nodes, then rotations


def _hessian(_, x_pred, mass, dt, matrix, projected):
    inertia.hessian(mass, dt, matrix)


TERM = SimpleNamespace(energy=inertia.energy, gradient=inertia.gradient, hessian=_hessian)


def states(seed, length=1.0):
    """Two states (6,), the second one predicted."""
    return length * np.random.default_rng(seed).uniform(-1, 1, (2, MASS.size))


@pytest.mark.parametrize("dt", [1e-4, 1.0, 30.0])
@pytest.mark.parametrize("length", [1e-3, 1.0, 1e3])
@pytest.mark.parametrize("seed", range(2))
def test_derivatives(seed, length, dt):
    x, x_pred = states(seed, length)
    assert derivative_error(TERM, (x_pred, length**-2 * MASS, dt), x, length) < 1e-10


def test_derivatives_where_it_was_going():
    x, _ = states(0)
    args = x.copy(), MASS, 0.1
    assert inertia.energy(x, *args) == 0.0
    assert not gradient_of(TERM, args, x).any()
    assert derivative_error(TERM, args, x) < 1e-10


def test_closed_form_of_one_node():
    x, x_pred = np.array([0.3, 0.0]), np.array([0.1, 0.0])
    args = x_pred, np.array([2.0, 2.0]), 0.5
    assert inertia.energy(x, *args) == pytest.approx(0.5 * 2.0 * 0.2**2 / 0.25)
    np.testing.assert_allclose(gradient_of(TERM, args, x), [2.0 * 0.2 / 0.25, 0.0])
    np.testing.assert_allclose(hessian_of(TERM, args, x), np.diag([8.0, 8.0]))


def test_a_change_of_velocity_costs_its_kinetic_energy():
    change, x_pred = states(3)
    energy = inertia.energy(x_pred + 0.2 * change, x_pred, MASS, 0.2)
    assert energy == pytest.approx(inertia.kinetic(change, MASS), rel=1e-13)
    assert energy == pytest.approx(0.5 * np.sum(MASS * change**2), rel=1e-13)


def test_what_has_no_mass_has_no_entries():
    x, x_pred = states(4)
    args = x_pred, MASS, 0.1
    assert not gradient_of(TERM, args, x)[4:].any()
    np.testing.assert_allclose(hessian_of(TERM, args, x), np.diag(MASS) / 0.01, rtol=1e-14)
