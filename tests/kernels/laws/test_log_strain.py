"""Logarithmic strains of sheets: the matrix logarithm, derivatives, equal stretches."""

import numpy as np
import pytest

from kernels.laws import log_strain
from tests.support.kernels.sheets import strain
from tests.support.kernels.terms import law_errors

STRESS = (0.7, -0.4, 0.3)
PRINCIPAL = [(1.0, 1.0), (1.3, 0.8), (0.5, 0.5), (2.0, 1.1), (1.05, 0.96), (1.0 + 1e-9, 1.0)]
ANGLES = pytest.mark.parametrize("angle", [0.0, 0.4])


@ANGLES
@pytest.mark.parametrize("stretches", [*PRINCIPAL, (1e-3, 1.0), (40.0, 0.1)])
def test_it_is_the_logarithm_of_the_stretches(stretches, angle):
    logarithms = 10.0 * strain(np.sqrt(1.0 + 0.1 * np.log(stretches)), angle)
    found = log_strain.strain(*strain(stretches, angle))
    np.testing.assert_allclose(found, logarithms, rtol=0, atol=1e-9)


def test_a_small_strain_loses_no_digits():
    found = log_strain.strain(2e-12, -1e-12, 0.5e-12)
    assert found == pytest.approx((1e-12, -0.5e-12, 0.25e-12), rel=1e-10)


@ANGLES
@pytest.mark.parametrize("stretches", PRINCIPAL)
def test_derivatives(stretches, angle):
    at = strain(stretches, angle)
    one, two, both = log_strain.strain(*at)
    product = STRESS[0] * one + STRESS[1] * two + 2.0 * STRESS[2] * both
    assert log_strain.respond(STRESS, *at)[0] == pytest.approx(product, rel=1e-13, abs=1e-15)
    in_slopes, in_tangent = law_errors(lambda *c: log_strain.respond(STRESS, *c), at, 1e-5)
    assert in_slopes < 1e-8
    assert in_tangent < 1e-7


def test_the_sum_of_powers_goes_over_into_the_closed_form():
    at = log_strain.SMALL
    below, above = log_strain._slopes(at * (1.0 - 1e-12)), log_strain._slopes(at * (1.0 + 1e-12))
    np.testing.assert_allclose(below, above, rtol=1e-10)
