"""Damping: Rayleigh is the quadratic form of the projected Hessian, Kelvin-Voigt is objective."""

import numpy as np
import pytest

from kernels import bend, damp, stretch
from tests.frames import (
    carried,
    curve_law,
    frame,
    joint_of_four,
    linear_law,
    scaled,
    shaken,
    terms_of,
)
from tests.terms import derivative_error, gradient_of, hessian_of, least_share

FRAME = joint_of_four()
DT = 0.02
MASS, RAYLEIGH, VISCOUS = damp.Damp(3.0, 0, 0), damp.Damp(3.0, 0.5, 0), damp.Damp(0, 0, 0.4)
ALL = damp.Damp(3.0, 0.5, 0.4)
MODELS = [MASS, RAYLEIGH, VISCOUS, ALL]
MEASURES = [bend.ANGLE, bend.TANGENT]


def args_of(of, x0, damping, measure=bend.ANGLE, law=curve_law):
    return x0, terms_of(of, law(of.modulus), measure, damp.Damp(*map(float, damping))), DT


@pytest.mark.parametrize("measure", MEASURES)
@pytest.mark.parametrize("damping", MODELS)
@pytest.mark.parametrize("seed", range(2))
def test_derivatives_in_random_states(seed, damping, measure):
    args = args_of(FRAME, shaken(FRAME, 10 + seed), damping, measure)
    assert derivative_error(damp, args, shaken(FRAME, seed), FRAME.unit, 3e-4) < 1e-7


@pytest.mark.parametrize("damping", [RAYLEIGH, VISCOUS])
@pytest.mark.parametrize("length", [1e-3, 1e3])
def test_derivatives_in_other_units(damping, length):
    of = scaled(FRAME, length)
    args = args_of(of, shaken(of, 10), damping)
    assert derivative_error(damp, args, shaken(of, 1), of.unit, 3e-4) < 1e-7


@pytest.mark.parametrize("damping", MODELS)
def test_a_step_that_stays_costs_nothing(damping):
    x = shaken(FRAME, 2)
    args = args_of(FRAME, x, damping)
    assert damp.energy(x, *args) < 1e-20
    assert np.abs(gradient_of(damp, args, x)).max() < 1e-10
    assert derivative_error(damp, args, x, FRAME.unit, 3e-4) < 1e-7


@pytest.mark.parametrize("measure", MEASURES)
@pytest.mark.parametrize("seed", range(3))
def test_rayleigh_is_mass_and_projected_stiffness(seed, measure):
    """C / dt = (alpha M + beta K) / dt with the very K that stretch and bend project at x0."""
    x0, x = shaken(FRAME, seed, 0.3), shaken(FRAME, 20)
    args = args_of(FRAME, x0, RAYLEIGH, measure)
    terms = args[1]
    elastic = hessian_of(stretch, (terms.stretch, terms.law), x0, True)
    elastic += hessian_of(bend, (terms.bend,), x0, True)
    expected = (3.0 * np.diag(terms.mass) + 0.5 * elastic) / DT
    np.testing.assert_allclose(
        hessian_of(damp, args, x), expected, rtol=0, atol=1e-12 * np.abs(expected).max()
    )
    move = x - x0
    assert damp.energy(x, *args) == pytest.approx(0.5 * move @ expected @ move, rel=1e-12)
    assert gradient_of(damp, args, x) @ move == pytest.approx(2 * damp.energy(x, *args))


@pytest.mark.parametrize("seed", range(3))
def test_viscous_stiffness_at_rest_is_the_elastic_one(seed):
    """Kelvin-Voigt: relaxation time x the stiffness of the straight frame, couplings included."""
    args = args_of(FRAME, FRAME.rest, VISCOUS, law=linear_law)
    terms = args[1]
    elastic = hessian_of(stretch, (terms.stretch, terms.law), FRAME.rest)
    elastic += hessian_of(bend, (terms.bend,), FRAME.rest)
    expected = 0.4 / DT * elastic
    found = hessian_of(damp, args, FRAME.rest)
    np.testing.assert_allclose(found, expected, rtol=0, atol=1e-12 * np.abs(expected).max())
    small = 1e-5 * (shaken(FRAME, seed) - FRAME.rest)
    work = gradient_of(damp, args, FRAME.rest + small) @ small
    assert work == pytest.approx(small @ expected @ small, rel=1e-3)


@pytest.mark.parametrize("turn", [0.0, 0.3, 2.5, 7.0])
def test_a_rigid_motion_has_no_viscous_cost(turn):
    x0 = shaken(FRAME, 4)
    x = carried(FRAME, x0, turn)
    args = args_of(FRAME, x0, VISCOUS)
    apart = damp.energy(shaken(FRAME, 5), *args)
    assert apart > 1.0
    assert damp.energy(x, *args) < 1e-20 * apart
    assert np.abs(gradient_of(damp, args, x)).max() < 1e-9


@pytest.mark.parametrize("turn", [0.5, 3.0])
def test_viscous_cost_is_objective(turn):
    x0, x = shaken(FRAME, 4), shaken(FRAME, 5)
    plain = damp.energy(x, *args_of(FRAME, x0, VISCOUS))
    both = damp.energy(carried(FRAME, x, turn), *args_of(FRAME, carried(FRAME, x0, 1.0), VISCOUS))
    assert both == pytest.approx(plain, rel=1e-11)


@pytest.mark.parametrize("damping", MODELS)
@pytest.mark.parametrize("seed", range(3))
def test_projected_hessian_is_semi_definite(seed, damping):
    args = args_of(FRAME, shaken(FRAME, seed + 30, 0.4), damping)
    assert least_share(damp, args, shaken(FRAME, seed, 0.4), FRAME.unit) > -1e-12


@pytest.mark.parametrize("seed", range(3))
def test_projected_viscous_moments_are_semi_definite_without_stretch(seed):
    x0, (_, terms, _) = shaken(FRAME, seed + 30, 0.4), args_of(FRAME, FRAME.rest, VISCOUS)
    args = x0, terms._replace(law=terms.law._replace(modulus=0.0)), DT
    x = shaken(FRAME, seed, 0.4)
    assert np.linalg.eigvalsh(hessian_of(damp, args, x))[0] < -1.0
    assert least_share(damp, args, x, FRAME.unit) > -1e-12


def test_the_exact_viscous_hessian_can_be_indefinite():
    x0, x = shaken(FRAME, 30, 0.4), shaken(FRAME, 0, 0.4)
    values = np.linalg.eigvalsh(hessian_of(damp, args_of(FRAME, x0, VISCOUS), x))
    assert values[0] < -1.0


def test_viscous_stress_of_a_bar_that_is_pulled():
    of = frame([(0, 0), (2.0, 0)], [(0, 1)], 1)
    x = of.rest.copy()
    x[2] = 2.1
    args = args_of(of, of.rest, VISCOUS)
    force = 0.4 * of.modulus * 0.8 * of.depth * 0.05 / DT
    assert gradient_of(damp, args, x)[2] == pytest.approx(force)
    assert damp.energy(x, *args) == pytest.approx(0.5 * force * 0.1)
