"""Where strain and stress begin: travel, preload and slack."""

import numpy as np
import pytest

from sweep.coupon.zero import begins_at_zero, doubt, from_first, from_line

STRAIN = np.linspace(0.0, 0.4, 201)
STRESS = 6e6 * (1.0 + STRAIN - (1.0 + STRAIN) ** -2)
TIME = 20.0 * STRAIN


def slack_by(strain):
    """A record with slack at its beginning."""
    rest = np.linspace(0.0, strain, 20, endpoint=False)
    return np.r_[rest, strain + STRAIN], np.r_[0.0 * rest, STRESS]


def test_a_record_that_begins_at_zero_is_left_as_it_is():
    assert begins_at_zero(STRAIN, STRESS)
    assert begins_at_zero(STRAIN[1:], STRESS[1:])
    assert not begins_at_zero(STRAIN - 0.003, STRESS)
    assert not begins_at_zero(STRAIN + 0.02, STRESS)
    assert not begins_at_zero(STRAIN, STRESS + 0.1 * STRESS.max())


@pytest.mark.parametrize("sign", [1.0, -1.0])
def test_preload_and_slack_are_asked_for(sign):
    assert doubt(sign * STRAIN, sign * STRESS, to_scale=True) is None
    preload = sign * (STRESS + 0.1 * STRESS.max())
    assert "9.1 % of its greatest force" in doubt(sign * STRAIN, preload, to_scale=True)
    strain, stress = slack_by(0.03)
    for to_scale in (True, False):
        assert "slack" in doubt(sign * strain, sign * stress, to_scale)


@pytest.mark.parametrize("sign", [1.0, -1.0])
def test_slack_is_cut_off_by_the_line(sign):
    strain, stress = slack_by(0.03)
    time = np.arange(strain.size, dtype=float)
    (cut_time, cut_strain, cut_stress), note = from_line(time, sign * strain, sign * stress)
    assert (cut_strain[0], cut_stress[0]) == (0.0, 0.0)
    assert (np.diff(cut_time) > 0.0).all()
    expected = np.interp(sign * cut_strain, STRAIN, STRESS)
    assert sign * cut_stress == pytest.approx(expected, abs=0.01 * STRESS.max())
    assert "zero strain is 0.0" in note


def test_preload_is_joined_to_the_origin_by_the_line():
    rows = STRAIN >= 0.02
    (time, strain, stress), _ = from_line(TIME[rows], STRAIN[rows] - 0.02, STRESS[rows])
    assert stress[1:] == pytest.approx(STRESS[rows])
    assert strain[1:] == pytest.approx(STRAIN[rows], abs=2e-3)
    assert (strain[0], stress[0]) == (0.0, 0.0)
    assert time[0] < time[1]


def test_both_are_set_to_zero_at_the_first_row():
    (_, strain, stress), note = from_first(TIME, STRAIN + 0.1, STRESS + 5e4)
    assert strain == pytest.approx(STRAIN)
    assert stress == pytest.approx(STRESS)
    assert "a strain of 0.1 and 50 kPa" in note
    assert "no stress" in from_first(TIME, STRAIN + 0.1, STRESS)[1]
