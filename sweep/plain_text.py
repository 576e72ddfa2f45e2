"""Makes foreign texts, such as names in a results file, safe to show and to tabulate."""

import re
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from pandas import DataFrame

CONTROL = re.compile(r"[\x00-\x08\x0b-\x1f\x7f-\x9f\u061c\u200e\u200f\u2028-\u202e\u2066-\u2069]")
FORMULA = re.compile(r"[=+@\t\r-](?![\d.]*$)")


def plain(text: object) -> str:
    """A text in which characters that control a terminal, or reverse the direction of reading, are
    written as their escapes.
    """
    return CONTROL.sub(lambda match: ascii(match.group())[1:-1], str(text))


def csv_text(table: "DataFrame") -> str:
    """A table as the text of a CSV file without formulas, whose lines end alike on all systems."""
    return without_formulas(table).to_csv(index=False, lineterminator="\n")


def without_formulas(table: "DataFrame") -> "DataFrame":
    """A table in whose texts no program finds a formula: texts that begin like one get a quote."""
    from pandas.api.types import is_numeric_dtype

    texts = [name for name in table if not is_numeric_dtype(table[name])]
    return table.assign(**{name: table[name].map(_quoted) for name in texts})


def _quoted(value: object) -> object:
    return f"'{value}" if isinstance(value, str) and FORMULA.match(value) else value
