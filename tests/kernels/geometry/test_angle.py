"""Arctangents, and angles between directions, against libm."""

import math

import numpy as np
import pytest

from kernels.geometry.angle import LARGEST, arctangent, between

RATIOS = [0.0, *LARGEST * np.logspace(-300, 0, 13), *np.linspace(0.01, LARGEST, 50)]


@pytest.mark.parametrize("sign", [1.0, -1.0])
def test_arctangent_is_exact_within_two_units_of_the_last_place(sign):
    for ratio in RATIOS:
        expected = math.atan(sign * ratio)
        assert abs(arctangent(sign * ratio) - expected) <= 2.0 * math.ulp(expected), ratio


@pytest.mark.parametrize("psi", [0.0, 1e-9, 0.1, 1.1, 1.2, 1.5, 3.1, -3.1, -1.0, math.pi])
def test_between_is_the_angle_from_one_direction_to_another(psi):
    for one in (0.0, 1.0, np.pi, -2.5):
        two = one + psi
        found = between(np.cos(one), np.sin(one), np.cos(two), np.sin(two))
        assert abs(found) == pytest.approx(abs(psi), abs=1e-15)
        assert abs(psi) == math.pi or found * psi >= 0.0


def test_opposite_directions_are_half_a_turn_apart():
    assert between(1.0, 0.0, -1.0, 0.0) == math.pi
