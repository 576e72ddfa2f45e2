"""Separable energies: the function of one stretch behind a nominal stress curve."""

import numpy as np
import pytest

from kernels.laws import separable
from tests.support.kernels.sheets import LEAST, MODULUS, measured, nominal, rubber

MATERIALS = ["ninjaflex", "ultimaker_tpu95a", "filaflex_60a"]


@pytest.fixture(scope="module", params=MATERIALS)
def material(request):
    """Nominal stress, x, h and its slope, and the slope of S at rest."""
    curve = nominal(request.param)
    size = separable.continued(curve, curve.law.knots[0], np.zeros(1))[1][0]
    return curve, *separable.rising(curve, curve.law.knots[0]), size


def test_rubber_has_its_own_function():
    """H = mu (l^2 - 1), wherever the nominal stress is not continued."""
    x, value, slope = separable.rising(rubber, LEAST)
    inside = np.abs(x) < -np.log1p(LEAST)
    for found, expected in ((value, np.expm1(2.0 * x)), (slope, 2.0 * np.exp(2.0 * x))):
        expected = MODULUS / 3.0 * expected
        np.testing.assert_allclose(found[inside], expected[inside], rtol=1e-12, atol=1e-12)


def test_the_sum_solves_the_equation():
    x = np.array([-2.0, -0.3, -1e-5, 0.0, 0.02, 0.7, 3.0])
    for name in MATERIALS:
        curve = nominal(name)
        least = curve.law.knots[0]
        one, two = (separable.principal(curve, least, at) for at in (x, -0.5 * x))
        stress, rise = separable.continued(curve, least, x)
        np.testing.assert_allclose(one[0] - two[0], stress, rtol=1e-12, atol=1e-6)
        np.testing.assert_allclose(one[1] + 0.5 * two[1], rise, rtol=1e-9)


def test_the_function_rises(material):
    _, _, value, slope, size = material
    assert slope.min() >= (2.0 / 3.0) * separable.LEAST * size * (1 - 1e-12)
    assert np.all(np.diff(value) > 0.0)


def test_tension_is_that_of_the_curve(material):
    curve, x, value, _, _ = material
    at = x[x > 0.0][separable.OCTAVE :]
    stress = np.interp(at, x, value) - np.interp(-0.5 * at, x, value)
    expected = separable.continued(curve, curve.law.knots[0], at)[0]
    np.testing.assert_allclose(stress, expected, rtol=1e-9)


def test_compression_is_that_of_the_curve_until_it_would_be_unstable():
    for name, until in (("ninjaflex", 0.2), ("ultimaker_tpu95a", 0.1)):
        curve = nominal(name)
        x, value, _ = separable.rising(curve, curve.law.knots[0])
        at = x[x < 0.0][: -separable.OCTAVE]
        stress = np.interp(at, x, value) - np.interp(-0.5 * at, x, value)
        ratio = stress / separable.continued(curve, curve.law.knots[0], at)[0]
        stable = at > np.log1p(-until)
        np.testing.assert_allclose(ratio[stable], 1.0, rtol=0, atol=1e-4)
        measured = at > np.log1p(-0.7)
        assert np.all(ratio > 1.0 - 1e-4)
        assert 1.1 < ratio[measured].max() < 1.4


def test_the_cubics_between_values_and_slopes_hardly_fall(material):
    _, x, value, slope, size = material
    rows, _ = separable.cubics(x, value, slope)
    s = np.linspace(0.0, 1.0, 21)[:, None] * np.diff(x)
    between = rows[:, 1] + s * (2.0 * rows[:, 2] + s * 3.0 * rows[:, 3])
    assert between.min() > -0.01 * size


def test_slopes_of_the_continued_stress_are_derivatives(material):
    curve = material[0]
    for x in (-3.0, np.log(0.3) - 0.01, -0.5, 0.3, 2.5):
        value = [separable.continued(curve, -0.7, np.array([x + d]))[0][0] for d in (-1e-5, 1e-5)]
        slope = separable.continued(curve, -0.7, np.array([x]))[1][0]
        assert (value[1] - value[0]) / 2e-5 == pytest.approx(slope, rel=1e-4)


def test_a_cauchy_stress_that_falls_is_refused():
    def yielding(strain):
        return strain / (1.0 + strain**2), (1.0 - strain**2) / (1.0 + strain**2) ** 2

    with pytest.raises(ValueError, match="must rise with the stretch"):
        separable.rising(yielding, -0.5)


def test_cubics_have_their_values_slopes_and_integral():
    x = np.array([-0.5, -0.1, 0.0, 0.2, 1.0])
    rows, energy = separable.cubics(x, x**3 - x, 3 * x**2 - 1)
    np.testing.assert_allclose(rows[:, 3], 1.0, rtol=1e-12)
    np.testing.assert_allclose(energy, x**4 / 4 - x**2 / 2, atol=1e-14)


def test_the_piece_of_a_stretch_needs_no_search():
    """Stretches at the knots, beside them, between and beyond them."""
    curve = measured("ninjaflex").curve
    knots, last = curve.knots, curve.knots.size - 2
    inner = np.random.default_rng(3).uniform(1.1 * knots[0], 1.1 * knots[-1], 400)
    x = np.concatenate([knots, np.nextafter(knots, -9.0), np.nextafter(knots, 9.0), inner])
    x = np.concatenate([x, 1e-3 * inner, [0.0, -0.0, 1e-300, -1e-300]])
    expected = np.clip(np.searchsorted(knots, x, side="right") - 1, 0, last)
    assert [separable.piece(curve, at) for at in x] == expected.tolist()
    assert 0 <= separable.piece(curve, np.nan) <= last
