"""The tension of a pressed rubber is recovered; a material that is no rubber has none."""

import numpy as np
import pytest

from sweep.coupon.curve import tension, tension_by_rules
from sweep.coupon.hyperelastic import Rubber, rubber

STRAIN = np.linspace(0.01, 0.4, 40)


def neo_hookean(strain):
    """Stress of a neo-Hookean solid with a shear modulus of 4 MPa, in closed form."""
    stretch = 1.0 + strain
    return 4e6 * (stretch - stretch**-2)


@pytest.mark.parametrize("law", [Rubber(4e6, 0.0), Rubber(3e6, 1e6), Rubber(0.0, 4e6)])
def test_constants_are_found_again(law):
    assert rubber(STRAIN, -law.at(-STRAIN)) == pytest.approx(law, abs=1.0)


def test_one_constant_is_neo_hookean():
    assert Rubber(4e6, 0.0).at(STRAIN) == pytest.approx(neo_hookean(STRAIN))


@pytest.mark.parametrize(("at", "off"), [(0.1, 0.13), (0.2, 0.32), (0.3, 0.58), (0.4, 0.95)])
def test_tension_of_a_pressed_rubber_is_that_of_the_rubber(at, off):
    """The two rules make it too stiff."""
    pressed, place = -neo_hookean(-STRAIN), np.searchsorted(STRAIN, at - 1e-9)
    true = neo_hookean(STRAIN)[place]
    assert tension(STRAIN, pressed)[place] == pytest.approx(true, rel=1e-6)
    assert tension_by_rules(STRAIN, pressed)[place] / true - 1.0 == pytest.approx(off, abs=0.03)


def test_noise_of_a_percent_moves_the_tension_by_a_few():
    random = np.random.default_rng(1).standard_normal(STRAIN.size)
    pressed = -neo_hookean(-STRAIN) + 0.01 * 4e6 * random
    assert tension(STRAIN, pressed) == pytest.approx(neo_hookean(STRAIN), rel=0.1)


def test_the_stress_rises_as_far_as_walls_are_stretched():
    law = rubber(STRAIN, -Rubber(1e6, 3e6).at(-STRAIN))
    assert np.all(np.diff(law.at(np.linspace(-0.7, 4.0, 200))) > 0.0)


def test_what_is_no_rubber_has_none():
    """A material that yields at 10 %; and a record that ends before 10 %."""
    yields = 1e6 * np.minimum(STRAIN, 0.1) + 1e4 * STRAIN
    assert rubber(STRAIN, yields) is None
    assert tension(STRAIN, yields) == pytest.approx(tension_by_rules(STRAIN, yields))
    short = STRAIN[STRAIN < 0.09]
    assert rubber(short, -neo_hookean(-short)) is None
