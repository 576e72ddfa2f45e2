"""Measured values as people write them."""

import pytest

from sweep.published.quantity import split_quantity
from sweep.published.table import PublishedError


@pytest.mark.parametrize(
    ("text", "units", "number", "unit", "per"),
    [
        ("0.12 +- 0.018 J", "J", "0.12 +- 0.018", "J", 1.0),
        ("120 mJ", "J", "120", "mJ", 1e-3),
        ("0.078 .. 0.081 MPa", "Pa", "0.078 .. 0.081", "MPa", 1e6),
        ("3 (2 .. 4) kJ/m^3", "J/m^3", "3 (2 .. 4)", "kJ/m^3", 1e3),
        ("38 %", "1", "38", "%", 0.01),
        ("0.7", "1", "0.7", "", 1.0),
    ],
)
def test_number_and_unit_are_parted(text, units, number, unit, per):
    assert split_quantity(text, units) == (number, unit, pytest.approx(per))


@pytest.mark.parametrize(
    ("text", "wrong"),
    [
        ("0.12", 'a bare number; needed: a unit, such as "J"'),
        ("0.12 N", "a unit of another kind"),
        ("much", "no number"),
        ("1 +- J", "no number"),
    ],
)
def test_others_are_refused_with_what_is_allowed(text, wrong):
    with pytest.raises(PublishedError, match=f"--measured {text.replace('+', '.')}: ") as refusal:
        split_quantity(text, "J")
    assert wrong in str(refusal.value)
    assert "allowed: " in str(refusal.value)
