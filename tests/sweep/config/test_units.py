"""Numbers with units in SI."""

import time

import pytest
from scipy import constants

from sweep.config.units import in_si

INCH, POUND = constants.inch, constants.pound


@pytest.mark.parametrize(
    ("text", "unit", "value"),
    [
        ("0.8 mm", "m", 0.8e-3),
        ("0.8mm", "m", 0.8e-3),
        ("400 um", "m", 0.4e-3),
        ("3 meters", "m", 3.0),
        ("3 millimetres", "m", 3e-3),
        ("100 mm/min", "m/s", 0.1 / 60),
        ("100 mm per min", "m/s", 0.1 / 60),
        ("5/s", "1/s", 5.0),
        ("5 %/s", "1/s", 0.05),
        ("5 s^-1", "1/s", 5.0),
        ("12 N/mm^2", "Pa", 12e6),
        ("12 N / mm**2", "Pa", 12e6),
        ("12 N/mm²", "Pa", 12e6),
        ("3 kg m^2/s^2", "J", 3.0),
        ("3 N·m", "J", 3.0),
        ("6 kg/m/m*s/s/m", "kg/m^3", 6.0),
        ("1.19 g/cm^3", "kg/m^3", 1190.0),
        ("45 deg", "rad", constants.pi / 4.0),
        ("20 %", "1", 0.2),
        ("80 g0", "m/s^2", 80.0 * constants.g),
    ],
)
def test_quantities(text, unit, value):
    assert in_si(text, unit) == pytest.approx(value, rel=1e-14)


@pytest.mark.parametrize(
    ("names", "si", "value"),
    [
        ("in inch inches", "m", INCH),
        ("ft foot feet", "m", constants.foot),
        ("thou", "m", constants.mil),
        ("oz ounce ounces", "kg", constants.oz),
        ("lb lbs pound", "kg", POUND),
        ("kgf kilogram_force", "N", constants.kgf),
        ("lbf pound_force", "N", constants.lbf),
        ("psi", "Pa", constants.psi),
        ("bar", "Pa", constants.bar),
        ("GPa gigapascal", "Pa", constants.giga),
        ("min minutes", "s", constants.minute),
        ("h hours", "s", constants.hour),
        ("deg degrees", "rad", constants.degree),
    ],
)
def test_units_are_those_of_scipy(names, si, value):
    for name in names.split():
        assert in_si(f"1 {name}", si) == pytest.approx(value, rel=1e-12)


@pytest.mark.parametrize("number", ["0.3", "0.7", "123.4"])
def test_value_is_the_float_that_is_nearest_to_the_decimals(number):
    assert in_si(f"{number} mm", "m") == float(f"{number}e-3")
    assert in_si(f"{number} g/cm^3", "kg/m^3") == float(f"{number}e3")


NO_MASS = ["gg", "KG", "g^", "g^x", "g*", "*g", "g//s", "%", "((", "1/0", "g^10", "1s", "m1", "%s"]


@pytest.mark.parametrize("unit", [*NO_MASS, "km2"])
def test_what_is_no_unit_of_mass_is_refused(unit):
    with pytest.raises(ValueError, match=r"unknown unit|of another kind|not a number"):
        in_si(f"4 {unit}", "kg")


@pytest.mark.parametrize("text", ["4 %%", "4 % %"])
def test_percent_is_written_once(text):
    with pytest.raises(ValueError, match="unknown unit"):
        in_si(text, "1")


@pytest.mark.parametrize(
    ("text", "why"),
    [
        (True, "no quantity"),
        ([], "no quantity"),
        ("a", "not a number with a unit"),
        ("٣ m", "not a number with a unit"),
        (25, "a bare number"),
        ("1e999 m", "too large"),
        ("1e308 km", "too large"),
        ("-1e31 m", "too large"),
        ("1e-29 mm", "too small"),
        ("-1e-999 m", "too small"),
        ("1 s", "of another kind"),
    ],
)
def test_reasons(text, why):
    with pytest.raises(ValueError, match=why):
        in_si(text, "m")


@pytest.mark.parametrize(
    ("piece", "count"), [("m ", 10**5), ("m*", 10**5), ("s^", 10**5), ("  ", 10**6), ("9", 10**6)]
)
def test_long_texts_cost_no_time(piece, count):
    started = time.process_time()
    with pytest.raises(ValueError, match=r"unknown unit|another kind"):
        in_si(f"1 m{count * piece}x", "m")
    assert time.process_time() - started < 1.0
