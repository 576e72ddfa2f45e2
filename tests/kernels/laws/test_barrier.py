"""The barrier of contacts, folds and lengths: its derivatives, and where it starts and ends."""

import numpy as np
import pytest

from kernels.laws.barrier import barrier, phi
from tests.support.kernels.terms import differences


@pytest.mark.parametrize("s", [1e-6, 1e-3, 0.02, 0.3, 0.9, 1 - 1e-3, 1 - 1e-6, 1 + 1e-6])
def test_derivatives(s):
    step = np.array([1e-3 * min(s, abs(1 - s))])
    value, slope, curvature = barrier(s)
    assert value == pytest.approx(-((s - 1) ** 2) * np.log(s) if s < 1 else 0.0, rel=1e-12)
    found = differences(lambda at: np.array(barrier(at[0])[:2]), np.array([s]), step)[0]
    assert found == pytest.approx((slope, curvature), rel=1e-6)


def test_it_is_smooth_where_it_starts_and_infinite_where_it_ends():
    assert barrier(1.0) == (0.0, 0.0, 0.0)
    assert barrier(1.0 - 1e-7) == pytest.approx((0.0, 0.0, 6e-7), abs=1e-13)
    assert barrier(0.0) == (np.inf, -np.inf, np.inf)
    assert barrier(1e-8) == (np.inf, -np.inf, np.inf)
    assert barrier(-1.0)[0] == np.inf


def test_phi_is_the_barrier_over_the_distance_at_which_contact_starts():
    """Weight 2, stiffness 3; contact starts at 0.8 mm."""
    value, slope, curvature = barrier(0.3 / 0.8)
    expected = 6.0 * 8e-4 * value, 6.0 * slope, 6.0 / 8e-4 * curvature
    assert phi(2.0, 3.0, 8e-4, 3e-4) == pytest.approx(expected, rel=1e-12)
