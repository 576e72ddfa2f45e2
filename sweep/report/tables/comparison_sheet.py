"""Predictions beside measured values, as a table of text."""

from collections.abc import Iterable
from textwrap import wrap

from sweep.numbers import NOTHING, in_unit, significant
from sweep.ranking.comparison import Comparison, Range, inside
from sweep.report.tables.sheet import Sheet

HEADS = ["source", "quantity", "open", "predicted", "measured", "inside"]
LINE = 98  # columns of text of a note
NOTES = (
    "predicted: from the least to the greatest value over all that the source leaves open.",
    "inside: whether this range meets the measured value with its scatter; if not, by how much of "
    "the value it is too low (-) or too high (+).",
)


def comparison_sheet(comparisons: Iterable[Comparison]) -> Sheet:
    """A row for each number, rows of one source together, and how many are inside."""
    rows = list(comparisons)
    opens = frozenset(k for k in range(1, len(rows)) if rows[k].source != rows[k - 1].source)
    texts = [
        [
            row.source if not k or k in opens else "",
            row.quantity,
            row.open or NOTHING,
            span(row.predicted),
            span(row.measured),
            verdict(row),
        ]
        for k, row in enumerate(rows)
    ]
    notes = [line for note in (summary(rows), *NOTES) for line in wrap(note, LINE)]
    return Sheet("", HEADS, texts, opens, ("\n".join(notes),))


def span(values: Range | None) -> str:
    """A range in three digits: "0.0661..0.0903"; a single number if both ends are the same text."""
    if values is None:
        return NOTHING
    low, high = (significant(value, 3) for value in values)
    return low if low == high else f"{low}..{high}"


def verdict(row: Comparison) -> str:
    """Whether the prediction meets the measured value, or by how many percent it misses."""
    if row.off is None:
        return NOTHING
    return "yes" if row.off == 0.0 else f"{in_unit(row.off, '%'):+.2g} %"


def summary(rows: list[Comparison]) -> str:
    """How many predictions are inside."""
    met, compared = inside(rows)
    count = len(rows) - compared
    waiting = f"; {count} wait{'s' * (count == 1)} for a value" if count else ""
    return f"{met} of {compared} inside{waiting}."
