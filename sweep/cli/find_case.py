"""Finds the case that a user names: by its number in the ranking, or by the beginning of its id."""

import re

from pandas import DataFrame, Series

from sweep.cli.refusals import ArgumentError
from sweep.numbers import budget_text
from sweep.ranking.merit import doubtful
from sweep.ranking.question import Question
from sweep.ranking.rank import answer
from sweep.ranking.ranking import Ranking
from sweep.report.tables.design_text import named_case

NUMBER = re.compile(r"0|-?[1-9]\d{0,2}")  # in the ranking; other digits begin an id


def is_number(text: str) -> bool:
    """Whether a text is a number in a ranking, and not the beginning of an id."""
    return NUMBER.fullmatch(text) is not None


def by_id(summary: DataFrame, prefix: str) -> Series:
    """The only row whose id begins with ``prefix``."""
    rows = summary[summary["case_id"].str.startswith(prefix or " ")]
    if len(rows) == 1:
        return rows.iloc[0]
    if rows.empty:
        allowed = "allowed: a number in the ranking, from 1, or the beginning of an id"
        every = f"without CASE, show lists all {len(summary)} ids"
        raise ArgumentError(f'no case "{prefix}"; {allowed}; {every}')
    ids = ", ".join(rows["case_id"].head(4)) + (" ..." if len(rows) > 4 else "")
    raise ArgumentError(f'"{prefix}" begins {len(rows)} ids: {ids}')


def by_number(
    summary: DataFrame, number: int, scene: str | None, question: Question
) -> tuple[Series, str]:
    """The row with a number in the ranking of one scene, within the first budget; and a sentence.

    scene: see `_scene`.
    """
    ranking = answer(summary, question._replace(top=max(number, 1)))
    table = ranking.table
    placed = list(dict.fromkeys(table["scene"]))
    label = _scene(list(ranking.lightest_g) or [""], scene, (placed or [""])[0])
    rows = table[table["scene"] == label]
    if rows.empty:
        raise ArgumentError(_no_place(ranking, label, summary))
    budget = rows["budget_g"].iloc[0]
    rows = rows[rows["budget_g"].isna() if budget != budget else rows["budget_g"] == budget]
    within = f", up to {budget_text(budget)}" if budget > 0.0 else ""
    count = rows["contenders"].iloc[0]
    if not 0 < number <= count:
        allowed = f"allowed: 1 to {count}, or the beginning of an id"
        raise ArgumentError(f"no number {number} in the ranking of {label}{within}; {allowed}")
    chosen = rows.iloc[[number - 1]]
    doubt = ", marked as unreliable" if doubtful(chosen).item() else ""
    sentence = f"number {number} of {count}: {label}{within}{doubt}"
    return by_id(summary, chosen["case_id"].item()), sentence


def _no_place(ranking: Ranking, label: str, summary: DataFrame) -> str:
    """Why a scene has no numbered places, and the id to use instead."""
    limit = f" up to {budget_text(max(ranking.budgets_g))}" if ranking.budgets_g else ""
    why = f"no design{limit} is ranked{f' in {label}' if label else ''}"
    if (instead := ranking.instead(label)) is None:
        return f"{why}; without CASE, show lists all ids"
    word, row = instead
    return f"{why}; allowed: an id, such as that of the {word} design: {named_case(row, summary)}"


def _scene(labels: list[str], query: str | None, usual: str) -> str:
    """The label of a scene: the usual one, or the one with this number or with these words."""
    if query is None:
        return usual or labels[0]
    if query.isdecimal() and 0 < int(query) <= len(labels):
        return labels[int(query) - 1]
    matches = [label for label in labels if query.lower() in label.lower()]
    if len(matches) == 1 or query in matches:
        return query if query in matches else matches[0]
    choices = "; ".join(f"{k}: {label}" for k, label in enumerate(labels, 1))
    why = f"in {len(matches)} scenes" if matches else "in no scene"
    raise ArgumentError(f'--scene "{query}": {why}; allowed: a number or words of {choices}')
