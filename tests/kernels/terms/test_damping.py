"""Damping: Rayleigh is the quadratic form of the projected Hessian, Kelvin-Voigt is objective."""

import numpy as np
import pytest

from kernels.terms import bend, damping, elements, kelvin_voigt, stretch
from tests.support.kernels.frames import (
    carried,
    curve_law,
    frame,
    joint_of_four,
    linear_law,
    point_of,
    scaled,
    shaken,
    terms_of,
)
from tests.support.kernels.terms import (
    NO_MEMORY,
    Term,
    before_of,
    damping_of,
    derivative_error,
    of_walls,
)

FRAME = joint_of_four()
DT = 0.02
RAYLEIGH, VISCOUS = damping.Damp(3.0, 0.5, 0.0), damping.Damp(0.0, 0.0, 0.4)
MODELS = [damping.Damp(3.0, 0.0, 0.0), RAYLEIGH, VISCOUS, damping.Damp(3.0, 0.5, 0.4)]
MEASURES = [bend.ANGLE, bend.TANGENT]


def damped(of, model, measure=bend.ANGLE, law=curve_law):
    return terms_of(of, point_of(law(of.modulus)), measure, model)


def term_of(terms, x0) -> Term:
    return damping_of(terms, x0, DT)


def elastic(terms, x, projected=False):
    """Hessian of stretching and bending."""

    def write(shape, resultants, projected):
        value = stretch.evaluate(terms.stretch, terms.law, NO_MEMORY, shape, resultants, projected)
        return value + bend.evaluate(
            terms.bend, terms.stretch, NO_MEMORY, shape, resultants, projected
        )

    return of_walls(terms.walls, write).hessian(x, projected)


@pytest.mark.parametrize("measure", MEASURES)
@pytest.mark.parametrize("damping", MODELS)
@pytest.mark.parametrize("length", [1.0, 1e-3])
def test_derivatives_in_random_states(length, damping, measure):
    of = scaled(FRAME, length)
    term = term_of(damped(of, damping, measure), shaken(of, 10))
    assert derivative_error(term, shaken(of, 1), of.unit, 3e-4) < 1e-7


@pytest.mark.parametrize("damping", MODELS)
def test_a_step_that_stays_costs_nothing(damping):
    x = shaken(FRAME, 2)
    term = term_of(damped(FRAME, damping), x)
    assert term.energy(x) < 1e-20
    assert np.abs(term.gradient(x)).max() < 1e-10
    assert derivative_error(term, x, FRAME.unit, 3e-4) < 1e-7


@pytest.mark.parametrize("measure", MEASURES)
@pytest.mark.parametrize("seed", range(3))
def test_rayleigh_is_mass_and_projected_stiffness(seed, measure):
    """C / dt = (alpha M + beta K) / dt with the very K that stretch and bend project at x0."""
    x0, x = shaken(FRAME, seed, 0.3), shaken(FRAME, 20)
    terms = damped(FRAME, RAYLEIGH, measure)
    term = term_of(terms, x0)
    expected = (3.0 * np.diag(terms.coordinates.mass) + 0.5 * elastic(terms, x0, True)) / DT
    np.testing.assert_allclose(
        term.hessian(x), expected, rtol=0, atol=1e-12 * np.abs(expected).max()
    )
    move = x - x0
    assert term.energy(x) == pytest.approx(0.5 * move @ expected @ move, rel=1e-12)
    assert term.gradient(x) @ move == pytest.approx(2 * term.energy(x))


def test_viscous_stiffness_at_rest_is_the_elastic_one():
    """Kelvin-Voigt: relaxation time x the stiffness of the straight frame, couplings included."""
    terms = damped(FRAME, VISCOUS, law=linear_law)
    term = term_of(terms, FRAME.rest)
    expected = 0.4 / DT * elastic(terms, FRAME.rest)
    np.testing.assert_allclose(
        term.hessian(FRAME.rest), expected, rtol=0, atol=1e-12 * np.abs(expected).max()
    )


@pytest.mark.parametrize("turn", [0.5, 2.5])
def test_viscous_cost_is_objective(turn):
    """Motions are less than half a turn: turns are measured against the start of the step."""
    terms, x0, x = damped(FRAME, VISCOUS), shaken(FRAME, 4), shaken(FRAME, 5)
    plain, turned = term_of(terms, x0), term_of(terms, carried(FRAME, x0, 1.0))
    assert plain.energy(x) > 1.0
    assert turned.energy(carried(FRAME, x, turn)) == pytest.approx(plain.energy(x), rel=1e-11)
    moved = carried(FRAME, x0, turn)
    assert plain.energy(moved) < 1e-20 * plain.energy(x)
    assert np.abs(plain.gradient(moved)).max() < 1e-9


def test_viscous_stress_of_a_bar_that_is_pulled():
    of = frame([(0, 0), (2.0, 0)], [(0, 1)], 1)
    x = of.rest.copy()
    x[2] = 2.1
    term = term_of(damped(of, VISCOUS), of.rest)
    force = 0.4 * of.modulus * 0.8 * of.depth * 0.05 / DT
    assert term.gradient(x)[2] == pytest.approx(force)
    assert term.energy(x) == pytest.approx(0.5 * force * 0.1)


def measured(terms, x):
    """Strains and turns."""
    before = before_of(terms, FRAME.rest)
    elements.measure(x, terms.walls, before.frame, before.shape)
    kelvin_voigt.measure(terms, before.shape, before.strain)
    return before


def in_a_row(before):
    return np.concatenate([before.strain, *before.shape.turn])


@pytest.mark.parametrize("seed", range(3))
def test_rates_of_strains_and_turns_are_their_derivatives(seed):
    terms, x, v = damped(FRAME, VISCOUS), shaken(FRAME, seed), shaken(FRAME, 40 + seed)
    before = measured(terms, x)
    start = in_a_row(before)
    kelvin_voigt.advance(terms, v, 0.5, before.shape, before.strain)
    slope = (
        in_a_row(measured(terms, x + 1e-6 * v)) - in_a_row(measured(terms, x - 1e-6 * v))
    ) / 2e-6
    assert np.count_nonzero(slope) > 0.7 * slope.size
    np.testing.assert_allclose(in_a_row(before) - start, 0.5 * slope, rtol=0, atol=1e-7)
