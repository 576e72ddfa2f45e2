"""Layered walls: derivatives in the nine measures, thickening, bending of thin and bent walls."""

import numpy as np
import pytest

from kernels.laws.law import Memory
from kernels.laws.sheet import neo_hookean
from kernels.plates.element import layers
from tests.support.kernels.sheets import MODULUS, elastic_only, sheet_of_rubber
from tests.support.kernels.terms import differences

LINEAR = elastic_only(neo_hookean(MODULUS))
RUBBER = elastic_only(sheet_of_rubber())
NONE = Memory(np.zeros((0, 0)), np.zeros((0, 4)), LINEAR.make_pace())
THICKNESS = 0.1
STATES = {
    "rest": np.zeros(9),
    "bent": np.array([0, 0, 0, 1.5, -0.7, 0.4, 3.0, 1.0, -0.6]),
    "stretched": np.array([0.5, -0.3, 0.2, 0, 0, 0, 0, 0, 0]),
    "pressed and bent": np.array([-0.5, -0.2, -0.1, 2.0, 1.0, -1.0, 9.0, 4.0, -2.0]),
}


def curved(b, d):
    """A point that is curved at rest."""
    rest = np.empty(layers.REST)
    layers.set_rest(np.array(b), np.array(d), THICKNESS, rest)
    return rest


FLAT = np.empty(0)
SADDLE = curved([2.0, -1.5, 0.8], [4.5, 3.0, 0.4])


def energy(m, law=LINEAR, thickness=THICKNESS, rest=FLAT):
    return layers.resultants(law, m, rest, thickness, NONE, 0, np.empty(9))[0]


def derivatives(m, law=LINEAR, rest=FLAT):
    """Slopes (9,) by both ways, and second derivatives (9, 9)."""
    one, two, second = np.empty(9), np.empty(9), np.empty((9, 9))
    layers.resultants(law, m, rest, THICKNESS, NONE, 0, one)
    layers.rigidity(law, m, rest, THICKNESS, NONE, 0, layers.make_moments(), two, second)
    np.testing.assert_allclose(one, two, rtol=1e-12, atol=1e-15)
    return one, second


@pytest.mark.parametrize("law", [LINEAR, RUBBER], ids=["linear", "rubber"])
@pytest.mark.parametrize("name", STATES)
@pytest.mark.parametrize("rest", [FLAT, SADDLE], ids=["flat", "saddle"])
def test_derivatives(name, law, rest):
    m, step = STATES[name], np.r_[np.full(3, 1e-5), np.full(6, 1e-3)]
    slope, second = derivatives(m, law, rest)
    scale = np.r_[np.ones(3), np.full(3, THICKNESS), np.full(3, THICKNESS**2)]
    by_energy = differences(lambda m: energy(m, law, rest=rest), m, step)
    by_slope = differences(lambda m: derivatives(m, law, rest)[0], m, step)
    size = np.abs(second / np.outer(scale, scale)).max()
    np.testing.assert_allclose(by_energy / scale, slope / scale, rtol=0, atol=1e-8 * size)
    error = np.abs(by_slope - second) / np.outer(scale, scale)
    assert error.max() < 1e-5 * size
    np.testing.assert_allclose(second, second.T, rtol=1e-14, atol=1e-15 * size)


@pytest.mark.parametrize("stretch", [0.8, 1.3])
def test_layers_of_a_cylinder_are_as_long_as_their_radius(stretch):
    """A cylinder of radius r is bent to R = l r: fibres at r + zeta become R + zeta j, j = 1 / l,
    long.
    """
    r = 0.35
    m = np.array([stretch**2 - 1, 0, 0, (stretch - 1) / r, 0, 0, 0, 0, 0])
    rest, total = curved([1 / r, 0, 0], [1 / r**2, 0, 0]), 0.0
    for k, share in enumerate((layers.SHARES[0], layers.SHARES[1], layers.SHARES[0])):
        zeta = (k - 1) * layers.OUTER * THICKNESS
        along = (stretch * r + zeta / stretch) / (r + zeta)
        value = LINEAR.elastic.respond(along**2 - 1, 0.0, 0.0)[0]
        total += share * THICKNESS * (1 + zeta / r) * value
    assert energy(m, rest=rest) == pytest.approx(total, rel=1e-12)
    assert abs(total / energy(m) - 1.0) > 1e-3


@pytest.mark.parametrize("stretch", [0.8, 1.0, 1.25])
def test_a_squeezed_wall_is_thicker_and_stiffer_against_bending(stretch):
    """Stress free across: fibres at y = z j are stretched to l + kappa y."""
    a = np.array([stretch**2, 1.0 / stretch])
    kappa, found = 1e-3, []
    for k in (0.0, kappa):
        m = np.array([a[0] - 1, a[1] - 1, 0, stretch * k, 0, 0, k * k, 0, 0])
        found.append(energy(m))
    j, mu = (a[0] * a[1]) ** -0.5, MODULUS / 3
    square = (THICKNESS * j) ** 2 / 12  # mean of y^2; along, (l + kappa y)^2 = q
    curved = 0.5 * mu * square * (1.0 + 3.0 / (a[1] * stretch**4))
    assert (found[1] - found[0]) / kappa**2 == pytest.approx(THICKNESS * curved, rel=1e-4)


def test_the_middle_takes_the_membrane_energy():
    m = STATES["stretched"]
    total, middle = layers.resultants(LINEAR, m, FLAT, THICKNESS, NONE, 0, np.empty(9))
    assert total == pytest.approx(middle)
    assert middle == pytest.approx(THICKNESS * LINEAR.elastic.respond(*m[:3])[0])
    bent = STATES["pressed and bent"]
    total, middle = layers.resultants(LINEAR, bent, FLAT, THICKNESS, NONE, 0, np.empty(9))
    assert middle == pytest.approx(THICKNESS * LINEAR.elastic.respond(*bent[:3])[0])
    assert total > 1.01 * middle


@pytest.mark.parametrize("place", [1.0, -1.0])
def test_a_fibre_that_vanishes_takes_infinite_energy(place):
    """A wall that is bent to a radius of 0.387 t: its inner layer has no length left."""
    limit = 1.0 / (layers.OUTER * THICKNESS)
    found = [energy(np.array([0, 0, 0, k, 0, 0, k * k, 0, 0.0]))
             for k in place * limit * (1.0 - np.logspace(-1, -4, 10))]  # fmt: skip
    assert np.all(np.diff(found) > 0.0)
    assert found[-1] > 1e6 * found[0]
    assert energy(np.array([-1.0, 0, 0, 0, 0, 0, 0, 0, 0])) == np.inf
    assert energy(np.array([0.0, 0, 1.0, 0, 0, 0, 0, 0, 0])) == np.inf
