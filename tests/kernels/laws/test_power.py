"""Powers of four numbers at a time, compared with those of the `decimal` module."""

from decimal import Decimal

import numpy as np
import pytest

from kernels.compile.jit import jit
from kernels.compile.simd import LANES, load, store
from kernels.laws.power import power

ROUND_OFF = 2.0**-52


@jit
def powers(q, n, to):
    store(to, 0, power(load(q, 0), n))


def exact(q, n):
    return np.array([float(Decimal(each) ** Decimal(n)) for each in q.tolist()])


@pytest.mark.parametrize("n", [0.5, 1.0 / 1.48, 0.52, 1.0, -0.3, 2.0])
def test_powers_are_correct_to_three_units_in_the_last_place(n):
    rng, found = np.random.default_rng(1), np.empty(LANES)
    rows = np.exp(rng.uniform(-2.3, 2.3, (50, LANES)))
    borders = 2.0 ** np.array([-0.5, 0.5, 0.0, 1.0])  # where the exponent changes
    for q in (*rows, borders, np.nextafter(borders, 0.0)):
        powers(q, n, found)
        np.testing.assert_allclose(found, exact(q, n), rtol=3.0 * ROUND_OFF)


def test_each_lane_has_its_own_power():
    """Whatever is in the others: fibres that are crushed have numbers that are not positive."""
    q, found = np.array([4.0, -1.0, 0.0, 9.0]), np.empty(LANES)
    powers(q, 0.5, found)
    np.testing.assert_allclose(found[[0, 3]], [2.0, 3.0], rtol=3.0 * ROUND_OFF)
