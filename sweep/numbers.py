"""Numbers as text, with few digits."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import pandas as pd

if TYPE_CHECKING:
    from pandas import Series

NOTHING = "–"


def short(value: float | str | None) -> str:
    """A number with four digits, text unchanged, a dash for a missing value."""
    if pd.isna(value):
        return NOTHING
    return f"{value:.4g}" if isinstance(value, float) else str(value)


def numerals(values: Series) -> Series:
    """Numbers as text of `three_digits`."""
    return values.map(three_digits)


def three_digits(value: float) -> str:
    """A number with at least three significant digits, without exponent: 0.0123, 1.23, 1234."""
    if not math.isfinite(value):
        return NOTHING
    decimals = 2 - math.floor(math.log10(abs(value))) if value else 0
    return f"{value:.{max(decimals, 0)}f}"


def percent(value: float) -> str:
    """A strain in percent, rounded to a whole number."""
    return f"{100 * value:.0f}" if math.isfinite(value) else NOTHING


def tenths(share: float) -> str:
    """A share in percent, with one decimal below 10 %."""
    if not math.isfinite(share):
        return NOTHING
    return f"{100 * share:.1f}" if share < 0.0995 else percent(share)


def energy_text(joules: float) -> str:
    """An energy with its unit."""
    return f"{three_digits(joules)} J" if joules >= 1.0 else f"{three_digits(1e3 * joules)} mJ"
