"""Stress laws: the records as published, the toe, the compression branch, smoothness."""

import numpy as np
import pytest
from scipy.interpolate import CubicHermiteSpline, PchipInterpolator, PPoly

from kernels.laws.law import Memory
from kernels.laws.yielding import STATE
from sweep.scene import material as laws
from sweep.scene.material import (
    as_law,
    law_in_stretch,
    law_of_section,
    linear_law,
    monotonic_law,
    stress_law,
)
from tests.support.designs.tables import material_with
from tests.support.materials.records import HEADER, RUBBERS


def polynomial(law):
    """The law as scipy evaluates it."""
    return PPoly(law.coefficients[:, ::-1].T, law.knots)


@pytest.fixture(params=RUBBERS)
def material(request):
    return material_with(name=request.param)


@pytest.mark.parametrize(
    ("name", "at_10", "at_100", "modulus"),
    [
        ("ninjaflex", 1.813, 7.032, 19.3),
        ("polymaker_tpu90", 2.806, 9.034, 31.2),
        ("overture_tpu", 4.111, 11.665, 47.0),
        ("cheetah", 6.603, 15.336, 79.65),
        ("filaflex_60a", 0.668, 3.091, 9.65),
        ("ultimaker_tpu95a", 6.603 * 67 / 79.65, 15.336 * 67 / 79.65, 67.0),
    ],
)
def test_records_are_as_published(name, at_10, at_100, modulus):
    law = polynomial(stress_law(material_with(name=name)))
    assert law([0.1, 1.0]) == pytest.approx([at_10 * 1e6, at_100 * 1e6], rel=1e-6)
    assert material_with(name=name).modulus == pytest.approx(modulus * 1e6, rel=2e-3)


def test_law_at_strains_is_its_polynomial_and_beyond_its_ends_the_last_tangent(material):
    law = stress_law(material)
    strain = np.linspace(-0.7, 5.0, 300)
    assert law.at(strain) == pytest.approx(polynomial(law)(strain), rel=1e-12, abs=1e-3)
    for end, beyond in ((-0.7, -0.8), (5.0, 6.0)):
        slope = polynomial(law)(end, 1)
        expected = polynomial(law)(end) + (beyond - end) * slope
        assert law.at(np.array([beyond])) == pytest.approx(expected, rel=1e-9)


def test_law_passes_through_the_record(material):
    law = polynomial(stress_law(material))
    assert law(material.curve_strain) == pytest.approx(material.curve_stress, rel=1e-12)
    assert law(0.0) == 0.0


def test_tension_is_the_shape_preserving_cubic_of_scipy(material):
    """Between the knots above the toe, whose slopes nothing else sets."""
    law = stress_law(material)
    knots = law.knots[law.knots >= 0.0]
    values = polynomial(law)(knots)
    slopes = PchipInterpolator(knots, values).derivative()(knots)
    strain = np.linspace(knots[2], knots[-1], 500)
    assert polynomial(law)(strain) == pytest.approx(
        CubicHermiteSpline(knots, values, slopes)(strain), rel=1e-12
    )


def test_toe_is_straight(material):
    law = polynomial(stress_law(material))
    slope = material.curve_stress[0] / 0.01
    assert slope > 0.0
    assert law(np.linspace(0.0, 0.01, 5), 1) == pytest.approx(slope, rel=1e-9)
    assert law(-1e-9, 1) == pytest.approx(slope, rel=1e-5)


def test_tangent_stays_positive_where_the_record_rises(material):
    strain = np.linspace(-0.7, 5.0, 20_001)
    assert polynomial(stress_law(material))(strain, 1).min() > 0.0


def test_linear_law():
    law = stress_law(material_with(modulus=12e6, density=1190.0))
    assert law.coefficients.shape == (1, 4)
    assert polynomial(law)([-0.5, 0.0, 0.25]) == pytest.approx([-6e6, 0.0, 3e6])


def test_own_compression_branch_is_kept(own_record):
    path = own_record(HEADER + "-0.5,-4e6\n-0.1,-3e5\n0.01,2e4\n0.05,1e5\n0.5,8e5\n")
    law = stress_law(material_with(name=str(path)))
    assert polynomial(law)([-0.5, -0.1, 0.05]) == pytest.approx([-4e6, -3e5, 1e5])
    assert polynomial(law)([-1e-9, 1e-9], 1) == pytest.approx([2e6, 2e6], rel=1e-4)


def test_points_below_one_percent_are_replaced(own_record):
    path = own_record(HEADER + "0,0\n0.002,-500\n0.02,4e4\n0.05,1e5\n")
    law = polynomial(stress_law(material_with(name=str(path))))
    at_toe = -500 + (4e4 + 500) * 8 / 18
    assert law(0.005) == pytest.approx(0.5 * at_toe)


def test_a_record_that_ends_early_goes_on_straight(own_record):
    path = own_record(HEADER + "0.01,2e4\n0.05,1e5\n0.1,2e5\n")
    law = polynomial(stress_law(material_with(name=str(path))))
    assert law(-0.5) == pytest.approx(-0.7 * 1e6 - 0.3 * 2e6 / 0.25, rel=1e-3)


@pytest.mark.parametrize("name", ["pla", "abs"])
def test_a_plastic_is_first_straight_and_then_hardens(name):
    """The curve equals the law of the kernels, strained in one step from rest."""
    material = material_with(name=name)
    law = law_in_stretch(material, 1.0).yielding
    memory = Memory(np.zeros((1, STATE)), np.empty((1, 2)), None)
    for strain in (-0.08, -0.01, 0.0, 0.005, 0.03, 0.09):
        stress = law.respond(strain, memory, 0)[1]
        assert monotonic_law(material).at(np.array([strain])) == pytest.approx(stress, abs=1.0)


def curve_of(law):
    return law.relaxing.elastic.curve


@pytest.mark.parametrize("bend", ["section", "fibres"])
def test_sections_follow_the_law_of_stretching(monkeypatch, bend):
    """Any law, so that one with a formula has a single place."""
    monkeypatch.setattr(laws, "stress_law", lambda material: linear_law(5e6))
    material = material_with(name="ninjaflex", bend=bend)
    found = curve_of(law_of_section.__wrapped__(material, 2.0, 0.0).curve)
    assert found.coefficients[0, 1] == 1e7
    assert curve_of(law_in_stretch.__wrapped__(material, 2.0)).coefficients[0, 1] == 1e7


def test_sections_follow_the_curve_where_stretching_is_linear():
    taut = material_with(name="ninjaflex", stretch="linear", bend="section")
    found = curve_of(law_of_section(taut, 1.0, 0.0).curve)
    expected = as_law(stress_law(material_with(name="ninjaflex")), 1.0, taut.modulus)
    np.testing.assert_array_equal(found.coefficients, expected.coefficients)
    assert stress_law(taut).coefficients.shape == (1, 4)


def test_compression_lies_between_its_two_rules(material):
    """Stress odd in nominal strain, and in log strain of an incompressible bar."""
    law = polynomial(stress_law(material))
    strain = np.linspace(-0.699, -0.01, 500)
    stretch = 1.0 + strain
    odd, incompressible = -law(-strain), -law(1.0 / stretch - 1.0) / stretch**2
    assert law(strain) == pytest.approx(0.7 * odd + 0.3 * incompressible, rel=0.015)
