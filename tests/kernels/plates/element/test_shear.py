"""Transverse shear by MITC4: derivatives, energy of uniform shear, rest."""

import numpy as np
import pytest

from kernels.plates.element import shear
from tests.support.kernels.terms import Term, derivative_error

SIZE, STIFFNESS = np.array([0.5, 0.8]), (3.0, 2.0)
FLAT = np.array([[0, 0, 0], [0.5, 0, 0], [0.5, 0.8, 0], [0, 0.8, 0.0]])


def state(directors, points=FLAT):
    return np.hstack([points, np.broadcast_to(directors, (4, 3))]).ravel()


def term(rest):
    def slope(q, g):
        return shear.evaluate(q, SIZE, rest, STIFFNESS, g)

    def second(q):
        full = np.zeros((24, 24))
        rows, pushed, inner = np.empty((7, 24)), np.empty((7, 24)), np.empty((7, 7))
        shear.hessian(q, SIZE, rest, STIFFNESS, rows, pushed, inner, full)
        return full

    return Term(slope, second)


@pytest.mark.parametrize("rest", [np.zeros(4), np.array([0.1, -0.2, 0.3, 0.05])])
@pytest.mark.parametrize("seed", [None, 0, 1])
def test_derivatives(rest, seed):
    q = state([0.0, 0.0, 1.0])
    if seed is not None:
        q += np.random.default_rng(seed).uniform(-0.5, 0.5, 24)
    assert derivative_error(term(rest), q, 1.0, 1e-3) < 1e-9


@pytest.mark.parametrize("g", [(0.1, 0.0), (0.0, -0.2), (0.3, 0.4)])
def test_uniform_shear(g):
    """Kappa G t area / 2 |g|^2, with g = x,a . d; stiffness: kappa G t area."""
    q = state([*g, 1.0])
    energy = shear.evaluate(q, SIZE, np.zeros(4), STIFFNESS, np.zeros(24))
    assert energy == pytest.approx(0.5 * np.dot(STIFFNESS, np.square(g)), rel=1e-14)
    at_rest = shear.evaluate(q, SIZE, np.repeat(g, 2), STIFFNESS, np.zeros(24))
    assert at_rest == pytest.approx(0.0, abs=1e-30)


def test_shear_that_is_linear_across_is_integrated_exactly():
    """g_s = 1 - z / h_z by the directors: mean square 1/3."""
    directors = np.array([[1.0, 0, 1], [1, 0, 1], [0, 0, 1], [0, 0, 1]])
    energy = shear.evaluate(state(directors), SIZE, np.zeros(4), STIFFNESS, np.zeros(24))
    assert energy == pytest.approx(0.5 * STIFFNESS[0] / 3.0)


def test_pure_bending_has_no_shear():
    """The field that locks a plain bilinear quad: directors turn while the edges stay straight."""
    turn = 0.2
    directors = np.array([[-turn, 0, 1], [turn, 0, 1], [turn, 0, 1], [-turn, 0, 1]])
    energy = shear.evaluate(state(directors), SIZE, np.zeros(4), STIFFNESS, np.zeros(24))
    assert energy == pytest.approx(0.0, abs=1e-30)


def test_stiffness_is_that_of_shear_in_small_elements_and_of_bending_in_long_ones():
    modulus, thickness = 3.0, 0.1
    small = shear.stiffnesses(modulus, thickness, (1e-4, 1e-3), 1e-7)
    assert small == pytest.approx((modulus * thickness * 1e-7,) * 2, rel=1e-4)
    d = modulus / shear.KAPPA * thickness**3 / 3
    long = shear.stiffnesses(modulus, thickness, (1e3, 1e-3), 1.0)
    assert long[0] == pytest.approx(d / shear.BETA / 1e6, rel=1e-4)
    assert long[1] == pytest.approx(modulus * thickness, rel=1e-4)


def test_a_strained_wall_is_as_stiff_as_one_of_rubber():
    """C33 = (1 + C_a3 adj(A)_ab C_b3) / det A, with C_a3 = g_a (det A)^(-1/2)."""
    f, g = np.array([[0.8, 0.0], [0.1, 1.1], [0.0, 0.3]]), np.array([0.02, -0.03])
    a = f.T @ f
    normal = np.cross(*f.T) / np.sqrt(np.linalg.det(a))
    directors = f @ np.linalg.solve(a, g) + normal  # of which x,a . d = g
    q = state(directors, (f @ FLAT[:, :2].T).T)
    across = g / np.sqrt(np.linalg.det(a))
    adjugate = np.linalg.det(a) * np.linalg.inv(a)
    expected = 0.5 * across @ adjugate @ across / np.linalg.det(a)
    found = shear.evaluate(q, SIZE, np.zeros(4), (1.0, 1.0), np.zeros(24))
    assert found == pytest.approx(expected, rel=1e-12)


def test_an_element_without_area_takes_infinite_energy():
    q = state([0.1, 0.0, 1.0], FLAT * [1.0, 0.0, 1.0])
    assert shear.evaluate(q, SIZE, np.zeros(4), STIFFNESS, np.zeros(24)) == np.inf
