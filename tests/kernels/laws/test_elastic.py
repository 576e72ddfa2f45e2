"""Elastic laws: stress and tangent are derivatives of the energy, at knots, ends and guard."""

import numpy as np
import pytest

from kernels.laws import elastic
from kernels.laws.elastic import GUARD
from tests.support.kernels.frames import curve_law, linear_law
from tests.support.kernels.terms import differences

MODULUS = 12e6
KNOTS = [-0.5, 0.0, 0.1, 0.4, 1.0]
JUST = 1e-3


def uniaxial(law, strain):
    """Energy density, stress and tangent."""
    return elastic.respond(law, strain)


def errors(curve, strain, step):
    """Errors of stress and tangent against differences of energy and stress, in moduli."""
    at, steps = np.array([strain]), np.array([step])
    _, stress, tangent = uniaxial(curve, strain)
    by_energy = differences(lambda e: uniaxial(curve, e[0])[0], at, steps)[0]
    by_stress = differences(lambda e: uniaxial(curve, e[0])[1], at, steps)[0]
    return abs(stress - by_energy) / curve.modulus, abs(tangent - by_stress) / curve.modulus


@pytest.mark.parametrize("modulus", [MODULUS, 12.0])
@pytest.mark.parametrize(
    "strain", [*(k + side for k in KNOTS for side in (-JUST, JUST)), -0.6, -0.69, 0.25, 1.5, 3.0]
)
def test_stress_and_tangent_are_derivatives(strain, modulus):
    assert max(errors(curve_law(modulus), strain, 1e-4)) < 1e-9


@pytest.mark.parametrize("strain", [GUARD - JUST, GUARD - 0.01, -0.75, -0.9, -0.99])
def test_stress_and_tangent_are_derivatives_under_the_guard(strain):
    size = uniaxial(curve_law(MODULUS), strain)[2] / MODULUS
    assert max(errors(curve_law(MODULUS), strain, 1e-5)) < 1e-7 * max(size, 1.0)


@pytest.mark.parametrize("strain", [*KNOTS, GUARD])
def test_energy_stress_and_tangent_are_continuous(strain):
    curve = curve_law(MODULUS)
    before, after = (np.array(uniaxial(curve, strain + side)) for side in (-1e-9, 1e-9))
    np.testing.assert_allclose(after, before, rtol=0, atol=1e-7 * MODULUS)


def test_rest_is_free_of_energy_and_stress():
    assert uniaxial(curve_law(MODULUS), 0.0) == pytest.approx((0.0, 0.0, MODULUS))


@pytest.mark.parametrize("end", [-0.5, 1.0])
def test_beyond_the_ends_the_last_tangent_continues(end):
    curve = curve_law(MODULUS)
    _, stress, tangent = uniaxial(curve, end)
    for beyond in (0.1, 0.15):
        strain = end + np.copysign(beyond, end)
        reached = uniaxial(curve, strain)
        assert reached[1:] == pytest.approx((stress + tangent * (strain - end), tangent))


@pytest.mark.parametrize("strain", [-0.7, -0.3, 0.0, 0.5, 2.0])
def test_a_linear_law_is_half_the_modulus_times_strain_squared(strain):
    expected = (0.5 * MODULUS * strain**2, MODULUS * strain, MODULUS)
    assert uniaxial(linear_law(MODULUS), strain) == pytest.approx(expected, abs=1e-9 * MODULUS)


def test_crushing_to_nothing_takes_infinite_energy():
    strain = -1.0 + np.logspace(-0.6, -10, 60)
    density, stress, tangent = np.transpose([uniaxial(linear_law(MODULUS), e) for e in strain])
    assert np.all(np.diff(stress) < 0)
    assert np.all(np.diff(density) > 0)
    assert np.all(tangent > MODULUS)
    assert stress[-1] < -1e8 * MODULUS
    assert uniaxial(linear_law(MODULUS), -1.0)[0] == np.inf


def test_the_guard_is_absent_above_its_strain():
    plain = linear_law(MODULUS)
    assert uniaxial(plain, GUARD + 1e-12)[1] == pytest.approx(MODULUS * GUARD, rel=1e-9)
    assert uniaxial(plain, GUARD - 0.05)[1] < MODULUS * (GUARD - 0.05) * (1 + 1e-3)
