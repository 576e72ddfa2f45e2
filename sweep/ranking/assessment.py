"""The values that a search compares: each design in the sorted column of a ranking, and how far it
is from fulfilling the requirements.
"""

from collections.abc import Iterable
from typing import Any, NamedTuple

from pandas import DataFrame

from sweep.columns import describe_column, less_is_better
from sweep.ranking.merit import Compared, doubtful
from sweep.ranking.pareto import pareto
from sweep.ranking.question import Question, RankError
from sweep.ranking.rank import answer
from sweep.ranking.requirements import check, limits, measured, misses, nearest_first
from sweep.ranking.scenes import ASSUMPTIONS, OF_DESIGN

ALIKE = 0.05  # relative difference in both columns up to which a front lists one of two designs


class Assessment(NamedTuple):
    """Designs by their value in a column.

    by_id: values by id of the designs that fulfil all requirements, the best first. missed:
    greatest miss by id of the other designs, the nearest first (`requirements.nearest_first`).
    doubtful: number of further designs whose result is marked as beyond the model or as crossed,
    which have no value.
    """

    column: str
    by_id: dict[str, float]
    missed: dict[str, float]
    doubtful: int

    @property
    def sign(self) -> float:
        """1 if less is better, -1 if more is better."""
        return 1.0 if less_is_better(self.column) else -1.0


def assess(summary: DataFrame, question: Question) -> Assessment:
    """The values and misses of designs, whatever their scenes: with a given stroke, designs of
    other heights are crushed to another strain.

    Designs without a place in the ranking have no value: failed ones, those above the budget.
    """
    ranking = answer(summary, question._replace(top=None, require=None))
    table, required = ranking.table, limits(question.require)
    of_specimen = question.per != "panel"
    if question.allowed_force and of_specimen and ranking.unranked:
        what = f"{ranking.unranked} rows come from a run without loading.allowed_forces = "
        raise RankError(f"{what}{question.allowed_force}; allowed: another --out")
    column = ranking.by if table.empty else str(table["ranked_by"].iloc[0])
    check(table, required)
    sound = _sound(table)
    names = Compared(ranking.mass, ranking.energy, ranking.per_gram, ranking.until)
    shares = misses(sound, measured(sound, names, ranking.per), required)
    missed = nearest_first(sound, ranking.mass, shares)
    fulfil, others = sound[missed[sound.index] == 0.0], missed[missed > 0.0]
    fulfil = fulfil.sort_values(column, ascending=less_is_better(column), kind="stable")
    return Assessment(
        column,
        dict(zip(fulfil["case_id"], fulfil[column].astype(float), strict=True)),
        {str(sound.loc[at, "case_id"]): float(value) for at, value in others.items()},
        len(table) - len(sound),
    )


def front(summary: DataFrame, question: Question, other: str) -> DataFrame:
    """The rows of a ranking that no row exceeds both in its column and in another one, best first
    in the other one. Rows marked as doubtful are left out.
    """
    table = _sound(answer(summary, question._replace(top=None)).table).dropna(subset=other)
    if table.empty:
        return table
    column = str(table["ranked_by"].iloc[0])
    aims = [table[name] if less_is_better(name) else -table[name] for name in (other, column)]
    chosen = table[pareto(aims[0], -aims[1])]
    return chosen.sort_values(other, ascending=less_is_better(other), kind="stable")


def thinned(rows: DataFrame, columns: Iterable[str]) -> DataFrame:
    """A front without designs that hardly differ from a better one.

    Starting from the best design of the ranking, a row is dropped if it differs from the last kept
    row by less than `ALIKE` in each of the columns.
    """
    names, kept = list(columns), list[Any]()
    for at in reversed(rows.index):
        values = rows.loc[at, names].astype(float)
        last = rows.loc[kept[-1], names].astype(float) if kept else None
        if last is None or ((values - last).abs() > ALIKE * last.abs()).any():
            kept.append(at)
    return rows.loc[kept[::-1]]


def check_searched(keys: Iterable[str]) -> None:
    """Refuse keys of the test, not of the design: different scenes cannot be compared."""
    chosen = [key for key in keys if key not in OF_DESIGN]
    if wrong := [key for key in chosen if key.startswith(ASSUMPTIONS)]:
        why = "belongs to the test, not to the design: each value is a scene of its own"
        raise RankError(f"[search] {wrong[0]}: {why}; allowed: lattice.cells_x and the like")


def check_column(name: str) -> None:
    """Refuse a column in which neither more nor less is better."""
    if describe_column(name).better is None:
        wrong = f'"{name}" is no column of which more or less makes a design better'
        raise RankError(f"{wrong}; allowed: mass_g, peak_force_until_packed_N and the like")


def _sound(table: DataFrame) -> DataFrame:
    """The rows that are marked neither as beyond the model nor as crossed."""
    return table[~doubtful(table)]
