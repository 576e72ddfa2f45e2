"""A ranking: its table, and what the table alone does not tell."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Mapping

    from pandas import DataFrame


@dataclass(frozen=True, eq=False)
class Ranking:
    """The best designs of each loading scene.

    table : a row for each design that has a place, best first; `rank` describes its columns.
    mass, energy, per_gram : names of the columns that are compared: mass (g) and energy (J) of the
        panel, or of the specimen without one, and energy per gram (J/g).
    until : when energy ceases to count, in words.
    limited : True where energy ceases to count at an allowed force.
    by : name of the column that sorts the crushed designs, or those of the first scene without any.
    cases, failed : how many were simulated, and how many of them did not converge.
    unranked : how many converged, but have no value in the column of their scene.
    without_bar : how many have that value but no error bar of it, where others have one.
    versions : of the model, how many that converged are of each, the oldest first.
    budgets_g : greatest masses (g) that were asked for, each once.
    lightest_g : the smallest mass (g) of each scene.
    """

    table: DataFrame
    mass: str
    energy: str
    per_gram: str
    until: str
    limited: bool
    by: str
    cases: int
    failed: int
    unranked: int
    without_bar: int
    versions: Mapping[int, int]
    budgets_g: tuple[float, ...]
    lightest_g: Mapping[str, float]
