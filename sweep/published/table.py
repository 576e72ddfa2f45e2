"""The table of crushes: a csv file with a row for each predicted number.

A row is written in two steps: first the question and the prediction, then the measured value.
"""

import csv
import io
from collections.abc import Iterable
from dataclasses import asdict, dataclass, fields, replace
from pathlib import Path

from sweep.config.faults import MisfitError
from sweep.config.materials.material_header import number_with_range
from sweep.config.reading.examples import FOLDER
from sweep.config.reading.text import rows_of, text_of
from sweep.ranking.comparison import Comparison, Range
from sweep.whole_file import write_whole

OURS = FOLDER / "published" / "crushes.csv"
NEEDED = "a csv file with the heads of configs/published/crushes.csv"


class PublishedError(MisfitError):
    """A table, a row or a value that cannot be used; the text says which, and what is allowed."""


@dataclass(frozen=True)
class Row:
    """One number of a crush: all values as text of the file.

    config: a TOML file, beside the table or by path, or an example. where: key=value, to select
    some of its cases; measure: column of results, or quotient "A / B" of two, or several after ";";
    over: a key; the ratio of the values at its last and first value is taken. per: SI value of the
    unit in `quantity`. low, high, cases, ids, model: the prediction over these cases, with a digest
    of their ids and the version of the model. measured: as "0.12 +- 0.018"; place: the table or
    figure that it is from.
    """

    name: str
    source: str
    quantity: str
    open: str
    config: str
    where: str = ""
    measure: str = "absorbed_energy_J"
    over: str = ""
    per: str = "1"
    low: str = ""
    high: str = ""
    cases: str = ""
    ids: str = ""
    model: str = ""
    measured: str = ""
    place: str = ""

    @property
    def comparison(self) -> Comparison:
        """The row as numbers."""
        predicted = Range(float(self.low), float(self.high)) if self.low else None
        measured = measured_range(self) if self.measured else None
        return Comparison(self.source, self.quantity, self.open, predicted, measured)

    def matches(self, word: str) -> bool:
        """Whether a word is part of its name, its source, its quantity or its config."""
        return word.lower() in f"{self.name} {self.source} {self.quantity} {self.config}".lower()


HEADS = [field.name for field in fields(Row)]


def measured_range(row: Row) -> Range:
    """The measured value with its scatter."""
    value, low, high = number_with_range("measured", row.measured)
    if low is not None and high is not None:
        return Range(low, high)
    assert value is not None  # a range alone gives its ends
    return Range(value, value)


def read_table(path: Path) -> list[Row]:
    """The rows of a table; a row that cannot be used is refused with the file and the row."""
    try:
        heads, *lines = rows_of(text_of(path, NEEDED).splitlines()) or [[]]
    except MisfitError as error:
        raise PublishedError(f"{path}: {error}") from None
    if heads != HEADS:
        raise PublishedError(f"{path}: heads {','.join(heads)}; needed: {','.join(HEADS)}")
    rows = [_row(path, number, line) for number, line in enumerate(lines, 2) if line]
    names = [row.name for row in rows]
    if twice := sorted({name for name in names if names.count(name) > 1}):
        raise PublishedError(f"{path}: name {twice[0]} in two rows; allowed: a name for each row")
    return rows


def _row(path: Path, number: int, values: list[str]) -> Row:
    where = f"{path}, line {number}"
    if len(values) != len(HEADS):
        raise PublishedError(f"{where}: {len(values)} values; needed: {len(HEADS)}, one per head")
    row = Row(*values)
    try:
        numbers = [float(text) for text in (row.per, row.low or "0", row.high or "0")]
        if row.measured:
            measured_range(row)
    except MisfitError as error:
        raise PublishedError(f"{where}: {error}") from None
    except ValueError:
        wrong = f"per = {row.per}, low = {row.low}, high = {row.high}"
        raise PublishedError(f"{where}: {wrong}; allowed: numbers") from None
    if not numbers[0] > 0.0:
        raise PublishedError(f"{where}: per = {row.per}; allowed: a number above 0")
    return row


def write_table(path: Path, rows: Iterable[Row]) -> None:
    """Write a table."""
    text = io.StringIO()
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow(HEADS)
    writer.writerows(asdict(row).values() for row in rows)
    write_whole(path, text.getvalue())


def with_row(rows: Iterable[Row], new: Row) -> list[Row]:
    """The rows with a new one, which replaces a row of the same name.

    The measured value of the old row stays unless the new one has another.
    """
    others = list(rows)
    names = [row.name for row in others]
    if new.name not in names:
        return [*others, new]
    place = names.index(new.name)
    old = others[place]
    others[place] = new if new.measured else replace(new, measured=old.measured, place=old.place)
    return others
