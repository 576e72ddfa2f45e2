"""Time, strain and stress of a record, from its columns and the user's answers."""

from collections.abc import Iterator
from typing import NamedTuple

import numpy as np

from sweep.array_types import Floats
from sweep.config.faults import MisfitError
from sweep.config.units import in_si
from sweep.coupon.answers import UNITS, Answers
from sweep.coupon.columns import Columns, heads_of, shown, words_of
from sweep.coupon.table import FEWEST, Table, number
from sweep.coupon.unit import POWER
from sweep.numbers import counted, with_unit

SIZES = {"gauge": ("strain", "displacement"), "area": ("stress", "force")}
"""Size of the specimen -> the quantity that follows from it, and the measured quantity."""
NEEDED = {
    "gauge": '"50 mm" (free length of a strip, height of a puck), to make a strain of',
    "area": '"8 mm^2" (section of the specimen), to make a stress of',
}
EVEN = "time and an even speed"  # the head of a travel that was not recorded


class Measured(NamedTuple):
    """Time (n,), s; strain (n,) and stress (n,), Pa; to_scale: false if they are known only up to a
    factor, as a size of the specimen is missing.
    """

    time: Floats
    strain: Floats
    stress: Floats
    to_scale: bool


def measured(table: Table, columns: Columns, answers: Answers) -> Measured | None:
    """The measured curve; None if it cannot be determined. Adds to notes and questions of
    columns.
    """
    for name in UNITS:
        if (answer := getattr(answers, name)) is not None and not answer > 0.0:
            raise MisfitError(f"--{name}: {answer:g} in SI; allowed: above 0")
    _add_travel(columns, answers)
    sizes = {size: _over(size, table, columns, answers) for size in SIZES}
    strain, stress = (None if pair is None else pair[0] for pair in sizes.values())
    time = _time(table, columns, answers, strain)
    if strain is None or stress is None or time is None:
        return None
    to_scale = all(pair is not None and pair[1] for pair in sizes.values())
    return _complete_rows(columns, Measured(time, strain, stress, to_scale))


def _add_travel(columns: Columns, answers: Answers) -> None:
    """Add the travel at an even speed to a record of force over time alone."""
    absent = {"strain", "displacement"}.isdisjoint({*columns.values, *columns.undecided})
    if absent and "time" in columns.values and answers.speed is not None:
        columns.values["displacement"] = answers.speed * columns.values["time"]
        columns.words["displacement"] = EVEN


def _over(
    size: str, table: Table, columns: Columns, answers: Answers
) -> tuple[Floats, bool] | None:
    """Strain or stress, by division by a size of the specimen, if that is known; else the raw
    values.
    """
    ready, raw = SIZES[size]
    divisor: float | None = getattr(answers, size)
    if ready in columns.values and (divisor is None or raw not in columns.values):
        if divisor is not None and (size == "area" or answers.speed is None):
            raise MisfitError(f"--{size} has no effect, as there is a column of {ready}")
        columns.words.pop(raw, None)
        return columns.values[ready], True
    if raw not in columns.values and not columns.undecided & {ready, raw}:
        words = f"--columns {ready}=..., or {raw}=... with --{size}: a head or a number"
        if size == "gauge" and "time" in columns.values:
            words += ', or --speed "5 mm/min" of an even travel with --gauge'
        columns.questions.append(f"{words}; {heads_of(table)}")
        return None
    columns.words.pop(ready, None)
    if divisor is None and (stated := stated_size(table, size)):
        divisor, label = stated
        value = with_unit(divisor, UNITS[size])
        columns.notes.append(f"{size} {value}, from the line {shown(label)}")
    if divisor is None and ready not in columns.undecided:
        head = columns.words.get(raw, raw)
        columns.questions.append(f"--{size} {NEEDED[size]} {head}")
    if raw not in columns.values:
        return None
    return columns.values[raw] / (divisor or 1.0), divisor is not None


def _time(table: Table, columns: Columns, answers: Answers, strain: Floats | None) -> Floats | None:
    """The time of each row, or the travel over its speed."""
    if "time" in columns.values:
        if answers.speed is not None and columns.words.get("displacement") != EVEN:
            raise MisfitError("--speed has no effect, as there is a column of time")
        return columns.values["time"]
    if "time" in columns.undecided:
        return None
    travel = columns.values.get("displacement")
    if travel is None and strain is not None and answers.gauge is not None:
        travel = answers.gauge * strain
    if answers.speed is None:
        gauge = "" if "displacement" in columns.values else ' with --gauge "50 mm"'
        words = f'--speed "150 mm/min" of the travel{gauge}, or --columns time=...'
        columns.questions.append(f"{words}; {heads_of(table)}")
        return None
    if travel is None:
        raise MisfitError("--speed needs a column of displacement, or --gauge")
    columns.notes.append("time from the travel and its speed")
    return np.r_[0.0, np.cumsum(np.abs(np.diff(travel)))] / answers.speed


def _complete_rows(columns: Columns, raw: Measured) -> Measured:
    """The rows without missing numbers whose time is later than in the previous row."""
    whole = np.isfinite(raw.time) & np.isfinite(raw.strain) & np.isfinite(raw.stress)
    time = raw.time[whole]
    if time.size < FEWEST:
        rows = counted(int(time.size), "complete row")
        raise MisfitError(f"{rows} of time, strain and stress; needed: at least {FEWEST}")
    steps = np.diff(time)
    later = np.r_[True, steps > 0.0]
    if (steps < 0.0).any() or later.sum() < FEWEST:
        row = int(np.argmax(steps < 0.0 if (steps < 0.0).any() else steps <= 0.0)) + 1
        raise MisfitError(
            f"the time does not increase from row {row} to row {row + 1} of the numbers: is it "
            "rounded, or are there several tests?"
        )
    if left_out := int(np.sum(~whole)):
        columns.notes.append(f"without a number and left out: {counted(left_out, 'row')}")
    if repeated := int(np.sum(~later)):
        columns.notes.append(f"at the time of the row before, left out: {counted(repeated, 'row')}")
    return Measured(time[later], raw.strain[whole][later], raw.stress[whole][later], raw.to_scale)


LABELS = {
    "gauge": {"gauge", "gage", "anvil", "messlange"},
    "area": {"section", "area", "querschnitt", "flache", "crosssection"},
}
"""Words of a label, of which one is enough."""
AFTER_THE_TEST = {"final", "end"}
L0 = "l0"  # a gauge length


def stated_size(table: Table, name: str) -> tuple[float, str] | None:
    """A size of the specimen in SI and its label, if the lines beside a table state one alone."""
    sizes = list(_sizes(table, name))
    values = {value for value, _ in sizes}
    return sizes[0] if len(values) == 1 else None


def _sizes(table: Table, name: str) -> Iterator[tuple[float, str]]:
    for label, *cells in table.lines:
        words = set(words_of(label))
        named = words & LABELS[name] or (L0 in label.lower() and name == "gauge")
        if not named or words & AFTER_THE_TEST or len(cells) < 2:
            continue
        value = number(cells[0], table.decimal)
        try:
            written = POWER.sub(r"^\1", cells[1].strip("()[] "))
            size = in_si(f"{value} {written}", UNITS[name]) if value else 0.0
        except MisfitError:
            continue
        if size > 0.0:
            yield size, label
