"""The results of a search, as tables of text and sentences."""

from collections.abc import Iterator, Mapping

from pandas import DataFrame, Series

from sweep.numbers import NOTHING, in_unit, numerals, percent, three_digits
from sweep.ranking.assessment import ALIKE
from sweep.ranking.ranking import Ranking
from sweep.ranking.spread import AS_GIVEN, FINE, Spread, ends
from sweep.report.tables.design_text import design_text
from sweep.report.tables.marks import mark_notes, marks
from sweep.report.tables.requirement_notes import panel_column
from sweep.report.tables.sheet import Sheet

AGAIN = """\
fine mesh: with twice the elements. lowest, highest: of this, of walls 5 % thinner and thicker, and
of a quarter and four times the imperfection, one change at a time. {}: least and greatest of
these. Near duplicates are left out: the same choices, and sizes within 5 % of a better design."""
NARROW = 0.8  # share of its value: a design that keeps less lies on a narrow peak
FRONT = """\
This is the front of the designs that were evaluated; the search itself sought only {}.
From the best design on, a row is left out if both of its values are within {:.0f} % of those of the
row that was kept last."""


def finalist_sheet(spread: Spread, summary: DataFrame, several: bool = False) -> Sheet:
    """The finalists with their values on a fine mesh and with other geometry.

    summary: all designs, among which they are described. several: they are of one scene among
    others, which the title names.
    """
    rows, mass = spread.rows, "panel g" if "panel_mass_g" in spread.rows else "mass g"
    columns = {
        "#": rows["place"].astype(str) + marks(rows),
        **design_text(rows, summary),
        mass: _masses(spread),
        "value": numerals(rows[spread.column]),
    }
    texts = [list(row) for row in zip(*columns.values(), strict=True)]
    again = [_again(values) for _, values in spread.at_corners.iterrows()]
    where = f"; {rows['scene'].iloc[0]}" if several else ""
    return Sheet(
        f"Best designs, simulated again: {spread.column}{where}",
        [*columns, FINE, "lowest", "at", "highest", "at"],
        [text + more for text, more in zip(texts, again, strict=True)],
        notes=(AGAIN.format(mass), *mark_notes(rows), *_verdict(spread)),
    )


def _masses(spread: Spread) -> Series:
    """From the least to the greatest mass of each design, as text."""
    masses = spread.masses.set_axis(spread.rows.index)
    low, high = numerals(masses.min(axis=1)), numerals(masses.max(axis=1))
    return (low + "-" + high).where(low != high, low)


def _again(values: Series) -> list[str]:
    """A design's value on the fine mesh, and its lowest and highest value with their corners."""
    others = values.drop(AS_GIVEN)
    if others.isna().all():
        return [NOTHING] * 5
    spans = [text for name in ends(others) for text in (three_digits(float(others[name])), name)]
    return [three_digits(float(others.get(FINE, float("nan")))), *spans]


def _verdict(spread: Spread) -> Iterator[str]:
    """Sentences about how reliable the place and the value of the first design are."""
    worst, values = spread.worst, spread.at_corners[AS_GIVEN]
    kept = worst / values
    if spread.failed:
        yield f"{spread.failed} values are missing, as these cases failed."
    yield from _limits_missed(spread)
    yield from _rivals(spread)
    first = float(kept.iloc[0])
    if first < NARROW or first > 1.0 / NARROW:
        low, high = ends(spread.at_corners.iloc[0].drop(AS_GIVEN))
        at = low if spread.sign > 0 else high
        what = f"with {at} it has {percent(first)} % of this value"
        yield f"The first design stands on a narrow peak: {what}."
    safest = worst if spread.sign > 0 else -worst
    if safest.notna().any() and (k := int(safest.argmax())):
        place, value = spread.rows["place"].iloc[k], three_digits(float(worst.iloc[k]))
        yield f"The safest of these is number {place}, with {value} at its worst."


def _rivals(spread: Spread) -> Iterator[str]:
    """Sentences about designs that may be better than the first one."""
    places, values = spread.rows["place"], spread.sign * spread.at_corners
    values.index = places.index
    errors = abs(values.get(FINE, values[AS_GIVEN]) - values[AS_GIVEN])
    behind = values[AS_GIVEN].iloc[0] - values[AS_GIVEN]
    if near := [*map(str, places[behind <= errors + errors.iloc[0]].iloc[1:])]:
        numbers = ", ".join([str(places.iloc[0]), *near])
        yield f"The first place is not certain: the mesh errors of numbers {numbers} overlap."
    ahead: dict[int, list[str]] = {}
    for name in spread.swaps:
        if first := spread.first(name):
            ahead.setdefault(first, []).append(name)
    for row, corners in ahead.items():
        yield f"Number {places.iloc[row]} is the best with {', '.join(corners)}."


def _limits_missed(spread: Spread) -> Iterator[str]:
    """A sentence for each limit and corner at which designs exceed the limit."""
    excess: dict[tuple[str, str], list[str]] = {}
    for place, corner, what in spread.missed:
        excess.setdefault((what, corner), []).append(str(place))
    for (what, corner), places in excess.items():
        several = len(places) > 1
        who = f"Number{'s' if several else ''} {', '.join(places)}"
        if what == "budget":
            yield f"{who} exceed{'' if several else 's'} the budget with {corner}."
        else:
            yield f"{who} do{'' if several else 'es'} not fulfil {what} with {corner}."


def nearest_sheet(ranking: Ranking, missed: Mapping[str, float], summary: DataFrame) -> Sheet:
    """The designs that come nearest to all requirements; missed: from `Assessment`, by id.

    ranking: of all designs, regardless of requirements.
    """
    rows = ranking.table.set_index("case_id", drop=False).loc[list(missed)]
    shares = Series(list(missed.values()), rows.index)
    columns = {
        "case": rows["case_id"].str[:8] + marks(rows),
        **design_text(rows, summary),
        "mass g" if "panel_mass_g" not in rows else "panel g": numerals(rows[ranking.mass]),
        f"{'panel' if 'panel_mass_g' in rows else 'usable'} J": numerals(rows[ranking.energy]),
        "peak N": numerals(rows["passed_on_N"]),
        **panel_column(rows),
        "stroke mm": numerals(in_unit(rows["counted_stroke_m"], "mm")),
        "misses by %": numerals(in_unit(shares, "%")),
    }
    notes = ("misses by: the worst miss, in % of its limit.", *mark_notes(rows))
    return Sheet.of("Nearest to what is required", columns, notes=notes)


def front_sheet(rows: DataFrame, summary: DataFrame, other: str) -> Sheet:
    """The Pareto front of two columns: the column of the ranking, and another one."""
    column = "" if rows.empty else str(rows["ranked_by"].iloc[0])
    shown = dict.fromkeys([other, column])
    columns = {
        "#": rows["place"].astype(str) + marks(rows),
        **design_text(rows, summary),
        **{name: numerals(rows[name]) for name in shown if name},
    }
    notes = (FRONT.format(column, in_unit(ALIKE, "%")), *mark_notes(rows))
    return Sheet.of(f"Pareto front of {column} and {other}", columns, notes=notes)
