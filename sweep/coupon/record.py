"""Reads the record of a coupon, a printed strip or puck that was loaded, unloaded and loaded again.

It reads the unchanged export of a testing machine (`table`, `columns`), with time, strain or
displacement, and stress or force (`measured`). Nominal strain and stress are positive in tension;
in a puck that is pressed, both are negative (`direction`). Travel that was not set to zero, preload
and slack are shifted (`zero`). All open questions are asked at once, each with the option that
decides it.
"""

from collections.abc import Iterable
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from sweep.array_types import Floats
from sweep.config.faults import MisfitError
from sweep.coupon import direction, zero
from sweep.coupon.answers import Answers
from sweep.coupon.check import doubts
from sweep.coupon.columns import Columns, columns_of
from sweep.coupon.measured import Measured, measured
from sweep.coupon.table import read_table


class CouponError(MisfitError):
    """A record that cannot be used; the text has the file and the fault, or all open questions."""


@dataclass(frozen=True)
class Coupon:
    """Time (n,) in s from the first row, nominal strain (n,) and stress (n,) in Pa.

    sign: 1 for a strip that is pulled, -1 for a puck that is pressed. notes: sentences on how the
    record was read.
    """

    name: str
    time: Floats
    strain: Floats
    stress: Floats
    notes: tuple[str, ...] = ()

    @property
    def sign(self) -> float:
        """The sign of the strains."""
        return 1.0 if self.strain.max() > -self.strain.min() else -1.0


def read_coupon(path: Path, answers: Answers | None = None) -> Coupon:
    """Read and check a record."""
    try:
        return _coupon(path, answers or Answers())
    except MisfitError as error:
        raise CouponError(f"{path}: {error}") from None


def _coupon(path: Path, answers: Answers) -> Coupon:
    words = ("test", answers.test, direction.SIGNS), ("zero", answers.zero, zero.CHOICES)
    for option, word, allowed in words:
        if word not in (None, *allowed):
            raise MisfitError(f"--{option} {word}; allowed: {', '.join(allowed)}")
    table = read_table(path)
    columns = columns_of(table, answers.columns, answers.units)
    raw = measured(table, columns, answers)
    if raw is None:
        raise MisfitError(_question_text(columns.questions))
    for quantity, values in (("strain", raw.strain), ("stress", raw.stress)):
        if not np.ptp(values):
            raise MisfitError(f"the same {quantity} in all rows; needed: a column that changes")
    texts = [*table.heads, *(" ".join(row) for row in table.lines)]
    time, strain, stress = _zeroed(_directed(raw, columns, answers, texts), columns, answers)
    if raw.to_scale:
        columns.questions += doubts(strain, stress, columns.words)
    if columns.questions:
        raise MisfitError(_question_text(columns.questions))
    heads = (f"{quantity} from {head}" for quantity, head in columns.words.items())
    notes = (columns.notes[0], ", ".join(heads), *columns.notes[1:])
    return Coupon(path.stem, time - time[0], strain, stress, notes)


def _question_text(questions: list[str]) -> str:
    """All open questions, in one message."""
    if len(questions) == 1:
        return f"needed: {questions[0]}"
    return "\n  ".join(["needed, all in one command:", *questions])


def _directed(raw: Measured, columns: Columns, answers: Answers, texts: Iterable[str]) -> Measured:
    """The measured curve with the signs of the test, or the question which test it is."""
    stated = direction.stated_test(texts)
    doubt = direction.doubt(raw.strain, raw.stress, stated, raw.to_scale)
    if doubt and answers.test is None:
        columns.questions.append(f"--test pulled or --test pressed: {doubt}")
        return raw
    test = answers.test or stated
    if test is None or direction.sides_of(raw.strain, raw.stress) == direction.SIGNS[test]:
        return raw
    strain, stress = direction.directed(raw.strain, raw.stress, test)
    columns.notes.append(
        f"{test}, as {'--test' if answers.test else 'the file'} says, not its signs"
    )
    return raw._replace(strain=strain, stress=stress)


def _zeroed(raw: Measured, columns: Columns, answers: Answers) -> tuple[Floats, Floats, Floats]:
    """Time, strain and stress shifted to begin at zero; asks how to shift them if in doubt."""
    path = (raw.time, raw.strain, raw.stress)
    if answers.zero is None:
        if doubt := zero.doubt(raw.strain, raw.stress, raw.to_scale):
            columns.questions.append(f"--zero first or --zero line: {doubt}")
            return zero.from_first(*path)[0]
        if zero.begins_at_zero(raw.strain, raw.stress):
            return path
    shift = zero.from_line if answers.zero == "line" else zero.from_first
    path, note = shift(*path)
    columns.notes.append(note)
    return path
