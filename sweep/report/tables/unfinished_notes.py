"""Sentences on cases that stopped and could have had a place in a ranking, each with its reason."""

from collections.abc import Callable, Iterator
from textwrap import fill

import numpy as np
from pandas import DataFrame, Series, concat

from sweep.numbers import budget_text
from sweep.ranking.ranking import Ranking
from sweep.report.tables.design_text import design_labels
from sweep.report.tables.requirement_notes import WIDTH

MOST = 5  # most cases that are named for each scene
MORE = "{} more unfinished cases could have had a place: crumple status lists them."


def unfinished_notes(rows: DataFrame, named: Callable[[DataFrame], str]) -> Iterator[str]:
    """A sentence for each of the first `MOST` cases, and one with the number of the others.

    rows: from `Ranking.unfinished`, of one scene. named: the id and the design of a row, in words.
    """
    cases = each_once(rows)
    for at in cases.index[:MOST]:
        row = cases.loc[at]
        words = f"Unfinished: {named(cases.loc[[at]])}: {place_text(row)}; {row['message']}."
        yield fill(words, WIDTH)
    if len(cases) > MOST:
        yield MORE.format(len(cases) - MOST)


def picture_note(ranking: Ranking) -> str:
    """Lines that name the unfinished cases below a picture; empty without any."""
    cases = each_once(ranking.unfinished)
    labels = design_labels(cases, concat([ranking.table, cases])) if len(cases) else []
    lines = [
        f"Unfinished, not shown: {label}: {place_text(row)}."
        for label, (_, row) in zip(labels[:MOST], cases.iterrows(), strict=False)
    ]
    return "\n".join(lines + ([MORE.format(len(cases) - MOST)] if len(cases) > MOST else []))


def each_once(rows: DataFrame) -> DataFrame:
    """The rows of each case in the budget in which it could have had the best place."""
    return rows.sort_values(["best_place", "least_place"], kind="stable").drop_duplicates("case_id")


def place_text(row: Series) -> str:
    """The least or the best possible place of a stopped case, by the values it had reached, in
    words.
    """
    budget = f" up to {budget_text(row['budget_g'])}" if row["budget_g"] > 0.0 else ""
    if np.isnan(row["least_place"]):
        return f"could have had place {row['best_place']}{budget}"
    better = " or better" if row["best_place"] < row["least_place"] else ""
    return f"would have place {row['least_place']:.0f}{better}{budget}, by what it had reached"
