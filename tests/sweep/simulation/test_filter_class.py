"""The filter of a channel class: its response, the recursion of SAE J211-1, its refusals."""

from math import cos, pi, sin, sqrt

import numpy as np
import pytest
from scipy.integrate import cumulative_trapezoid

from sweep.simulation.filter_class import filtered, filtered_force, filtered_peak

CLASS = 1000
REST = (0.0, 0.0)  # before and after a signal


def half_sine(duration, step, height=100.0):
    """Time and velocity of a striker that a half sine of ``height`` (m/s^2) stops and lifts."""
    time = np.arange(0.0, 1.5 * duration, step)
    pulse = np.where(time < duration, height * np.sin(pi * time / duration), 0.0)
    return time, cumulative_trapezoid(pulse, time, initial=0.0) - 1.0


def recursion(signal, step):
    """The recursion in appendix C of SAE J211-1, forwards and backwards."""
    corner = 2.0 * pi * CLASS * 2.0775
    wa = sin(0.5 * corner * step) / cos(0.5 * corner * step)
    scale = 1.0 + sqrt(2.0) * wa + wa**2
    a, b = wa**2 / scale, (-2.0 * (wa**2 - 1.0) / scale, (-1.0 + sqrt(2.0) * wa - wa**2) / scale)
    for _ in range(2):
        passed = np.zeros_like(signal)
        for k in range(2, len(signal)):
            fed = signal[k] + 2.0 * signal[k - 1] + signal[k - 2]
            passed[k] = a * fed + b[0] * passed[k - 1] + b[1] * passed[k - 2]
        signal = passed[::-1]
    return signal


def test_recursion_of_the_standard():
    step = 2e-5
    signal = np.where(np.arange(600) % 90 < 40, 1.0, 0.2)
    signal[:100] = signal[-200:] = 0.0
    np.testing.assert_allclose(
        filtered(signal, step, CLASS, REST), recursion(signal, step), atol=1e-9
    )


@pytest.mark.parametrize(("share", "passed"), [(0.1, 1.0), (5 / 3, 0.5**0.5), (20.0, 1e-4)])
def test_what_is_passed(share, passed):
    """All of a slow vibration, 3 dB less at 5/3 of the class, nothing of a fast one."""
    step = 2e-6
    time = np.arange(0.0, 0.05, step)
    wave = filtered(np.sin(2.0 * pi * share * CLASS * time), step, CLASS, REST)
    assert np.abs(wave[8000:-8000]).max() == pytest.approx(passed, rel=0.01, abs=1e-4)


def test_rows_that_are_not_even_give_the_same():
    time, velocity = half_sine(3e-3, 5e-6)
    kept = np.delete(np.arange(len(time)), np.arange(3, len(time) - 3, 7))
    even, uneven = (filtered_peak(time[k], velocity[k], CLASS) for k in (slice(None), kept))
    assert uneven == pytest.approx(even, rel=1e-3)


def test_rows_too_far_apart_have_no_filtered_peak():
    assert np.isfinite(filtered_peak(*half_sine(20e-3, 1e-4), CLASS))
    assert np.isnan(filtered_peak(*half_sine(20e-3, 1.1e-4), CLASS))
    assert np.isfinite(filtered_peak(*half_sine(20e-3, 1.1e-4), 600))
    assert np.isnan(filtered_peak(np.zeros(1), np.zeros(1), CLASS))


def test_rows_without_fast_parts_need_no_filter():
    """At half of their frequency, 2.1 kHz, the filter of class 1000 has its corner."""
    force = np.array([0.0, 3.0, 1.0, 0.0])
    for step, passes_all in ((0.23e-3, False), (0.25e-3, True)):
        passed = filtered_force(step * np.arange(4), force, CLASS, REST)
        assert (passed == force).all() == passes_all
    assert filtered_force(np.zeros(1), np.ones(1), CLASS, REST) == 1.0


@pytest.mark.parametrize("step", [2e-6, 1e-4])
def test_force_behind_the_filter_is_that_of_its_own_samples(step):
    """A half sine of 0.5 ms, of which the filter of class 1000 lets 0.90 pass."""
    time = np.arange(0.0, 2e-3, step)
    force = np.where(time < 0.5e-3, np.sin(pi * time / 0.5e-3), 0.0)
    passed = filtered_force(time, force, CLASS, REST)
    np.testing.assert_allclose(passed, filtered(force, step, CLASS, REST), atol=1e-9)
    assert passed.max() == pytest.approx(0.904, rel=0.04)


def test_a_record_that_ends_within_a_blow_does_not_go_on_with_its_force():
    """After the end a support bears the weight alone."""
    step = 1e-5
    force = np.append(np.zeros(300), np.linspace(0.0, 9.0, 4))
    time = step * np.arange(len(force))
    low, held = (filtered_force(time, force, CLASS, (0.0, after)).max() for after in (0.0, 9.0))
    assert low < 2.0 < held
