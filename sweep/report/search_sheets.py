"""What a search has found, as tables of text and sentences."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

from sweep.numbers import NOTHING, numerals, three_digits
from sweep.ranking.spread import AS_GIVEN, FINE, Spread, ends
from sweep.report.sheets import Sheet, design_text

if TYPE_CHECKING:
    from pandas import DataFrame, Series

AGAIN = """\
fine mesh: with twice the elements. lowest, highest: of this, of walls 5 % thinner and thicker, and
of a quarter and four times the imperfection, one change at a time."""
NARROW = 0.8  # of its value: a design that keeps less stands on a narrow peak
ONLY_EVALUATED = (
    "This is the front of the designs that were evaluated; the search itself sought only {}."
)


def finalist_sheet(spread: Spread, summary: DataFrame) -> Sheet:
    """The finalists with their values on a fine mesh and with other geometry.

    summary: all designs, among which they are described.
    """
    rows = spread.rows
    columns = {
        "#": rows["place"].astype(str),
        **design_text(rows, summary),
        "mass g": numerals(rows["mass_g"]),
        "value": numerals(rows[spread.column]),
    }
    texts = [list(row) for row in zip(*columns.values(), strict=True)]
    again = [_again(values) for _, values in spread.at_corners.iterrows()]
    return Sheet(
        f"Best designs, simulated again: {spread.column}",
        [*columns, FINE, "lowest", "at", "highest", "at"],
        [text + more for text, more in zip(texts, again, strict=True)],
        notes=(AGAIN, *_verdict(spread)),
    )


def _again(values: Series) -> list[str]:
    """A design's value on the fine mesh, and its lowest and highest one with their corners."""
    others = values.drop(AS_GIVEN)
    found = ends(others)
    if found is None:
        return [NOTHING] * 5
    spans = [text for name in found for text in (three_digits(float(others[name])), name)]
    return [three_digits(float(others.get(FINE, float("nan")))), *spans]


def _verdict(spread: Spread) -> Iterator[str]:
    """Sentences about how far the value of the first design may be trusted."""
    worst, values = spread.worst, spread.at_corners[AS_GIVEN]
    kept = worst / values
    if spread.failed:
        yield f"{spread.failed} values are missing, as these cases failed."
    first = float(kept.iloc[0])
    if first < NARROW or first > 1.0 / NARROW:
        at = _where(spread)
        yield f"The first design stands on a narrow peak: {at} leaves {100 * first:.0f} % of it."
    safest = worst if spread.sign > 0 else -worst
    if safest.notna().any() and (k := int(safest.argmax())):
        place, value = spread.rows["place"].iloc[k], three_digits(float(worst.iloc[k]))
        yield f"The safest of these is number {place}, with {value} at its worst."


def _where(spread: Spread) -> str:
    """The corner at which the first design is worst."""
    others = spread.at_corners.iloc[0].drop(AS_GIVEN)
    return str(others.idxmin() if spread.sign > 0 else others.idxmax())


def front_sheet(rows: DataFrame, summary: DataFrame, other: str) -> Sheet:
    """The Pareto front of two columns: that of the ranking, and another one."""
    column = "" if rows.empty else str(rows["ranked_by"].iloc[0])
    shown = dict.fromkeys([other, column])
    columns = {
        **design_text(rows, summary),
        **{name: numerals(rows[name]) for name in shown if name},
    }
    return Sheet(
        f"Pareto front of {column} and {other}",
        list(columns),
        [list(row) for row in zip(*columns.values(), strict=True)],
        notes=(ONLY_EVALUATED.format(column),),
    )
