"""Dead loads: their energy and its gradient."""

import numpy as np
import pytest

from kernels.terms import loads
from tests.support.kernels.terms import Term, derivative_error

LOAD = np.array([0.0, -2.0, 0.5])  # N


def term_of(factor) -> Term:
    """Loads of a factor, from x = 0."""
    return Term(
        lambda x, g: loads.evaluate(x, LOAD, factor, g),
        lambda x: np.zeros((LOAD.size, LOAD.size)),
    )


@pytest.mark.parametrize("factor", [0.0, 1.0, -0.3])
def test_derivatives(factor):
    x = np.random.default_rng(0).uniform(-1, 1, LOAD.size)
    assert derivative_error(term_of(factor), x) < 1e-10


def test_a_load_that_sinks_loses_energy():
    assert term_of(0.5).energy(np.array([1.0, -3.0, 0.0])) == pytest.approx(-3.0)


def test_the_gradient_is_added_to_what_is_there():
    g = np.ones_like(LOAD)
    loads.evaluate(np.zeros_like(LOAD), LOAD, 2.0, g)
    np.testing.assert_array_equal(g, 1.0 - 2.0 * LOAD)
