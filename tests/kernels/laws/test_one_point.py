"""A point that is taken along a strain: against closed forms of a straight curve."""

import numpy as np
import pytest

from kernels.laws.one_point import stresses
from sweep.scene.material import law_in_stretch
from tests.support.designs.tables import material_with

MODULUS, SHARE, TIME = 12e6, 0.4, 0.2  # Pa; of a branch; s
RATE = 0.1  # 1/s


def linear(**memory):
    return law_in_stretch(material_with(modulus=MODULUS, density=1190.0, **memory), 1.0)


def test_elastic_point_follows_its_curve_at_any_rate():
    strain = np.array([0.0, 0.1, 0.3, 0.05])
    for time in (np.arange(4.0), 1e-6 * np.arange(4.0)):
        assert stresses(linear(), time, strain) == pytest.approx(MODULUS * strain, rel=1e-12)


def test_ramp_of_a_standard_solid():
    """Stress = Y_0 r ((1 - g) t + g tau (1 - exp(-t / tau))), Y at the reference time given."""
    instant = MODULUS / (1.0 - SHARE + SHARE * np.exp(-1.0 / TIME))
    law = linear(relaxation_times=(TIME,), relaxation_shares=(SHARE,), reference_time=1.0)
    time = np.array([0.0, 1e-3, 0.1, 0.3, 2.0])
    relaxed = SHARE * TIME * -np.expm1(-time / TIME)
    expected = instant * RATE * ((1.0 - SHARE) * time + relaxed)
    assert stresses(law, time, RATE * time) == pytest.approx(expected, rel=1e-10)


def test_reused_point_is_softer_up_to_its_greatest_strain():
    law = law_in_stretch(
        material_with(name="ninjaflex", softening_r=2.0, softening_m=1e5, softening_beta=0.1), 1.0
    )
    up, down, again, beyond = stresses(law, np.arange(5.0), np.array([0.0, 0.3, 0.1, 0.3, 0.31]))[
        1:
    ]
    first = stresses(law, np.arange(2.0), np.array([0.0, 0.1]))[1]
    assert again == pytest.approx(up)
    assert 0.4 * first < down < 0.7 * first
    assert beyond > up
