"""The answer of `rank.ranked`, a `Ranking`: the table, and data that are not in the table."""

from collections.abc import Mapping
from dataclasses import dataclass

from pandas import DataFrame, concat

from sweep.numbers import counted
from sweep.ranking.budget import greatest_mass
from sweep.ranking.requirements import Outcome
from sweep.ranking.unfinished import PLACES


@dataclass(frozen=True, eq=False, repr=False)
class Ranking:
    """The best designs of each loading scene.

    table: a row for each design that has a place, best first; `rank` describes its columns.
    unfinished: a row for each case that stopped and could have had a place in the table, for each
        scene and budget; it has the columns of the table except those that describe a place, and
        `PLACES` of `sweep.ranking.unfinished`.
    mass, energy, per_gram: names of the compared columns: mass (g) and energy (J) of the panel, or
        of the specimen if there is no panel, and energy per gram (J/g).
    until: up to which point energy is counted, in words.
    limited: True if energy is counted up to an allowed force.
    by: name of the column that sorts crushed designs; without crushes, designs of the first scene.
    cases, failed: number of cases, and of cases that stopped before the end of their loading.
    unloaded: number of cases that stopped after their loading.
    unranked: number of loaded cases without a value in the sorting column of their scene.
    without_bar: number of cases with that value but without its error bar, if others have one.
    pointed: number of loaded cases with solid joints in which some walls end in points.
    versions: number of loaded cases of each version of the model, the oldest first.
    budgets_g: the budgets (g), each once.
    lightest: the row of the lightest design of each scene, the first by its id among equals.
    lost: number of cases of each scene in which no case completed its loading.
    narrow: patterns of few cells across in scenes that mix patterns (`narrow_patterns`).
    panel: the two lengths (m) of the panel in the question; none without one.
    per: to which the allowed force and the requirements apply, "specimen" or "panel".
    required: the limit (SI) of each requirement.
    outcomes: how the designs of each scene meet them, within each budget; empty if none are given.
    """

    table: DataFrame
    unfinished: DataFrame
    mass: str
    energy: str
    per_gram: str
    until: str
    limited: bool
    by: str
    cases: int
    failed: int
    unloaded: int
    unranked: int
    without_bar: int
    pointed: int
    versions: Mapping[int, int]
    budgets_g: tuple[float, ...]
    lightest: Mapping[str, DataFrame]
    lost: Mapping[str, int]
    narrow: Mapping[str, tuple[str, ...]]
    panel: tuple[float, ...]
    per: str
    required: Mapping[str, float]
    outcomes: Mapping[str, tuple[Outcome, ...]]

    def __repr__(self) -> str:
        scenes = counted(len(self.scenes), "scene")
        return f"<Ranking by {self.by}: {counted(len(self.table), 'place')} in {scenes}>"

    @property
    def designs(self) -> DataFrame:
        """The ranked designs; where none has a place, the lightest one of each scene."""
        return self.table if len(self.table) else concat([self.table, *self.lightest.values()])

    @property
    def with_unfinished(self) -> DataFrame:
        """The table, and below it the unfinished cases, which have no place."""
        if self.unfinished.empty:
            return self.table
        whole = concat([self.table, self.unfinished], ignore_index=True)
        return whole.astype(dict.fromkeys(["place", *PLACES], "Int64"))

    @property
    def lightest_g(self) -> dict[str, float]:
        """The least mass (g) of each scene."""
        return {scene: float(row[self.mass].item()) for scene, row in self.lightest.items()}

    @property
    def is_above_budgets(self) -> bool:
        """Whether every design of every scene is heavier than all budgets."""
        return bool(self.budgets_g) and all(
            mass > greatest_mass(max(self.budgets_g)) for mass in self.lightest_g.values()
        )

    @property
    def scenes(self) -> list[str]:
        """The scenes in their order, or starting with the lightest design if all designs are too
        heavy.

        The same design may weigh more by round-off in another scene: the first one then counts.
        """
        if not self.is_above_budgets:
            return list(self.lightest_g)
        return sorted(self.lightest_g, key=lambda scene: round(self.lightest_g[scene], 9))

    def instead(self, scene: str) -> tuple[str, DataFrame] | None:
        """The design of a scene that comes nearest to the question: a word for it, and its row.

        It is the design nearest to the requirements within the first budget that has one; or the
        lightest design, if all are heavier than the budgets; else None.
        """
        near = [one.nearest for one in self.outcomes.get(scene, ()) if len(one.nearest)]
        if near:
            return "nearest", near[0]
        widest = max(self.budgets_g, default=float("inf"))
        heavier = scene in self.lightest_g and self.lightest_g[scene] > greatest_mass(widest)
        return ("lightest", self.lightest[scene]) if heavier else None
