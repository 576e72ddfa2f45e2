"""The check of plausibility: numbers refused with the unit that was meant, and numbers accepted."""

import pytest

from sweep.config.materials.plausibility import in_percent, suspicion, unit_meant


@pytest.mark.parametrize(
    ("key", "value", "unit"),
    [
        *(
            ("modulus", 19.0, "MPa"),
            ("curve_modulus", 3039.0, "MPa"),
            ("yield_stress", 45.0, "MPa"),
        ),
        *(("curve_modulus", 19e3, "kPa"), ("density", 1.2, "g/cm3")),
        *(("density", 1.2e6, None), ("modulus", 19e12, None)),
    ],
)
def test_implausible_numbers_come_with_the_unit_that_was_meant(key, value, unit):
    assert unit_meant(key, value) == unit
    assert (f"is it in {unit}?" in suspicion(key, value)) == (unit is not None)


def test_plausible_numbers_pass():
    numbers = {"modulus": [19e3, 2e11], "density": [300.0, 8e3], "loss": [1e9]}
    assert {suspicion(key, value) for key in numbers for value in numbers[key]} == {None}


def test_strains_in_percent_are_far_or_begin_far():
    assert in_percent((1.0, 2.0, 5.0))
    assert in_percent((0.02, 15.0))
    assert not in_percent((-0.6, 0.02, 8.0))
    assert not in_percent(())


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ('density = "1200 kg/m^3"\nmodulus = "19 Pa"', ["1 kPa to 1000 GPa", "in MPa?"]),
        ('modulus = "19 MPa"\ndensity = "1.2 kg/m^3"', ["25,000 kg/m3", "in g/cm3?"]),
    ],
)
def test_configs_are_checked(last_refused, text, words):
    assert last_refused(f"[material]\n{text}", *words)
