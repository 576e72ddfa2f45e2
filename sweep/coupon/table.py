"""The table of numbers in the export of a testing machine: its heads, their units, its rows.

Machines write lines about the test, then a row of heads, often a row of units, then rows of
numbers. Values are separated by semicolons, tabs, commas or blanks, and numbers have a decimal
point or comma: the combination that makes most values numbers is chosen. The rows of the table are
the longest run of rows of numbers; heads and units stand directly above them. A library that reads
csv files would need all of this as arguments.
"""

import re
from collections.abc import Sequence
from dataclasses import dataclass
from math import isnan, nan
from pathlib import Path

import numpy as np

from sweep.array_types import Floats
from sweep.config.faults import MisfitError
from sweep.config.reading.text import foreign_text, rows_of
from sweep.coupon.unit import is_unit, unit_in_head
from sweep.numbers import counted

Row = list[str]

FEWEST = 20  # rows
FORMS = ((";", ","), (";", "."), ("\t", ","), ("\t", "."), (",", "."), (",", ","), (" ", "."))
"""Separators and decimal signs; of equally good ones, the first is taken."""
WORDS = {";": "semicolons", "\t": "tabs", ",": "commas", " ": "blanks"}
SAMPLE = 400  # lines, spread over the whole text, from which the form is found
NUMBERS = {
    sign: re.compile(rf"[+-]?(?:\d+{point}?\d*|{point}\d+)(?:[eE][+-]?\d+)?", re.ASCII)
    for sign, point in ((".", r"\."), (",", ","))
}
GROUPED = {
    ".": re.compile(r"[+-]?[1-9]\d{0,2}(?:,\d{3})+(?:\.\d+)?", re.ASCII),
    ",": re.compile(r"[+-]?[1-9]\d{0,2}(?:\.\d{3})+(?:,\d+)?", re.ASCII),
}
"""Numbers with a sign between thousands, by their decimal sign."""
LARGE = 1e30  # larger than any measured number
MISSING = ("", "-", "--", "---", "nan", "n/a", "null")


@dataclass(frozen=True)
class Table:
    """Heads and units of columns, their numbers (n, k), and the lines above and below, as text.

    heads: without units; empty if there are none. units: "" where none is stated. values: NaN
    where a number is missing. decimal: the sign in numbers. notes: sentences on how it was read.
    """

    heads: tuple[str, ...]
    units: tuple[str, ...]
    values: Floats
    lines: list[Row]
    decimal: str
    notes: tuple[str, ...]


def read_table(path: Path) -> Table:
    """The table of numbers in a file; `MisfitError` if there is none."""
    lines = foreign_text(path, "a csv file").splitlines()
    lines = [line for line in lines if line.strip()]
    separator, decimal = _form(lines)
    rows = [_cells(line, separator) for line in lines]
    comments = [row[0].startswith("#") for row in rows]
    numbers = [
        [] if comment else _numbers(row, decimal)
        for row, comment in zip(rows, comments, strict=True)
    ]
    numeric = [_is_numeric(row, values) for row, values in zip(rows, numbers, strict=True)]
    first, last = _longest_run(numeric, comments)
    block = [values for values in numbers[first:last] if values]
    if len(block) < FEWEST:
        raise MisfitError(_too_few(len(block)))
    width = max(map(len, block))
    heads, units = _heads(rows[:first], width, decimal)
    values = np.array([row + [nan] * (width - len(row)) for row in block])
    form = f"{WORDS[separator]} between values, decimal {'commas' if decimal == ',' else 'points'}"
    notes = [f"{counted(len(block), 'row')} of {counted(width, 'column')}, {form}"]
    if later := sum(numeric[last:]):
        notes.append(f"below other lines, not read: {counted(later, 'further row')} of numbers")
    beside = rows[:first] if later else rows[:first] + rows[last:]
    return Table(heads, units, values, beside, decimal, tuple(notes))


def _too_few(count: int) -> str:
    if not count:
        return "no rows of numbers; needed: columns such as time_s, strain, stress_Pa"
    return f"{counted(count, 'row')} of numbers: too few for a curve; needed: at least {FEWEST}"


def number(text: str, decimal: str) -> float | None:
    """The number in a cell; None if it has none."""
    if not NUMBERS[decimal].fullmatch(text):
        text = text.replace("\N{MINUS SIGN}", "-")
        if GROUPED[decimal].fullmatch(text):
            text = text.replace("." if decimal == "," else ",", "")
        elif not NUMBERS[decimal].fullmatch(text):
            return None
    value = float(text.replace(",", "."))
    return value if abs(value) < LARGE else None


def _numbers(row: Row, decimal: str) -> list[float]:
    """The numbers of a row, NaN for cells that are no numbers."""
    return [nan if (value := number(text, decimal)) is None else value for text in row]


def _form(lines: Sequence[str]) -> tuple[str, str]:
    """Separator and decimal sign by which most values of the text are numbers."""
    sample = lines[:: max(1, len(lines) // SAMPLE)]

    def more_numbers_than_texts(form: tuple[str, str]) -> int:
        separator, decimal = form
        rows = [_cells(line, separator) for line in sample if not line.startswith("#")]
        pairs = [(row, _numbers(row, decimal)) for row in rows]
        values = [v for row, numbers in pairs if _is_numeric(row, numbers) for v in numbers]
        return sum(-1 if isnan(value) else 1 for value in values)

    return max(FORMS, key=more_numbers_than_texts)


def _cells(line: str, separator: str) -> Row:
    """The values of a line, without empty ones at its end."""
    row = line.split() if separator == " " else rows_of([line], separator)[0]
    row = [text.strip() for text in row]
    while len(row) > 1 and not row[-1]:
        row.pop()
    return row or [""]


def _is_numeric(row: Row, numbers: list[float]) -> bool:
    """Whether at least two values of a row, and half of those that are not empty, are numbers."""
    count = len(numbers) - sum(map(isnan, numbers))
    return count > 1 and 2 * count >= sum(text.lower() not in MISSING for text in row)


def _longest_run(numeric: Sequence[bool], comments: Sequence[bool]) -> tuple[int, int]:
    """First and last + 1 of the longest run of rows of numbers; comments do not end it."""
    best, most, start, count = (0, 0), 0, 0, 0
    for k in range(len(numeric)):
        if numeric[k]:
            count += 1
        elif not comments[k] or not count:
            start, count = k + 1, 0
        if count > most:
            best, most = (start, k + 1), count
    return best


def _heads(above: list[Row], width: int, decimal: str) -> tuple[tuple[str, ...], tuple[str, ...]]:
    """Heads and units of the columns, from the rows above them."""
    rows = [row for row in above if not row[0].startswith("#")] or above
    units: Row = []
    if rows and 2 * sum(map(is_unit, rows[-1])) >= sum(map(bool, rows[-1])) > 0:
        *rows, units = rows
    heads = [text.removeprefix("#").strip() for text in rows[-1]] if rows else []
    if sum(bool(text) and number(text, decimal) is None for text in heads) < 2:
        heads = []  # a line about the test
    if heads and len(heads) < width:
        raise MisfitError(
            f"rows have {width} values, but there are {len(heads)} heads; needed: as many, and "
            "between them another sign than in numbers (0.1, not 0,1, if commas separate values)"
        )
    heads = (heads + [""] * width)[:width]
    units = (units + [""] * width)[:width]
    pairs = [
        (head, unit.strip("()[]<> ")) if unit else unit_in_head(head)
        for head, unit in zip(heads, units, strict=True)
    ]
    return tuple(head for head, _ in pairs), tuple(unit for _, unit in pairs)
