"""Spread of the best designs with the uncertain numbers: how far their values move, and whether
their order changes.

At a corner one uncertain number is at an end of its range, for all designs at once. A design whose
material has no range for this number keeps its value.
"""

from collections.abc import Iterable, Iterator, Mapping, Sequence
from typing import Any, NamedTuple

import numpy as np
from pandas import DataFrame, Series

from sweep.columns import less_is_better
from sweep.ranking.budget import greatest_mass
from sweep.ranking.merit import merits
from sweep.ranking.question import Question
from sweep.ranking.ranking import Ranking
from sweep.ranking.requirements import measured, misses
from sweep.ranking.unfinished import loaded

ROUND_OFF = 1e-9
AS_GIVEN = "as given"  # the corner at which no number is at an end of its range
FINE = "fine mesh"  # the corner with more elements
MISSED = "missed "  # prefix of a requirement: the column that says whether it is missed
TABLE = [
    *("budget_g", "scene", "place", "case_id", "ranked_by", "value"),
    *("lowest", "lowest_at", "highest", "highest_at"),
    *("best_place", "worst_place", "changes_order", "failed"),
]
Corners = Mapping[str, Sequence[tuple[str, str]]]
"""Name and case id of the corners of each design, by the id of the design."""


class Spread(NamedTuple):
    """The best designs of one scene and budget, with their values at the corners.

    rows (k, ...): their rows of the ranking, best first. column: the ranked column. at_corners (k,
    n): values by name of the corner, the first of which is `AS_GIVEN`; NaN where it failed. places
    (k, n): among these designs. failed: number of missing values. masses (k, n): g, as budgets
    count them. missed: place of a design, corner, and the limit exceeded there: "budget", or a
    requirement.
    """

    rows: DataFrame
    column: str
    at_corners: DataFrame
    places: DataFrame
    failed: int
    masses: DataFrame
    missed: tuple[tuple[int, str, str], ...]

    @property
    def sign(self) -> float:
        """1 if more of the column is better, -1 if less is better."""
        return -1.0 if less_is_better(self.column) else 1.0

    @property
    def swaps(self) -> list[str]:
        """Corners that change the order of the designs."""
        usual = self.rows[self.column].to_numpy()
        return [
            str(name)
            for name, values in self.at_corners.items()
            if _overtakes(self.sign * usual, self.sign * values.to_numpy())
        ]

    @property
    def worst(self) -> Series:
        """The worst value of each design at its corners, `AS_GIVEN` left out; NaN if one failed."""
        others = self.at_corners.drop(columns=AS_GIVEN)
        worst = others.min(axis=1) if self.sign > 0.0 else others.max(axis=1)
        return worst.where(others.notna().all(axis=1))

    def first(self, corner: str) -> int:
        """The row that is best at a corner."""
        return int(np.nanargmin(self.places[corner].to_numpy()))


def _overtakes(before: Any, after: Any) -> bool:
    """True if a value that was greater than another one is less now; missing ones are left out."""
    slack = ROUND_OFF * np.nanmax(np.abs(after), initial=0.0)
    greater = before[:, None] > before[None, :] + ROUND_OFF * np.abs(before).max()
    return bool((greater & (after[:, None] < after[None, :] - slack)).any())


def spreads(
    ranking: Ranking, summary: DataFrame, corners: Corners, question: Question
) -> list[Spread]:
    """The spread of each scene and budget of a ranking.

    summary: rows of the corners. question: of the ranking.
    """
    finished = loaded(summary)
    compared, names = merits(finished, question)
    missed = misses(compared, measured(compared, names, question.per), ranking.required) != 0.0
    compared = compared.join(missed.add_prefix(MISSED))
    table = ranking.table[ranking.table["case_id"].isin(corners)]
    groups = table.groupby(["budget_g", "scene"], dropna=False, sort=False)
    by_id = compared.set_index("case_id")
    return [_spread(rows, corners, by_id, names.mass) for _, rows in groups]


def spread_table(spreads: Iterable[Spread]) -> DataFrame:
    """A row for each design, in the order of their places.

    value: of the column `ranked_by`. lowest, highest: at the corners `lowest_at`, `highest_at`.
    best_place, worst_place: among these designs, over all corners. changes_order: the corners at
    which these designs change places. failed: number of corners without a value.
    """
    return DataFrame([row for spread in spreads for row in _table_rows(spread)], columns=TABLE)


def _table_rows(spread: Spread) -> Iterator[dict[str, Any]]:
    order = ", ".join(spread.swaps)
    for k, (_, design) in enumerate(spread.rows.iterrows()):
        values, places = spread.at_corners.iloc[k], spread.places.iloc[k]
        low, high = ends(values)
        row = {name: design[name] for name in TABLE if name in design.index}
        yield row | {
            "value": design[spread.column],
            "lowest": values[low],
            "lowest_at": low,
            "highest": values[high],
            "highest_at": high,
            "best_place": int(places.min()),
            "worst_place": int(places.max()),
            "changes_order": order,
            "failed": int(values.isna().sum()),
        }


def _spread(rows: DataFrame, corners: Corners, compared: DataFrame, mass: str) -> Spread:
    column = str(rows["ranked_by"].iloc[0])
    ids = [str(case_id) for case_id in rows["case_id"]]
    names = dict.fromkeys(name for design in ids for name, _ in corners[design])
    values, masses = (
        DataFrame(dict.fromkeys((AS_GIVEN, *names), rows[one].to_numpy(dtype=float)), index=ids)
        for one in (column, mass)
    )
    missed: list[tuple[int, str, str]] = []
    budget = rows["budget_g"].iloc[0]
    for design, place in zip(ids, rows["place"], strict=True):
        for name, case_id in corners[design]:
            row = compared.loc[case_id] if case_id in compared.index else None
            values.loc[design, name] = np.nan if row is None else row[column]
            masses.loc[design, name] = np.nan if row is None else row[mass]
            if row is not None:
                missed += [(int(place), name, what) for what in _not_kept(row, mass, budget)]
    places = values.rank(ascending=less_is_better(column), method="min")
    failed = int(values.isna().to_numpy().sum())
    return Spread(rows, column, values, places, failed, masses, tuple(missed))


def _not_kept(row: Series, mass: str, budget: float) -> list[str]:
    """The limits that a row exceeds; budget: g, NaN without one."""
    kept = [key.removeprefix(MISSED) for key in row.index if key.startswith(MISSED) and row[key]]
    return (["budget"] if row[mass] > greatest_mass(budget) else []) + kept


def ends(values: Series) -> tuple[str, str]:
    """The corners with the least and the greatest value; there must be one."""
    return str(values.idxmin()), str(values.idxmax())
