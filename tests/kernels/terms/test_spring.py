"""Linear springs between two nodes: derivatives at rest, stretched, compressed and turned."""

import numpy as np
import pytest

from kernels.terms import spring
from tests.support.kernels.terms import derivative_error, of_points

SPRINGS = spring.Spring(
    np.array([[0, 1], [2, 1], [0, 2]]), np.array([2.0, 0.5, 3.0]), np.array([1.0, 2.0, 0.3])
)
TERM = of_points(
    lambda x, g: spring.evaluate(x, SPRINGS, g),
    lambda x, matrix: spring.hessian(x, SPRINGS, matrix),
)
STATES = {
    "at rest": [0.0, 0.0, 1.0, 0.0, 1.0, 2.0],
    "stretched": [0.0, 0.0, 3.0, 1.0, -2.0, 2.0],
    "compressed": [0.0, 0.0, 0.3, 0.1, 0.2, 0.2],
}


@pytest.mark.parametrize("state", STATES)
def test_derivatives(state):
    assert derivative_error(TERM, np.array(STATES[state])) < 1e-7


def test_energy_is_half_the_stiffness_times_the_stretch_squared():
    one = spring.Spring(np.array([[0, 1]]), np.array([2.0]), np.array([1.0]))
    g = np.zeros(4)
    assert spring.evaluate(np.array([0.0, 0.0, 3.0, 4.0]), one, g) == pytest.approx(16.0)
    np.testing.assert_allclose(g, [-4.8, -6.4, 4.8, 6.4])


def test_nodes_that_coincide_cost_no_end():
    assert spring.evaluate(np.zeros(6), SPRINGS, np.zeros(6)) == np.inf
