"""Numbers with units in SI."""

import time

import pytest
from scipy import constants

from sweep.config.units import in_si

SPELLINGS = {
    ("m", 0.8e-3): ["0.8 mm", "0.8mm", "800 um", "800 µm", "0.8 millimetres"],
    ("m/s", 0.1 / 60): ["100 mm/min", "100 mm per min", "6 metres/hour"],
    ("1/s", 5.0): ["5/s", "500 %/s", "5 s^-1"],
    ("Pa", 12e6): ["12 N/mm^2", "12 N / mm**2", "12 N/mm²", "0.012 GPa", "0.012 gigapascal"],
    ("J", 3.0): ["3 kg m^2/s^2", "3 N·m"],
    ("kg/m^3", 6.0): ["6 kg/m/m*s/s/m", "0.006 g/cm^3", "6 kg/m3", "0.006 g/cm3"],
    ("1", 0.2): ["20 %"],
    ("m/s^2", 80.0 * constants.g): ["80 g0"],
    ("m", constants.inch): ["1 in", "1 inch", "1 inches"],
    ("m", constants.foot): ["1 ft", "1 foot", "1 feet"],
    ("m", constants.mil): ["1 thou"],
    ("kg", constants.oz): ["1 oz", "1 ounce", "1 ounces"],
    ("kg", constants.pound): ["1 lb", "1 lbs", "1 pound"],
    ("N", constants.kgf): ["1 kgf", "1 kilogram_force"],
    ("N", constants.lbf): ["1 lbf", "1 pound_force"],
    ("Pa", constants.psi): ["1 psi"],
    ("Pa", constants.bar): ["1 bar"],
    ("s", constants.minute): ["1 min", "1 minutes"],
    ("s", constants.hour): ["1 h", "1 hours"],
    ("rad", constants.degree): ["1 deg", "1 degrees"],
}


@pytest.mark.parametrize(("unit", "value"), SPELLINGS)
def test_quantities(unit, value):
    for text in SPELLINGS[unit, value]:
        assert in_si(text, unit) == pytest.approx(value, rel=1e-12), text


@pytest.mark.parametrize("number", ["0.3", "0.7", "123.4"])
def test_value_is_the_float_that_is_nearest_to_the_decimals(number):
    assert in_si(f"{number} mm", "m") == float(f"{number}e-3")
    assert in_si(f"{number} g/cm^3", "kg/m^3") == float(f"{number}e3")


NO_MASS = ["gg", "KG", "g^", "g^x", "g*", "*g", "g//s", "%", "((", "1/0", "g^10", "1s", "m1", "%s"]


@pytest.mark.parametrize("text", ["1/12 ft", "3/12 in", "1/13 in", "50 12 m", "2 %2", "5 1/12 ft"])
def test_a_fraction_is_no_power(text):
    with pytest.raises(ValueError, match=r"unknown unit|another kind"):
        in_si(text, "m")


@pytest.mark.parametrize("unit", [*NO_MASS, "km2"])
def test_what_is_no_unit_of_mass_is_refused(unit):
    with pytest.raises(ValueError, match=r"unknown unit|of another kind|not a number"):
        in_si(f"4 {unit}", "kg")


@pytest.mark.parametrize("text", ["12,5 mm", "1, mm", "1,000 mm"])
def test_a_comma_is_no_decimal_point(text):
    with pytest.raises(ValueError, match="decimal comma"):
        in_si(text, "m")


@pytest.mark.parametrize("text", ["4 %%", "4 % %"])
def test_percent_is_written_once(text):
    with pytest.raises(ValueError, match="unknown unit"):
        in_si(text, "1")


REASONS = {
    "no quantity": [True, []],
    "not a number with a unit": ["a", "٣ m"],
    "a bare number": [25],
    "too large": ["1e999 m", "1e308 km", "-1e31 m"],
    "too small": ["1e-29 mm", "-1e-999 m"],
    "of another kind": ["1 s"],
}


@pytest.mark.parametrize("why", REASONS)
def test_reasons(why):
    for text in REASONS[why]:
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
