"""What a curve has reached when it first bears a force."""

import numpy as np
import pytest

from sweep.simulation.until import absorbed_until

STRAIN = np.linspace(0.0, 0.6, 601)
FORCE = np.interp(STRAIN, [0.0, 0.1, 0.5, 0.6], [0.0, 10.0, 10.0, 50.0])
WORK = np.append(0.0, np.cumsum(0.5 * (FORCE[1:] + FORCE[:-1]) * np.diff(STRAIN) * 10e-3))


def test_absorbed_until_a_force():
    assert absorbed_until(5.0, FORCE, WORK) == pytest.approx(1.25e-3)
    assert absorbed_until(10.0, FORCE, WORK) == pytest.approx(45e-3)
    assert absorbed_until(50.0, FORCE, WORK) == absorbed_until(1e9, FORCE, WORK) == WORK[-1]
    assert WORK[-1] == pytest.approx(75e-3)


def test_absorbed_until_a_force_is_interpolated_and_stops_at_the_first_time():
    force, work = np.array([0.0, 4.0, 2.0, 8.0]), np.array([0.0, 1.0, 2.0, 3.0])
    assert absorbed_until(3.0, force, work) == pytest.approx(0.75)
    assert absorbed_until(5.0, force, work) == pytest.approx(2.5)


def test_a_force_that_is_passed_on_from_the_start_or_by_one_row():
    assert absorbed_until(1.0, np.array([2.0, 3.0]), np.array([0.1, 0.2])) == 0.1
    assert absorbed_until(1.0, np.array([0.0]), np.array([0.0])) == 0.0
