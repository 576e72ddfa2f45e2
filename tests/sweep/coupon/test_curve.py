"""Curves of coupons: a law of that curve has the first loading of the record."""

import numpy as np
import pytest

from sweep.coupon.curve import Loading, tension, tension_by_rules
from sweep.coupon.hyperelastic import Rubber, rubber
from sweep.coupon.legs import turns
from sweep.coupon.record import Coupon
from tests.support.materials.coupons import RATE, coupon, ninjaflex

MEMORY = {"loss": 0.4}


def error(loading, at_points):
    """Greatest relative error of the curve at the points of ninjaflex's own."""
    material = ninjaflex()
    own = dict(zip(material.curve_strain, material.curve_stress, strict=True))
    both = [k for k, strain in enumerate(loading.points) if round(strain, 9) in own]
    assert len(both) > 5
    return max(abs(at_points[k] / own[round(loading.points[k], 9)] - 1.0) for k in both)


def test_curve_is_found_again_though_the_test_relaxes():
    test = coupon(0.5, **MEMORY)
    loading = Loading(test, turns(test))
    at_points, model = loading.follow(MEMORY)
    assert error(loading, at_points) < 0.02
    assert error(loading, loading.record) > 0.1
    assert model == pytest.approx(test.stress, abs=3e-3 * test.stress.max())
    assert loading.reference_time == pytest.approx(0.025 / RATE)


def test_larger_cycles_go_on_with_the_curve():
    test = coupon(0.2, 0.02, 0.5)
    loading = Loading(test, turns(test))
    assert loading.points[-1] == pytest.approx(0.5)
    assert error(loading, loading.follow({})[0]) < 0.02


def test_noise_makes_the_points_fewer():
    sure, unsure = (coupon(0.5, noise=noise) for noise in (0.0, 0.03))
    counts = [Loading(test, turns(test)).points.size for test in (sure, unsure)]
    assert counts[0] == 11
    assert 3 <= counts[1] < 9


def test_puck_has_its_own_compression_and_a_derived_tension():
    test = coupon(-0.4, **MEMORY)
    loading = Loading(test, turns(test))
    at_points, model = loading.follow(MEMORY)
    strain, stress = loading.curve(at_points)
    assert strain == pytest.approx(-strain[::-1])
    assert np.all(np.diff(stress) > 0.0)
    assert model == pytest.approx(test.stress, abs=1e-2 * np.abs(test.stress).max())


def test_stress_that_does_not_rise_is_made_to():
    strain = np.linspace(0.0, 0.5, 100)
    stress = 1e6 * np.minimum(strain, 0.1)
    flat = Loading(Coupon("flat", strain / RATE, strain, stress), [0, 99])
    assert np.all(np.diff(flat.record) > 0.0)
    assert flat.record[-1] == pytest.approx(1e5, rel=0.02)


def test_error_of_the_modulus_is_its_scatter():
    moduli, errors = [], []
    for seed in range(40):
        strain = np.linspace(0.0, 0.5, 201)
        noise = np.random.default_rng(seed).normal(scale=1e4, size=strain.size)
        test = Coupon("trial", strain, strain, 2e7 * strain + noise)
        loading = Loading(test, turns(test))
        rows = (strain > 0.0099) & (strain < 0.0401)
        moduli.append(np.polyfit(strain[rows], test.stress[rows], 1)[0])
        errors.append(loading.modulus_error * moduli[-1])
    assert np.mean(errors) == pytest.approx(np.std(moduli), rel=0.35)


STRAIN = np.linspace(0.01, 0.4, 40)


def neo_hookean(strain):
    """Stress of a neo-Hookean solid with a shear modulus of 4 MPa, in closed form."""
    stretch = 1.0 + strain
    return 4e6 * (stretch - stretch**-2)


@pytest.mark.parametrize("law", [Rubber(4e6, 0.0), Rubber(3e6, 1e6), Rubber(0.0, 4e6)])
def test_constants_are_found_again(law):
    assert rubber(STRAIN, -law.at(-STRAIN)) == pytest.approx(law, abs=1.0)


def test_one_constant_is_neo_hookean():
    assert Rubber(4e6, 0.0).at(STRAIN) == pytest.approx(neo_hookean(STRAIN))


@pytest.mark.parametrize(("at", "off"), [(0.1, 0.13), (0.2, 0.32), (0.3, 0.58), (0.4, 0.95)])
def test_tension_of_a_pressed_rubber_is_that_of_the_rubber(at, off):
    """The two rules make it too stiff."""
    pressed, place = -neo_hookean(-STRAIN), np.searchsorted(STRAIN, at - 1e-9)
    true = neo_hookean(STRAIN)[place]
    assert tension(STRAIN, pressed)[place] == pytest.approx(true, rel=1e-6)
    assert tension_by_rules(STRAIN, pressed)[place] / true - 1.0 == pytest.approx(off, abs=0.03)


def test_noise_of_a_percent_moves_the_tension_by_a_few():
    random = np.random.default_rng(1).standard_normal(STRAIN.size)
    pressed = -neo_hookean(-STRAIN) + 0.01 * 4e6 * random
    assert tension(STRAIN, pressed) == pytest.approx(neo_hookean(STRAIN), rel=0.1)


def test_the_stress_rises_as_far_as_walls_are_stretched():
    law = rubber(STRAIN, -Rubber(1e6, 3e6).at(-STRAIN))
    assert np.all(np.diff(law.at(np.linspace(-0.7, 4.0, 200))) > 0.0)


def test_what_is_no_rubber_has_none():
    """A material that yields at 10 %; and a record that ends before 10 %."""
    yields = 1e6 * np.minimum(STRAIN, 0.1) + 1e4 * STRAIN
    assert rubber(STRAIN, yields) is None
    assert tension(STRAIN, yields) == pytest.approx(tension_by_rules(STRAIN, yields))
    short = STRAIN[STRAIN < 0.09]
    assert rubber(short, -neo_hookean(-short)) is None
