"""Curves of coupons: a law of that curve has the first loading of the record."""

import numpy as np
import pytest

from sweep.coupon.curve import Loading
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
