"""The spread of the best designs as tables of text."""

from collections.abc import Iterable, Iterator

from pandas import DataFrame, Series

from sweep.numbers import budget_text, three_digits
from sweep.ranking.spread import Spread, spread_table
from sweep.report.tables.design_text import design_text
from sweep.report.tables.sheet import Sheet

ABOUT = (
    "lowest, highest: with one uncertain number at a time at an end of its range.\n"
    "places: among these designs only; designs that were not run again may overtake them."
)


def spread_sheets(spreads: Iterable[Spread], summary: DataFrame) -> Iterator[Sheet]:
    """A sheet for each scene and budget; summary: all designs, among which they are described."""
    for spread in spreads:
        rows, table = spread.rows, spread_table([spread])
        budget = rows["budget_g"].iloc[0]
        within = f", up to {budget_text(budget)}" if budget > 0.0 else ""
        design = _differing(rows, summary)
        texts = [list(text) for text in zip(*design.values(), strict=True)]
        labels = [", ".join(filter(None, text)) for text in texts]
        heads = ["#", *design, "value", "lowest", "at", "highest", "at", "places"]
        yield Sheet(
            f"Spread of {spread.column}: {rows['scene'].iloc[0]}{within}",
            heads,
            [_row(row, text) for (_, row), text in zip(table.iterrows(), texts, strict=True)],
            notes=(ABOUT, *_order(spread, labels)),
        )


def _differing(rows: DataFrame, summary: DataFrame) -> dict[str, Series]:
    """The columns that describe the designs, without columns in which all shown ones are equal."""
    columns = design_text(rows, summary) or {"material": rows["material"].astype(str)}
    return {head: text for head, text in columns.items() if len(set(text)) > 1} or columns


def _row(row: Series, design: list[str]) -> list[str]:
    """The texts of a row of `spread_table`."""
    best, worst = row["best_place"], row["worst_place"]
    return [
        *(str(row["place"]), *design, three_digits(row["value"])),
        *(three_digits(row["lowest"]), row["lowest_at"]),
        *(three_digits(row["highest"]), row["highest_at"]),
        str(best) if best == worst else f"{best} to {worst}",
    ]


def _order(spread: Spread, labels: list[str]) -> Iterator[str]:
    """Sentences about the order of the designs, and about missing values."""
    swaps = spread.swaps
    others = {name: labels[spread.first(name)] for name in swaps if spread.first(name) != 0}
    if spread.at_corners.columns.size == 1:
        yield "No number is uncertain here."
    elif not swaps:
        yield "The order of these designs does not change."
    elif not others:
        yield f"The first design stays first; others change places with {', '.join(swaps)}."
    else:
        firsts = "; ".join(f"with {name}, the first is {label}" for name, label in others.items())
        yield f"The order changes: {firsts}."
    if spread.failed:
        yield f"{spread.failed} values are missing: these cases failed or have no such value."
