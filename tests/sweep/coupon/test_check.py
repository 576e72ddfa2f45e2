"""Impossible records, and the option that corrects a unit."""

import numpy as np
import pytest

from sweep.config.faults import MisfitError
from sweep.coupon.check import coarse_modulus, doubts

STRAIN = np.linspace(0.0, 0.3, 301)
READY = {"strain": "strain", "stress": "stress [Pa]"}
RAW = {"displacement": "Travel [mm]", "force": "Load [N]"}


def test_modulus_is_the_slope_between_one_and_four_percent():
    strain = np.linspace(0.0, 0.1, 101)
    stress = 2e7 * np.minimum(strain, 0.05) + 1e4
    assert coarse_modulus(strain, stress) == pytest.approx(2e7)
    assert coarse_modulus(strain[::60], stress[::60]) == pytest.approx(stress[60] / 0.06)


@pytest.mark.parametrize(
    ("scales", "words", "options"),
    [
        ((1.0, 1e7), READY, []),
        ((-1.0, -1e7), READY, []),
        ((100.0, 1e7), READY, ["--units strain=%"]),
        ((1.0, 1e1), READY, ["--units stress=MPa"]),
        ((1.0, 1e4), READY, ["--units stress=kPa"]),
        ((100.0, 1e1), READY, ["--units strain=%", "--units stress=MPa"]),
        ((1.0, 1e4), RAW, ["--units force=kN"]),
    ],
)
def test_units_that_are_probably_wrong_are_asked_for(scales, words, options):
    found = doubts(scales[0] * STRAIN, scales[1] * STRAIN, words)
    assert [question[: len(o)] for question, o in zip(found, options, strict=True)] == options


@pytest.mark.parametrize(
    ("scales", "words", "wrong"),
    [
        ((100.0, 1e7), RAW, "would be 3000 %; needed: another --gauge"),
        ((0.1, 1e7), READY, "strains up to 0.03; needed: at least 0.04"),
        ((-4.0, -1e7), READY, "a strain of -1 or less"),
        ((1.0, 0.0), READY, "does not rise from a strain of 0.01 to 0.04"),
        ((1.0, 1e13), READY, "a modulus of 10000 GPa; allowed: 0.1 MPa to 1000 GPa; are the"),
        ((1.0, 1e1), RAW, "a modulus of 10 Pa; allowed: .* size of the specimen right"),
    ],
)
def test_what_no_unit_explains_is_refused(scales, words, wrong):
    with pytest.raises(MisfitError, match=wrong):
        doubts(scales[0] * STRAIN, scales[1] * STRAIN, words)
