"""Sheets in plane stress: derivatives, closed forms of rubber, measured curves, collapse."""

import numpy as np
import pytest

from kernels.laws.sheet import neo_hookean
from tests.support.kernels.sheets import MODULUS, measured, nominal, sheet_of_rubber, strain
from tests.support.kernels.terms import law_errors

MU = MODULUS / 3.0
LAWS = {
    "linear": neo_hookean(MODULUS),
    "rubber": sheet_of_rubber(),
    "ninjaflex": measured("ninjaflex"),
}
MODULI = {"linear": MODULUS, "rubber": MODULUS, "ninjaflex": 24.8e6}
PRINCIPAL = [(1.0, 1.0), (1.3, 0.8), (0.6, 0.6), (2.0, 1.1), (0.4, 2.5), (1.0 + 1e-9, 1.0)]


@pytest.mark.parametrize("name", LAWS)
@pytest.mark.parametrize("stretches", PRINCIPAL)
@pytest.mark.parametrize("angle", [0.0, 0.4])
def test_stress_and_tangent_are_derivatives(name, stretches, angle):
    respond, at = LAWS[name].respond, strain(stretches, angle)
    in_stress, in_tangent = law_errors(respond, at, 2e-6)
    size = np.abs(respond(*at)[2]).max()
    assert in_stress < 1e-8 * size
    assert in_tangent < 3e-5 * size


@pytest.mark.parametrize("name", LAWS)
@pytest.mark.parametrize("stretch", [0.7, 1.0, 1.4])
def test_the_tangent_of_nearly_equal_stretches(name, stretch):
    """It equals the tangent of equal stretches, as far as it depends on the difference smoothly."""
    law = LAWS[name]
    equal = np.array(law.respond(*strain((stretch, stretch), 0.0))[2])
    for apart in (1e-3, 1e-5, 1e-7, 1e-12, 0.0):
        near = np.array(law.respond(*strain((stretch + apart, stretch - apart), 0.7))[2])
        np.testing.assert_allclose(near, equal, rtol=0, atol=(400.0 * apart + 1e-8) * MODULI[name])


@pytest.mark.parametrize("name", ["linear", "rubber"])
@pytest.mark.parametrize("stretch", [0.5, 0.9, 1.0, 1.2, 3.0])
def test_uniaxial_stress_of_rubber(stretch, name):
    """Mu (l - 1 / l^2) along, none across."""
    slopes = LAWS[name].respond(*strain((stretch, stretch**-0.5)))[1]
    expected = MU * (stretch - stretch**-2)
    assert 2.0 * stretch * slopes[0] == pytest.approx(expected, abs=1e-5 * MODULUS)
    assert slopes[1:] == pytest.approx((0.0, 0.0), abs=1e-12 * MODULUS)


@pytest.mark.parametrize("name", ["linear", "rubber"])
@pytest.mark.parametrize("stretch", [0.6, 0.95, 1.0, 1.3])
def test_equibiaxial_stress_of_rubber(stretch, name):
    """The stress is mu (l - 1 / l^5)."""
    one, two, _ = LAWS[name].respond(*strain((stretch, stretch)))[1]
    expected = MU * (stretch - stretch**-5)
    assert 2.0 * stretch * one == pytest.approx(expected, abs=1e-4 * MODULUS)
    assert two == pytest.approx(one)


@pytest.mark.parametrize("name", ["ninjaflex", "ultimaker_tpu95a", "filaflex_60a"])
def test_uniaxial_stress_of_a_measured_curve(name):
    """Exact in tension; in compression while that is stable, then stiffer."""
    law, curve = measured(name), nominal(name)
    stretches = 1.0 + np.array([0.005, 0.1, 0.5, 1.0, 3.0, -0.05, -0.15])
    for stretch, expected in zip(stretches, curve(stretches - 1.0)[0], strict=True):
        slopes = law.respond(*strain((stretch, stretch**-0.5)))[1]
        stiffer = 0.03 if stretch < 1.0 else 3e-5
        assert 2.0 * stretch * slopes[0] == pytest.approx(expected, rel=stiffer)
        assert slopes[1] == pytest.approx(0.0, abs=1e-9 * abs(expected))


@pytest.mark.parametrize("name", LAWS)
def test_rest_is_free_of_stress_and_has_the_moduli_of_plane_stress(name):
    energy, slopes, tangent = LAWS[name].respond(0.0, 0.0, 0.0)
    y = 3.0 * LAWS[name].shear_modulus
    assert (energy, *slopes) == pytest.approx((0.0,) * 4, abs=1e-12 * y)
    expected = y / 3.0 * np.array([1.0, 0.5, 0.0, 1.0, 0.0, 1.0])
    np.testing.assert_allclose(tangent, expected, rtol=1e-9, atol=1e-9 * y)


@pytest.mark.parametrize("name", LAWS)
@pytest.mark.parametrize("side", [1.0, 0.2, 5.0])
def test_a_stretch_that_goes_to_zero_takes_infinite_energy(name, side):
    law = LAWS[name]
    found = [law.respond(*strain((10.0**-k, side), 0.2))[0] for k in np.linspace(1, 6, 20)]
    assert np.all(np.diff(found) > 0.02 * MODULI[name])
    assert law.respond(-1.0, 0.0, 0.0)[0] == np.inf
    assert law.respond(-1.5, -1.5, 0.0)[0] == np.inf
    assert law.respond(0.0, 0.0, 1.5)[0] == np.inf


@pytest.mark.parametrize("name", LAWS)
def test_small_strains_lose_no_digits(name):
    law, small = LAWS[name], 1e-7
    y = 3.0 * law.shear_modulus
    energy, slopes, _ = law.respond(2 * small, -small, 0.0)
    assert slopes[0] == pytest.approx(y / 3.0 * 1.5 * small, rel=1e-5)
    assert energy == pytest.approx(y / 3.0 * 1.5 * small**2, rel=1e-5)
