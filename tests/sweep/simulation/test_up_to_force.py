"""Energy and stroke of a curve when it first reaches a force."""

import numpy as np
import pytest
from scipy.integrate import cumulative_trapezoid

from sweep.simulation.up_to_force import absorbed_until, stroke_until

STRAIN = np.linspace(0.0, 0.6, 601)
FORCE = np.interp(STRAIN, [0.0, 0.1, 0.5, 0.6], [0.0, 10.0, 10.0, 50.0])
WORK = cumulative_trapezoid(FORCE, 10e-3 * STRAIN, initial=0.0)


def test_absorbed_until_a_force():
    assert absorbed_until(5.0, FORCE, WORK) == pytest.approx(1.25e-3)
    assert absorbed_until(10.0, FORCE, WORK) == pytest.approx(45e-3)
    assert absorbed_until(50.0, FORCE, WORK) == absorbed_until(1e9, FORCE, WORK) == WORK[-1]
    assert WORK[-1] == pytest.approx(75e-3)


def test_absorbed_until_a_force_is_interpolated_and_stops_at_the_first_time():
    force, work = np.array([0.0, 4.0, 2.0, 8.0]), np.array([0.0, 1.0, 2.0, 3.0])
    assert absorbed_until(3.0, force, work) == pytest.approx(9 / 16)
    assert absorbed_until(5.0, force, work) == pytest.approx(2.0 + (25 - 4) / (64 - 4))
    assert stroke_until(3.0, force, work) == pytest.approx(0.75)


def test_work_between_rows_is_the_integral_of_a_linear_force():
    travel, force = np.array([0.0, 1e-3]), np.array([4.0, 10.0])
    work = np.array([0.0, 0.5 * (4.0 + 10.0) * 1e-3])
    at = stroke_until(7.0, force, travel)
    assert absorbed_until(7.0, force, work) == pytest.approx(0.5 * (4.0 + 7.0) * at)
    pulled = np.array([-2.0, 5.0])  # at the start, by which no work is done on the lattice
    assert absorbed_until(3.0, pulled, travel) == pytest.approx(9 / 25 * 1e-3)


def test_a_force_that_is_passed_on_from_the_start_or_by_one_row():
    assert absorbed_until(1.0, np.array([2.0, 3.0]), np.array([0.1, 0.2])) == 0.1
    assert absorbed_until(1.0, np.array([0.0]), np.array([0.0])) == 0.0
