"""The barrier of contacts, folds and lengths: its derivatives, and where it starts and ends."""

import numpy as np
import pytest

from kernels.laws.barrier import barrier, phi
from tests.support.kernels.terms import differences


@pytest.mark.parametrize("s", [1e-9, 1e-3, 0.02, 0.3, 0.9, 1 - 1e-3, 1 - 1e-6, 1 + 1e-6])
def test_derivatives(s):
    step = np.array([1e-3 * min(s, abs(1 - s))])
    value, slope, curvature = barrier(s)
    assert value == pytest.approx(-((s - 1) ** 2) * np.log(s) if s < 1 else 0.0, rel=1e-12)
    by_value = differences(lambda at: barrier(at[0])[0], np.array([s]), step)[0]
    by_slope = differences(lambda at: barrier(at[0])[1], np.array([s]), step)[0]
    assert by_value == pytest.approx(slope, rel=1e-6)
    assert by_slope == pytest.approx(curvature, rel=1e-6)


def test_it_is_smooth_where_it_starts_and_infinite_where_it_ends():
    assert barrier(1.0) == (0.0, 0.0, 0.0)
    assert barrier(1.0 - 1e-7) == pytest.approx((0.0, 0.0, 6e-7), abs=1e-13)
    assert barrier(0.0) == (np.inf, -np.inf, np.inf)
    assert barrier(1e-11) == (np.inf, -np.inf, np.inf)
    assert barrier(-1.0)[0] == np.inf


@pytest.mark.parametrize("d", [1e-5, 3e-4, 7.9e-4])
def test_derivatives_of_a_contact(d):
    """Derivatives in the distance; contact starts at 0.8 mm."""
    starts, step = 8e-4, np.array([1e-3 * min(d, abs(8e-4 - d))])
    value, slope, curvature = phi(2.0, 3.0, starts, d)
    assert value == pytest.approx(2.0 * 3.0 * starts * barrier(d / starts)[0], rel=1e-12)
    by_value = differences(lambda at: phi(2.0, 3.0, starts, at[0])[0], np.array([d]), step)[0]
    by_slope = differences(lambda at: phi(2.0, 3.0, starts, at[0])[1], np.array([d]), step)[0]
    assert by_value == pytest.approx(slope, rel=1e-6)
    assert by_slope == pytest.approx(curvature, rel=1e-6)
