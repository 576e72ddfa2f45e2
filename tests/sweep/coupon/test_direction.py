"""Pulled or pressed: by the file, by the stiffness, or by a question to the user."""

import numpy as np
import pytest

from sweep.coupon.direction import directed, doubt, sides_of, stated_test

STRAIN = np.r_[np.linspace(0.0, 0.4, 81), np.linspace(0.4, 0.0, 81)[1:]]
FALLING = 6e6 * (1.0 + STRAIN - (1.0 + STRAIN) ** -2)  # pulled rubber
GROWING = 4e6 * ((1.0 - STRAIN) ** -2 - (1.0 - STRAIN))  # pressed rubber


@pytest.mark.parametrize(
    ("texts", "test"),
    [
        (["Compressive strain"], "pressed"),
        (["Time", "Druckversuch 4"], "pressed"),
        (["Tensile stress"], "pulled"),
        (["Tensile strain", "Compression"], None),
        (["Time", "Load"], None),
    ],
)
def test_what_a_file_says(texts, test):
    assert stated_test(texts) == test


@pytest.mark.parametrize("strain_sign", [1.0, -1.0])
@pytest.mark.parametrize("stress_sign", [1.0, -1.0])
def test_signs_are_those_of_the_test(strain_sign, stress_sign):
    strain, stress = strain_sign * STRAIN, stress_sign * FALLING
    assert sides_of(strain, stress) == (strain_sign, stress_sign)
    for test, sign in (("pulled", 1.0), ("pressed", -1.0)):
        found = directed(strain, stress, test)
        assert found[0] == pytest.approx(sign * STRAIN)
        assert found[1] == pytest.approx(sign * FALLING)
    asked = doubt(strain, stress, None, to_scale=True)
    assert (asked is not None) == (strain_sign != stress_sign)


def test_stiffness_that_grows_is_no_printed_strip():
    for shown in (0.05, 0.1, 0.4):
        rows = shown >= STRAIN
        assert "grows by" in doubt(STRAIN[rows], GROWING[rows], None, to_scale=shown < 0.4)
        assert doubt(STRAIN[rows], FALLING[rows], None, to_scale=True) is None
    far = np.linspace(0.0, 5.0, 501)
    stiff_at_last = 6e6 * (1.0 + far - (1.0 + far) ** -2) + 1e6 * far**4
    assert doubt(far, stiff_at_last, None, to_scale=True) is None


@pytest.mark.parametrize(
    ("signs", "test", "words"),
    [
        ((1, 1), "pulled", None),
        ((1, 1), "pressed", None),
        ((-1, -1), "pulled", "words of pulling"),
        ((-1, 1), "pulled", None),
        ((-1, -1), None, None),
    ],
)
def test_words_and_signs_say_the_direction(signs, test, words):
    found = doubt(signs[0] * STRAIN, signs[1] * GROWING, test, to_scale=True)
    assert words in found if words else found is None
