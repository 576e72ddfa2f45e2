"""Fits of coupons that the law made: its numbers are found again, with noise of 1 % too."""

import numpy as np
import pytest

from sweep.coupon.fit import BETA, fit
from sweep.coupon.record import Coupon, CouponError
from sweep.coupon.uncertainty import standard_errors
from tests.support.materials.coupons import coupon

BOTH = {"loss": 0.35, "softening_r": 2.5, "softening_m": 3e5}
GROWING = BOTH | {"softening_beta": 0.3}


@pytest.mark.parametrize(("noise", "within"), [(0.0, 0.01), (0.01, 0.04)])
def test_loss_and_softening_are_found_again(noise, within):
    found = fit(coupon(0.5, 0.07, 0.5, noise=noise, **BOTH))
    assert found.memory == pytest.approx(BOTH | {"softening_beta": BETA}, rel=within)
    assert not found.knows_beta
    assert found.misfit == pytest.approx(noise, abs=1e-3)


def test_standard_errors_hold_the_numbers_of_a_noisy_test():
    found = fit(coupon(0.5, 0.07, 0.5, noise=0.01, **BOTH))
    assert set(found.errors) == {"modulus", *BOTH}
    for key, value in BOTH.items():
        assert abs(found.memory[key] - value) < 3.0 * found.errors[key] < 0.15 * value
    assert 0.01 < found.errors["modulus"] < 0.1
    quiet = fit(coupon(0.5, 0.07, 0.5, noise=0.001, **BOTH))
    assert quiet.errors["loss"] < 0.5 * found.errors["loss"]


@pytest.mark.parametrize(("noise", "within"), [(0.0, 0.02), (0.01, 0.1)])
def test_a_larger_second_cycle_tells_beta(noise, within):
    found = fit(coupon(0.3, 0.05, 0.6, 0.1, 0.6, noise=noise, **GROWING))
    assert found.knows_beta
    assert found.memory == pytest.approx(GROWING, rel=within)


@pytest.mark.parametrize("memory", [{}, {"loss": 0.35}, {"softening_r": 2.0, "softening_m": 2e5}])
def test_what_a_material_does_not_do_is_left_out(memory):
    found = fit(coupon(0.5, 0.03, 0.5, noise=0.01, **memory))
    beta = {"softening_beta": BETA} if "softening_r" in memory else {}
    assert found.memory == pytest.approx(memory | beta, rel=0.03)


def test_what_a_record_does_not_tell_is_left_out():
    pulled = fit(coupon(0.5, **BOTH))
    assert (pulled.memory, pulled.shares) == ({}, (None, None))
    assert pulled.misfit < 2e-3
    assert list(fit(coupon(0.5, 0.05, **BOTH)).memory) == ["loss"]


def test_lost_work_is_that_of_cycles_that_end_unloaded():
    cycle = fit(coupon(0.3, 0.045, 0.3, 0.05, loss=0.35))
    first, second = cycle.shares
    assert first == pytest.approx(0.33, abs=0.03)
    assert second < first
    assert fit(coupon(0.3, 0.2, 0.3, loss=0.35)).shares == (None, None)
    assert fit(coupon(0.3, 0.0, 0.3)).shares == (pytest.approx(0.0, abs=1e-9), None)


def test_the_worst_row_is_told():
    test = coupon(0.5, 0.07, 0.5, **BOTH)
    test.stress[500] *= 1.2
    apart, row = fit(test).worst
    assert row == 500
    assert apart == pytest.approx(0.2 * test.stress[500] / 1.2 / test.stress.max(), rel=0.05)


@pytest.mark.parametrize("sign", [1.0, -1.0])
def test_unloading_above_loading_is_refused(sign):
    test = coupon(0.5, 0.05, 0.5, loss=0.2)
    again = np.interp(test.strain, test.strain[:201], test.stress[:201])
    way_back = (np.arange(test.time.size) > 200) & (np.arange(test.time.size) < 400)

    def record(factor):
        stress = np.where(way_back, factor * again, test.stress)
        return Coupon("above", test.time, sign * test.strain, sign * stress)

    assert fit(record(1.0)).misfit > 0.0
    with pytest.raises(CouponError, match=r"above the loading, by 9\.9 % of its work"):
        fit(record(1.1))


def test_a_record_that_begins_with_an_unloading_is_refused():
    test = coupon(0.5, 0.05, 0.5, loss=0.2)
    first = np.r_[0.2, test.strain] - 0.2
    late = Coupon("late", np.r_[-1.0, test.time], first, np.r_[0.0, test.stress])
    with pytest.raises(CouponError, match="late: the record begins with an unloading, from its"):
        fit(late)


def test_a_curve_that_no_law_with_a_loss_has_is_refused():
    test = coupon(0.5, 0.05, 0.5, loss=0.35)
    late = np.arange(test.time.size) > 200
    slipped = Coupon("slipped", test.time, test.strain + 0.2 * late, test.stress)
    with pytest.raises(CouponError, match="slipped: the stress hardly rises towards a strain of"):
        fit(slipped)


X = np.linspace(0.0, 1.0, 400)
JACOBIAN = np.column_stack([np.ones_like(X), X])


@pytest.mark.parametrize(("slow", "within"), [(0.0, 0.1), (0.8, 0.2)])
def test_errors_are_the_scatter_of_repeated_fits(slow, within):
    random = np.random.default_rng(3)
    fits, errors = [], []
    for _ in range(400):
        noise = random.standard_normal(X.size)
        for k in range(1, X.size):
            noise[k] = slow * noise[k - 1] + np.sqrt(1.0 - slow**2) * noise[k]
        fitted = np.linalg.pinv(JACOBIAN) @ noise
        fits.append(fitted)
        errors.append(standard_errors(JACOBIAN, noise - JACOBIAN @ fitted))
    assert np.mean(errors, axis=0) == pytest.approx(np.std(fits, axis=0), rel=within)


def test_without_a_misfit_there_is_no_error():
    assert standard_errors(JACOBIAN, np.zeros(X.size)) == pytest.approx(np.zeros(2))
