"""Dead loads: their energy and its gradient."""

import numpy as np
import pytest

from kernels.terms import loads

LOAD = np.array([0.0, -2.0, 0.5])  # N


def test_a_load_that_sinks_loses_energy():
    """The gradient is added to what is there."""
    g = np.ones_like(LOAD)
    assert loads.evaluate(np.array([1.0, -3.0, 2.0]), LOAD, 0.5, g) == pytest.approx(-3.5)
    np.testing.assert_array_equal(g, 1.0 - 0.5 * LOAD)
