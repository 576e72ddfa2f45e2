"""Arcs of elements: derivatives of an energy in lengthened measures, the length of an arc."""

import numpy as np
import pytest

from kernels.plates.element import bow
from tests.support.kernels.shells import plate, stored
from tests.support.kernels.terms import differences

SIZE = np.array([0.4, 0.7])
R = np.random.default_rng(0)
REST, M = R.uniform(-1, 1, (2, 9))
FORCE, MATRIX = R.uniform(-1, 1, 9), R.uniform(-1, 1, (9, 9))
MATRIX = MATRIX + MATRIX.T


def energy(m):
    """A quadratic function of lengthened measures, and its derivatives in the measures."""
    longer, second = m.copy(), MATRIX.copy()
    chords = bow.lengthen(SIZE, REST, longer)
    slope = FORCE + MATRIX @ longer
    value = FORCE @ longer + 0.5 * longer @ MATRIX @ longer
    bow.pull_back_second(SIZE, chords, slope, second)
    bow.pull_back(SIZE, chords, slope)
    return value, slope, second


def test_derivatives():
    _, slope, second = energy(M)
    step = np.full(9, 1e-3)
    np.testing.assert_allclose(differences(lambda m: energy(m)[0], M, step), slope, atol=1e-9)
    np.testing.assert_allclose(differences(lambda m: energy(m)[1], M, step), second, atol=1e-9)


def test_nothing_is_longer_at_rest():
    m = np.zeros(9)
    bow.lengthen(SIZE, REST, m)
    np.testing.assert_allclose(m, 0.0, atol=1e-15)


@pytest.mark.parametrize("turn", [0.05, 0.2])
def test_elements_on_a_circle_keep_their_length(turn):
    """The chord of an arc of angle ``turn`` is short by its square / 24; the energy has an error of
    the fourth order.
    """
    of = plate(4, 1, 1.0, 0.3, 1e-3)
    h, found = 0.25, []
    for chord in (2.0 / turn * np.sin(0.5 * turn), 1.0):
        x = of.rest
        rows = x[:-2].reshape(-1, 6)
        number = of.points[:, 0] / h
        radius = 0.5 * h * chord / np.sin(0.5 * turn)
        rows[:, 0], rows[:, 1] = (
            radius * np.sin(number * turn),
            radius * (np.cos(number * turn) - 1.0),
        )
        rows[:, 4] = -np.tan(0.25 * number * turn)
        found.append(stored(of, x)[0])
    assert found[0] < 2e-2 * turn**4 * found[1] / turn**2
