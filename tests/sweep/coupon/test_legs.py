"""Legs of a test: turns of strain, the path through them, and the work of each."""

from itertools import pairwise

import numpy as np
import pytest

from sweep.coupon.legs import POINTS, leg_name, path, turns, work
from sweep.coupon.record import Coupon
from tests.support.materials.coupons import ROWS, coupon


def test_turns_are_where_the_strain_turns():
    assert turns(coupon(0.3)) == [0, ROWS]
    cycle = coupon(0.3, 0.02, 0.3)
    assert turns(cycle) == [0, ROWS, 2 * ROWS, 3 * ROWS]
    pressed = Coupon("puck", cycle.time, -cycle.strain, -cycle.stress)
    assert turns(pressed) == turns(cycle)


def test_noise_of_the_strain_is_no_turn():
    cycle = coupon(0.3, 0.02, 0.3)
    noise = 2e-3 * np.random.default_rng(1).standard_normal(cycle.strain.size)
    shaken = Coupon("trial", cycle.time, cycle.strain + noise, cycle.stress)
    assert turns(shaken) == pytest.approx(turns(cycle), abs=10)
    assert len(turns(shaken)) == 4


def test_path_has_few_points_and_the_turns():
    cycle = coupon(0.3, 0.02)
    time, strain = path(cycle, turns(cycle))
    assert len(time) == 1 + 2 * (POINTS + 1)
    assert (strain.max(), strain[-1]) == (0.3, pytest.approx(0.02))
    assert np.all(np.diff(time) > 0.0)
    assert np.interp(cycle.time, time, strain) == pytest.approx(cycle.strain, abs=1e-9)


def test_path_of_a_few_rows_is_all_of_them():
    steps = np.array([0.0, 0.05, 0.1, 0.05, 0.0])
    time, strain = path(Coupon("trial", np.arange(5.0), steps, steps), [0, 2, 4])
    assert strain.tolist() == steps.tolist()
    assert time.tolist() == [0.0, 1.0, 2.0, 3.0, 4.0]


def test_legs_have_names():
    rows = [0, 10, 20, 30, 40]
    names = [leg_name(rows, row) for row in (0, 10, 11, 30, 40)]
    loading = "the first loading"
    assert names == [loading, loading, "unloading", "reloading", "a later cycle"]


def test_work_is_the_area_without_slack():
    strain = np.array([0.0, 0.1, 0.2, 0.1, 0.0])
    stress = np.array([0.0, 10.0, 20.0, 0.0, -5.0])
    test = Coupon("trial", np.arange(5.0), strain, stress)
    found = [work(test, *rows) for rows in pairwise([0, 2, 4])]
    assert found == pytest.approx([2.0, -1.0])
