"""Quantities as people read them: in mm, ms, g, mJ, kPa and percent, with few digits.

Results and the code are in SI. Only this module converts them for tables, pictures, the page and
messages (`in_unit`), except for files whose format has a unit, such as the millimetres of an STL.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable
from typing import TYPE_CHECKING, Any, TypeVar

from sweep.constants import STANDARD_GRAVITY

if TYPE_CHECKING:
    from pandas import Series

Values = TypeVar("Values")

NOTHING = "–"
LARGE = 1e9  # from here on, numbers have an exponent
ROUND_OFF = 1e-12
SMALLEST_SHOWN = 5e-4  # share that has a digit in tenths of a percent
SCALES = {
    "m": ((1e3, "mm"), (1e6, "um")),
    "m^2": ((1e6, "mm2"),),
    "s": ((1.0, "s"), (1e3, "ms"), (1e6, "us")),
    "m/s": ((1.0, "m/s"), (1e3, "mm/s")),
    "kg": ((1e3, "g"),),
    "kg/m^3": ((1.0, "kg/m3"),),
    "J": ((1.0, "J"), (1e3, "mJ")),
    "Pa": ((1e-9, "GPa"), (1e-6, "MPa"), (1e-3, "kPa"), (1.0, "Pa")),
    "rad": ((180.0 / math.pi, "deg"),),
    "1": ((1e2, "%"),),
}
"""Units in which quantities are shown, with the factor from SI; other units are shown unchanged.

A table or a sentence takes the first one in which its greatest value is at least 1.
"""
FACTORS = {name: factor for scales in SCALES.values() for factor, name in scales} | {
    "N": 1.0,
    "1/s": 1.0,
    "kJ/m^3": 1e-3,
    "g/cm3": 1e-3,
    "t/mm3": 1e-12,
    "MB": 1e-6,
    "oz": 1.0 / 28.349523125e-3,
    "g0": 1.0 / STANDARD_GRAVITY,
}
"""Value in a unit that people read / value in SI, by that unit."""


def in_unit(values: Values, unit: str) -> Values:
    """A number, an array or a column in SI in a unit that people read: (0.012, "mm") -> 12.0."""
    quantities: Any = values
    shown: Values = FACTORS[unit] * quantities
    return shown


def to_si(values: Values, unit: str) -> Values:
    """The inverse of `in_unit`: (12.0, "mm") -> 0.012."""
    quantities: Any = values
    shown: Values = quantities / FACTORS[unit]
    return shown


def text_in(value: float, unit: str, digits: int = 4) -> str:
    """A quantity in SI as text with its unit: (0.0123456, "mm") -> "12.35 mm"."""
    return f"{significant(in_unit(value, unit), digits)} {unit}"


def budget_text(grams: float) -> str:
    """A mass in its `budget_unit`: 42.52428 -> "1.5 oz"."""
    unit = budget_unit([grams])
    return f"{budget_number(grams, unit)} {unit}"


def budget_unit(budgets_g: Iterable[float]) -> str:
    """The unit in which masses in g were given: oz if they have at most two decimals there, and
    more in g.
    """
    ounces = [in_unit(to_si(grams, "g"), "oz") for grams in budgets_g]
    return "oz" if _are_round(ounces) and not _are_round(budgets_g) else "g"


def budget_number(grams: float, unit: str) -> str:
    """A mass in a unit, with four digits."""
    return f"{in_unit(to_si(grams, 'g'), unit):.4g}"


def _are_round(masses: Iterable[float]) -> bool:
    """Whether masses have at most two decimals."""
    return all(abs(round(100 * mass) - 100 * mass) < 1e-6 for mass in masses)


def significant(value: float, digits: int) -> str:
    """A number with so many significant digits; a large one has all of its digits, no exponent."""
    text = f"{value:.{digits}g}"
    return f"{value:.0f}" if "e+" in text and abs(value) < LARGE else text


def at_most(value: float, digits: int = 4) -> str:
    """A positive upper bound as text, rounded down, so that the text itself is within it."""
    unit = 10.0 ** (math.floor(math.log10(value)) + 1 - digits)
    return significant(unit * math.floor(value / unit * (1.0 + ROUND_OFF)), digits)


def at_least(value: float, digits: int = 4) -> str:
    """A positive lower bound as text, rounded up."""
    unit = 10.0 ** (math.floor(math.log10(value)) + 1 - digits)
    return significant(unit * math.ceil(value / unit * (1.0 - ROUND_OFF)), digits)


def short(value: float | str | None, digits: int = 4) -> str:
    """A number with so many digits, text unchanged, a dash for a missing value."""
    if value is None or value != value:  # NaN
        return NOTHING
    return significant(value, digits) if isinstance(value, float) else str(value)


def scaled(unit: str, greatest: float) -> tuple[float, str]:
    """The factor from an SI unit to the unit in which values up to ``greatest`` are shown."""
    scales = SCALES.get(unit, ((1.0, unit),))
    large = (scale for scale in scales if not abs(greatest) * scale[0] < 1.0)
    return next(large, scales[-1] if greatest else scales[0])


def with_unit(value: float | str | None, unit: str, digits: int = 4) -> str:
    """A value in SI as text in a unit of its size: 0.0001, "s" -> "100 us"; text unchanged."""
    if not unit or value is None or isinstance(value, str) or math.isnan(value):
        return short(value, digits)
    factor, name = scaled(unit, value)
    return f"{short(factor * value, digits)} {name}"


def numerals(values: Series) -> Series:
    """Numbers as text by `three_digits`, in one notation."""
    return _in_one_notation(values, three_digits, "{:.2e}".format)


def shorts(values: Series) -> Series:
    """Numbers as text by `short`, in one notation."""
    return _in_one_notation(values, short, _short_exponential)


def _in_one_notation(
    values: Series, text: Callable[[float], str], exponential: Callable[[float], str]
) -> Series:
    """Numbers as text; if one of them has an exponent, all that are finite have one."""
    texts = values.map(text)
    if not any("e" in one for one in texts):
        return texts
    return values.map(exponential).where(texts != NOTHING, NOTHING)


def _short_exponential(value: float) -> str:
    factor, _, exponent = f"{value:.3e}".partition("e")
    return f"{float(factor):g}e{exponent}"


def three_digits(value: float) -> str:
    """A number with at least three significant digits: 0.0123, 1.23, 1234; below a millionth with
    an exponent.
    """
    if not math.isfinite(value):
        return NOTHING
    if 0.0 < abs(value) < 1e-6:
        return f"{value:.2e}"
    decimals = 2 - math.floor(math.log10(abs(value))) if value else 0
    return f"{value:.{max(decimals, 0)}f}"


def percent(value: float) -> str:
    """A strain in percent, rounded to a whole number."""
    return f"{in_unit(value, '%'):.0f}" if math.isfinite(value) else NOTHING


def tenths(share: float) -> str:
    """A share in percent, with one decimal below 10 %."""
    if not math.isfinite(share):
        return NOTHING
    return f"{in_unit(share, '%'):.1f}" if share < 0.0995 else percent(share)


def error_share(share: float) -> str:
    """A relative error in percent; one too small for `tenths` is not shown as zero."""
    return "< 0.1" if 0.0 < share < SMALLEST_SHOWN else tenths(share)


def energy_text(joules: float) -> str:
    """An energy with its unit."""
    unit = energy_unit(joules)
    return f"{three_digits(in_unit(joules, unit))} {unit}"


def energy_unit(joules: float) -> str:
    """The unit in which energies up to this one are shown."""
    return "J" if joules >= 1.0 else "mJ"


def counted(count: int, noun: str) -> str:
    """A number of things, such as "1 case" or "1,200 cases"."""
    return f"{count:,} {noun}{'' if count == 1 else 's'}"
