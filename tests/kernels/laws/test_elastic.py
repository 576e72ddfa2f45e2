"""Elastic laws: stress and tangent are derivatives of the energy, at knots, ends and guard."""

import numpy as np
import pytest

from kernels.laws.elastic import GUARD, respond
from tests.support.kernels.frames import curve_law, linear_law
from tests.support.kernels.terms import law_errors

MODULUS = 12e6
KNOTS = [-0.5, 0.0, 0.1, 0.4, 1.0]
JUST = 1e-3
CURVE = curve_law(MODULUS)


@pytest.mark.parametrize(
    ("strain", "step", "within"),
    [
        *((k + side, 1e-4, 1e-9) for k in KNOTS for side in (-JUST, JUST)),
        *((e, 1e-4, 1e-9) for e in (-0.6, -0.69, 0.25, 1.5, 3.0)),
        *((e, 1e-5, 1e-7) for e in (GUARD - JUST, GUARD - 0.01, -0.75, -0.9, -0.99)),
    ],
)
def test_stress_and_tangent_are_derivatives(strain, step, within):
    size = max(respond(CURVE, strain)[2], MODULUS)
    assert max(law_errors(lambda e: respond(CURVE, e), strain, step)) < within * size


@pytest.mark.parametrize("strain", [*KNOTS, GUARD])
def test_energy_stress_and_tangent_are_continuous(strain):
    before, after = (np.array(respond(CURVE, strain + side)) for side in (-1e-9, 1e-9))
    np.testing.assert_allclose(after, before, rtol=0, atol=1e-7 * MODULUS)


def test_rest_is_free_of_energy_and_stress():
    assert respond(CURVE, 0.0) == pytest.approx((0.0, 0.0, MODULUS))


@pytest.mark.parametrize("strain", [-0.65, 1.15])
def test_beyond_the_ends_the_last_tangent_continues(strain):
    end = min(max(strain, KNOTS[0]), KNOTS[-1])
    _, stress, tangent = respond(CURVE, end)
    assert respond(CURVE, strain)[1:] == pytest.approx((stress + tangent * (strain - end), tangent))


@pytest.mark.parametrize("strain", [GUARD, -0.3, 0.0, 0.5, 2.0])
def test_a_linear_law_is_half_the_modulus_times_strain_squared(strain):
    expected = (0.5 * MODULUS * strain**2, MODULUS * strain, MODULUS)
    assert respond(linear_law(MODULUS), strain) == pytest.approx(expected, abs=1e-9 * MODULUS)


def test_crushing_to_nothing_takes_infinite_energy():
    strain = -1.0 + np.logspace(-0.6, -7, 60)
    density, stress, tangent = np.transpose([respond(linear_law(MODULUS), e) for e in strain])
    assert np.all(np.diff(stress) < 0)
    assert np.all(np.diff(density) > 0)
    assert np.all(tangent > MODULUS)
    assert stress[-1] < -1e5 * MODULUS
    assert respond(linear_law(MODULUS), -1.0)[0] == np.inf
