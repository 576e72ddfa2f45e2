"""Estimates by unit columns beside the values of the whole models, as tables of text."""

from collections.abc import Iterator
from math import isnan

from pandas import DataFrame, Series

from sweep.numbers import NOTHING, budget_text, three_digits
from sweep.ranking.merit import merits
from sweep.ranking.question import Question
from sweep.ranking.rank import answer
from sweep.ranking.unfinished import loaded
from sweep.report.tables.design_text import design_text
from sweep.report.tables.sheet import Sheet

ABOUT = (
    "estimate: one cell, scaled by mass; not a result, and in no ranking. full: the whole model; "
    f"{NOTHING}: not run, or it failed."
)
FEWEST = 3  # number of designs whose order is stated


def screen_sheets(estimates: DataFrame, summary: DataFrame, question: Question) -> Iterator[Sheet]:
    """A sheet for each scene and budget. summary: rows of the whole models; question: arguments of
    `rank`, without requirements, as they apply to the whole models.
    """
    table = answer(estimates, question._replace(top=None, require=None)).table
    finished = loaded(summary)
    usual = question._replace(by=None, allowed_force=None)
    compared = merits(finished, usual)[0].set_index("case_id")
    for (_, scene), rows in table.groupby(["budget_g", "scene"], dropna=False, sort=False):
        column, budget = str(rows["ranked_by"].iloc[0]), rows["budget_g"].iloc[0]
        within = f", up to {budget_text(budget)}" if budget > 0.0 else ""
        full = compared[column] if column in compared else compared.index.to_series() * float("nan")
        both = rows.assign(full=rows["case_id"].map(full).astype(float))
        design = design_text(rows, estimates)
        texts = zip(*design.values(), strict=True) if design else [()] * len(rows)
        yield Sheet(
            f"Estimates of {column}: {scene}{within}",
            ["#", *design, "estimate", "full", "full / estimate"],
            [
                [str(row["place"]), *text, *_values(row[column], row["full"])]
                for (_, row), text in zip(both.iterrows(), texts, strict=True)
            ],
            notes=(ABOUT, *_agreement(both[column], both["full"])),
        )


def _values(estimate: float, full: float) -> list[str]:
    """The texts of an estimate, of the value of the whole model if it is known, and of their
    ratio.
    """
    if isnan(full):
        return [three_digits(estimate), NOTHING, NOTHING]
    return [three_digits(value) for value in (estimate, full, full / estimate)]


def _agreement(estimate: Series, full: Series) -> Iterator[str]:
    """How well estimates agree with whole models, for the designs that have both."""
    both = full.notna()
    if not both.any():
        return
    ratio = (full / estimate)[both]
    text = f"{both.sum()} of {len(full)} designs ran as a whole: full / estimate "
    text += f"{ratio.min():.2f} to {ratio.max():.2f}"
    if both.sum() >= FEWEST:
        order = estimate[both].rank().corr(full[both].rank())
        text += f", rank correlation {order:.2f}"
    yield f"{text}."
