"""What a search compares: the value of each design in the sorted column of a ranking."""

from collections.abc import Mapping
from typing import Any, NamedTuple

from pandas import DataFrame

from sweep.ranking.merit import RankError
from sweep.ranking.rank import ranked
from sweep.result import less_is_better


class Worths(NamedTuple):
    """Designs by their value in a column.

    values: id -> value, the best first. doubtful: number of further designs whose result is marked
    as beyond the model or as crossed, which are worth nothing.
    """

    column: str
    values: dict[str, float]
    doubtful: int

    @property
    def sign(self) -> float:
        """1 if less is better, -1 if more is."""
        return 1.0 if less_is_better(self.column) else -1.0


def worths(summary: DataFrame, question: Mapping[str, Any]) -> Worths:
    """The worths of the designs of one scene; question: arguments of `rank`.

    Designs without a place in the ranking have no value: failed ones, those above the budget.
    """
    ranking = ranked(summary, **{**question, "top": None})
    table = ranking.table
    if question.get("allowed_force") and ranking.unranked:
        what = f"{ranking.unranked} rows are of a run without loading.allowed_forces = "
        raise RankError(f"{what}{question['allowed_force']}; allowed: another --out")
    column = ranking.by if table.empty else str(table["ranked_by"].iloc[0])
    marked = table["beyond_model"].astype(bool) | table["crossed"].astype(bool)
    sound = table[~marked]
    values = dict(zip(sound["case_id"], sound[column].astype(float), strict=True))
    return Worths(column, values, int(marked.sum()))
