"""Cases that stopped: which of them are ranked nevertheless, and which place others could have had.

A case that completed its loading (column `loaded`) is ranked by values that the loading determines.
For any other case, the final value of the sorted column lies between two ends, one of which may be
infinite:

- energies, forces and strains only rise as a loading goes on: not below the value so far;
- energy up to an allowed force F: at most the energy so far + F x the remaining stroke, and just
  the energy so far if F was exceeded;
- a mass does not change; all other columns may take any value, as may all columns of an impact that
  its steps do not resolve.

The better end gives the best place that the case could have had among those ranked, the worse end
the place that it has at least; doubtful designs follow all others. A requirement that it already
misses, or its mass, excludes it.
"""

import re
from collections.abc import Iterable, Mapping

import numpy as np
from pandas import DataFrame, Series

from sweep.array_types import Floats, Ints
from sweep.columns import less_is_better
from sweep.loading_modes import applies_to, has
from sweep.ranking.budget import within_budget
from sweep.ranking.merit import Compared, doubtful
from sweep.ranking.question import Question, in_si
from sweep.ranking.requirement_table import MEASURES
from sweep.ranking.requirements import measured, misses
from sweep.result import Status

RISING = re.compile(
    r"(absorbed_energy|specific_absorption|panel_energy|panel_force|peak_|passed_on|counted_stroke)"
    r"|efficiency$"
)
"""Beginnings of columns whose values only rise as a loading goes on."""
FIXED = re.compile(r"(.+_)?mass_g$|relative_density$")
PLACES = ["best_place", "least_place"]
"""Columns of `could_place`: the best place that a case could have had, and the place it has at
least, NaN if nothing is certain.
"""
FIRST = ["budget_g", *PLACES, "case_id", "ranked_by"]
"""The first columns of `could_place`."""


def loaded(summary: DataFrame) -> DataFrame:
    """The rows whose loading was completed, which are ranked."""
    return summary[summary["loaded"] == 1]


def ended_early(rows: DataFrame, by: str) -> Series:
    """True for cases that stopped before they had a reliable value to sort by."""
    return interrupted(rows) | (unloaded(rows) & rows[by].isna())


def interrupted(rows: DataFrame) -> Series:
    """True for cases whose loading was not completed, except those that lost their lattice."""
    return (rows["loaded"] != 1) & (rows["status"] != Status.SLIPPED)


def unloaded(rows: DataFrame) -> Series:
    """True for rows that are ranked although their case stopped after the loading."""
    return (rows["loaded"] == 1) & (rows["status"] != Status.CONVERGED)


def could_place(  # noqa: PLR0913  the ranking, the cases, the question
    ranked: DataFrame,
    every: DataFrame,
    by: str,
    budgets_g: Iterable[float],
    names: Compared,
    question: Question,
    required: Mapping[str, float],
) -> list[DataFrame]:
    """Which of `every` case of a scene stopped and could have had a place among the first
    `question.top` within each budget, the best first, with the columns `PLACES`.

    ranked: rows of the scene that have a place, whatever their mass. required: limits in SI.
    """
    stopped = every[ended_early(every, by)]
    bounds = ends(stopped, by, names, question)
    missed, certain = _judged(stopped, names, question, required)
    better, worse = bounds if less_is_better(by) else bounds[::-1]
    doubt, certain = doubtful(stopped), certain & np.isfinite(worse)
    candidates, mass = ranked.dropna(subset=by), stopped[names.mass]
    parts = []
    for budget_g in budgets_g:
        placed = candidates[within_budget(candidates[names.mass], budget_g)]
        best, least = (_place(end, doubt, placed, by) for end in (better, worse))
        fits = within_budget(mass, budget_g) | mass.isna()
        first = {
            "budget_g": budget_g if np.isfinite(budget_g) else np.nan,
            "best_place": best,
            "least_place": least.where(certain),
            "case_id": stopped["case_id"],
            "ranked_by": by,
        }
        others = stopped.drop(columns=list(first), errors="ignore")  # of an earlier ranking
        rows = DataFrame(first, index=stopped.index).join(others)
        rows = rows[fits & ~missed & (best <= (question.top or np.inf))]
        parts.append(rows.sort_values([*PLACES, "case_id"]))
    return parts


def ends(rows: DataFrame, by: str, names: Compared, question: Question) -> tuple[Series, Series]:
    """The least and the greatest final value that each case could have had in the column `by`."""
    value = rows[by].astype(float)
    low, high = (Series(end, rows.index) for end in (-np.inf, np.inf))
    if FIXED.match(by):
        return value.fillna(-np.inf), value.fillna(np.inf)
    if RISING.match(by):
        value = value.where(rows["status"] != Status.UNRESOLVED)
        low = value.fillna(-np.inf)
        if question.allowed_force is not None and by in (names.energy, names.per_gram):
            high = (value + _further(rows, by, names, question)).fillna(np.inf)
    return low, high


def _further(rows: DataFrame, by: str, names: Compared, question: Question) -> Series:
    """Upper bound of the energy that the rest of a crush adds up to an allowed force, in units of
    `by`: 0 once the force was exceeded; infinite if it is no crush.
    """
    count = rows.get("panel_specimens", Series(1.0, rows.index))
    force = in_si(question.allowed_force or 0.0, "N")
    force = force / count if question.per == "panel" else Series(force, rows.index)
    most = (force * stroke_left(rows)).where(~(rows["peak_force_N"] > force), 0.0)
    if by == names.per_gram:
        most = most / (rows[names.mass] / (count if names.mass == "panel_mass_g" else 1.0))
    else:
        most = most * (count if by == "panel_energy_J" else 1.0)
    return most.where(has(rows, "driven"), np.inf)


def stroke_left(rows: DataFrame) -> Series:
    """Remaining stroke (m) of a crush at the strain that was reached."""
    return (rows["stroke_m"] - rows["peak_strain"] * rows["height_m"]).clip(lower=0.0)


def _place(value: Series, doubt: Series, placed: DataFrame, by: str) -> Series:
    """1 + the number of ranked rows that are better; a doubtful row counts only for doubtful
    ones.
    """
    sign = -1.0 if less_is_better(by) else 1.0
    own, their = (sign * np.asarray(values, float) for values in (value, placed[by]))
    yours = doubtful(placed).to_numpy()

    def better(values: Floats) -> Ints:
        return len(values) - np.searchsorted(np.sort(values), own, side="right")

    behind = (~yours).sum() + better(their[yours])
    ahead = np.where(doubt.to_numpy(), behind, better(their[~yours]))
    return Series(1 + ahead, value.index, dtype=int)


def _judged(
    rows: DataFrame,
    names: Compared,
    question: Question,
    required: Mapping[str, float],
) -> tuple[Series, Series]:
    """Which cases already miss a requirement, and which can no longer miss any.

    Values that are limited from above only rise. A required energy is out of reach only if nothing
    is added to it.
    """
    missed = Series(False, rows.index)
    if rows.empty:
        return missed, missed
    mode = rows["loading_mode"].iloc[0]
    limits = {name: limit for name, limit in required.items() if mode in applies_to(name)}
    shares = misses(rows, measured(rows, names, question.per), limits) > 0.0
    low, high = ends(rows, names.energy, names, question)
    settled = low == high
    resolved = rows["status"] != Status.UNRESOLVED
    for name in limits:
        sure = settled if MEASURES[name].least else resolved | (name == "max_mass")
        missed |= shares[name] & sure
    return missed, Series(not set(limits) - {"max_mass"}, rows.index)
