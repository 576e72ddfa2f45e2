"""Quantities in the units of people, and numbers as text."""

import numpy as np
import pandas as pd
import pytest

from sweep.config.units import quantity
from sweep.numbers import (
    FACTORS,
    NOTHING,
    SCALES,
    at_least,
    at_most,
    budget_number,
    budget_text,
    budget_unit,
    in_unit,
    numerals,
    percent,
    short,
    shorts,
    tenths,
    text_in,
    three_digits,
    to_si,
    with_unit,
)

NAN = float("nan")


@pytest.mark.parametrize("si", SCALES)
def test_factors_are_those_of_the_units_that_configs_read(si):
    """`config.units` reads what is shown: 1 mm is 0.001 m."""
    for _, unit in SCALES[si]:
        written = f"1 {unit.replace('m3', 'm^3').replace('m2', 'm^2')}"
        assert to_si(1.0, unit) == pytest.approx(quantity(written, si))


def test_quantities_are_shown_in_a_unit_and_read_back():
    lengths = np.array([0.0123456, -2.0])
    assert in_unit(lengths, "mm") == pytest.approx([12.3456, -2000.0])
    assert to_si(in_unit(lengths, "mm"), "mm") == pytest.approx(lengths)
    assert text_in(0.0123456, "mm") == "12.35 mm"
    assert text_in(0.125, "%", 6) == "12.5 %"
    assert (text_in(10.0, "mm"), text_in(123.4567, "g")) == ("10000 mm", "123457 g")
    assert text_in(1e12, "mm") == "1e+15 mm"
    assert in_unit(9.80665, "g0") == pytest.approx(FACTORS["N"])


def test_numbers_show_three_digits():
    numbers = [0.01234, 0.5, 9.996, 12345.6, -7.0, 0.0, 1.234e-300, NAN, float("inf")]
    expected = ["0.0123", "0.500", "10.00", "12346", "-7.00", "0", "1.23e-300", "–", "–"]
    assert [three_digits(number) for number in numbers] == expected


@pytest.mark.parametrize(
    ("numbers", "texts"),
    [
        ([1e-4, 2e-6], ["0.000100", "0.00000200"]),
        ([1e-4, 2e-7, NAN, 0.0], ["1.00e-04", "2.00e-07", NOTHING, "0.00e+00"]),
        ([], []),
    ],
)
def test_a_column_has_one_notation(numbers, texts):
    assert list(numerals(pd.Series(numbers, dtype=float))) == texts


def test_a_column_of_short_numbers_has_one_notation():
    assert list(shorts(pd.Series([1e-4, 0.3]))) == ["0.0001", "0.3"]
    assert list(shorts(pd.Series([1e-4, 2.5e-6, NAN]))) == ["1e-04", "2.5e-06", NOTHING]
    assert list(shorts(pd.Series([3, 4]))) == ["3", "4"]


def test_shares_are_percent():
    assert [percent(share) for share in (0.996, NAN)] == ["100", NOTHING]
    assert [tenths(share) for share in (0.0994, 0.0996, NAN)] == ["9.9", "10", NOTHING]


def test_values_of_keys_are_short():
    assert [short(value) for value in (0.123456, 3, "hex", None)] == ["0.1235", "3", "hex", "–"]


def test_quantities_are_in_a_unit_of_their_size():
    pairs = [(1e-4, "s"), (0.5, "s"), (90.0, "s"), (0.06, "J"), (5e5, "Pa"), (0.4, "1")]
    shown = [with_unit(value, unit) for value, unit in pairs]
    assert shown == ["100 us", "500 ms", "90 s", "60 mJ", "500 kPa", "40 %"]
    assert [with_unit(v, "s") for v in ("bdf2", NAN, None)] == ["bdf2", NOTHING, NOTHING]
    assert [with_unit(v, u) for v, u in ((0.0, "s"), (3, ""), (5.0, "N"))] == ["0 s", "3", "5 N"]


BOUNDS = [(1.25e-3, "0.00125", "0.00125"), (0.359277, "0.3592", "0.3593"), (51.4, "51.4", "51.4")]


@pytest.mark.parametrize(("value", "most", "least"), BOUNDS)
def test_bounds_are_rounded_to_the_side_on_which_they_hold(value, most, least):
    assert (at_most(value), at_least(value)) == (most, least)


@pytest.mark.parametrize(
    ("grams", "text"),
    [
        (25.0, "25 g"),
        (42.5242847, "1.5 oz"),
        (453.59237, "16 oz"),
        (0.123456, "0.1235 g"),
        (28.35, "28.35 g"),
    ],
)
def test_a_budget_is_told_in_the_unit_in_which_it_is_round(grams, text):
    assert budget_text(grams) == text


def test_budgets_share_a_unit():
    assert budget_unit([28.349523125, 42.5242846875]) == "oz"
    assert budget_unit([25.0, 42.5242846875]) == "g"
    assert budget_number(42.5242846875, "g") == "42.52"
