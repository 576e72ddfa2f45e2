"""How designs stand in a chart: what they look like, what they are worth, which of them win.

Colour = cells, sign = material, size = wall thickness, open and dashed = not to be trusted: the
same in every panel.
"""

from __future__ import annotations

from itertools import cycle
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
from pandas import concat

from sweep.numbers import energy_text, tenths, three_digits
from sweep.ranking.merit import LEAST
from sweep.ranking.rank import LESS_IS_BETTER, shared_places
from sweep.result import error_column
from sweep.report.sheets import design_labels

if TYPE_CHECKING:
    from pandas import DataFrame, Series

RAMP = ((68, 1, 84), (59, 82, 139), (33, 145, 140), (94, 201, 98))  # of viridis: few to many cells
SIGNS = "o^sDvP"
AREAS = (15.0, 75.0)  # of the thinnest and the thickest wall, points^2
PLAIN = {"ls": "", "marker": "o", "ms": 6.0, "color": "#8a8a8a"}


class Looks(NamedTuple):
    """Colours by cells (x, y), signs by material, areas by wall thickness (m).

    doubtful: some are not to be trusted.
    """

    colors: dict[tuple[int, int], str]
    signs: dict[str, str]
    areas: dict[float, float]
    doubtful: bool

    def of(self, points: DataFrame) -> dict[str, Any]:
        """Keywords of a scatter plot for designs of one material."""
        cells = zip(points["cells_x"], points["cells_y"], strict=True)
        return {
            "c": [self.colors[pair] for pair in cells],
            "s": points["wall_thickness_m"].map(self.areas).to_numpy(),
            "marker": self.signs[points["material"].iloc[0]],
        }

    def legend(self, walls: bool = True, barred: bool = False) -> list[dict[str, Any]]:
        """Keywords of an empty line for each entry: what varies under a heading each.

        barred: some have error bars.
        """
        groups = {
            "cells": {f"{x} x {y}": {"color": color} for (x, y), color in self.colors.items()},
            "material": {name: {"marker": sign} for name, sign in self.signs.items()},
            "wall": {f"{1e3 * t:.3g} mm": {"ms": area**0.5} for t, area in self.areas.items()},
        }
        beyond = {**PLAIN, "mfc": "white", "ls": "--", "label": "not to be trusted"}
        shown = [name for name in groups if len(groups[name]) > 1 and (walls or name != "wall")]
        entries = [
            {**PLAIN, **look, "label": label}
            for name in shown
            for label, look in [(name, {"marker": ""}), *groups[name].items()]
        ]
        bar = {**PLAIN, "marker": "|", "ms": 12.0, "label": "± estimated error"}
        return entries + [bar] * barred + [beyond] * self.doubtful


def looks(designs: DataFrame) -> Looks:
    """The looks of all designs of a ranking."""
    cells = sorted(set(zip(designs["cells_x"], designs["cells_y"], strict=True)))
    walls = sorted(designs["wall_thickness_m"].unique())
    return Looks(
        dict(zip(cells, _ramp(len(cells)), strict=True)),
        dict(zip(sorted(designs["material"].unique()), cycle(SIGNS), strict=False)),
        dict(zip(walls, np.linspace(*AREAS, len(walls)), strict=True)),
        bool(doubtful(designs).any()),
    )


def doubtful(designs: DataFrame) -> Series:
    """Which designs are not to be trusted: beyond the model, or with walls that cross."""
    return designs["beyond_model"] | designs["crossed"]


def merits(rows: DataFrame, energy: str) -> Series:
    """What the designs of one scene are compared by: sink in %, force in N, or energy in J."""
    name, scale = _compared(rows, energy)
    return scale * rows[name]


def merit_errors(rows: DataFrame, energy: str) -> Series:
    """The error bars of `merits`; NaN where none is known."""
    name, scale = _compared(rows, energy)
    return scale * errors_of(rows, name)


def errors_of(rows: DataFrame, name: str) -> Series:
    """The error bars of a column; NaN where none is known."""
    known = rows.get(error_column(name))
    return rows[name] * np.nan if known is None else known


def _compared(rows: DataFrame, energy: str) -> tuple[str, float]:
    """The column by which the designs of one scene are compared, and what it is shown times."""
    least = LEAST.get(rows["loading_mode"].iloc[0])
    return least or energy, 100.0 if least == "peak_strain" else 1.0


def until(ranking: DataFrame) -> str:
    """When energy ceases to count, on a line of its own, where a force was allowed."""
    return f"\n{ranking.attrs['until']}" if ranking.attrs["limited"] else ""


def budget_winners(rows: DataFrame, ranking: DataFrame) -> list[tuple[str, float, float]]:
    """Words, mass and merit of the best of one scene for each budget; without any, of the first."""
    mass, energy = ranking.attrs["mass"], ranking.attrs["energy"]
    front, (name, _) = rows[rows["pareto"]].sort_values(mass), _compared(rows, energy)
    winners = [
        (f"up to {budget:g} g", front[front[mass] <= budget].tail(1), rows[rows[mass] <= budget])
        for budget in ranking.attrs["budgets_g"]
    ]
    if not winners:
        best = rows[rows["place"] == 1].head(1)
        winners, name = [("best", best, rows)], best["ranked_by"].item()
    return [
        (
            f"{limit}: {_words(won, others, ranking, name)}",
            won[mass].item(),
            merits(won, energy).item(),
        )
        for limit, won, others in winners
        if not won.empty and merits(won, energy).notna().item()
    ]


def _words(won: DataFrame, among: DataFrame, ranking: DataFrame, name: str) -> str:
    """A design, what it is worth, and how sure that is, as "cells 3 x 3, wall 0.8 mm, 13.4 J".

    name: the column by which it has won `among` others; its value comes last.
    """
    (design,), energy = design_labels(won, ranking), ranking.attrs["energy"]
    merit, value = merits(won, energy).item(), three_digits(won[name].item())
    worths = {
        "force": f"sinks {three_digits(merit)} %",
        "impact": f"passes {three_digits(merit)} N on",
    }
    worth = worths.get(won["loading_mode"].item(), energy_text(merit))
    if name == ranking.attrs["per_gram"]:
        worth += f", {value} J/g"
    elif name != _compared(won, energy)[0]:
        worth += f", {name} {value}"
    beyond = ", beyond the model" if won["beyond_model"].item() else ""
    crossed = ", walls cross" if won["crossed"].item() else ""
    return f"{design}, {worth}{_ties(among, won, name)}{beyond}{crossed}"


def _ties(rows: DataFrame, won: DataFrame, name: str) -> str:
    """How sure the best of some designs of one scene is, where error bars tell."""
    error = errors_of(won, name).item()
    if not (np.isfinite(error) and won[name].item()):
        return ""
    others = rows.drop(index=won.index).sort_values(name, ascending=name in LESS_IS_BETTER)
    ordered = concat([won, others])
    count = int((shared_places(ordered[name], errors_of(ordered, name)) == 1).sum())
    share = f" ± {tenths(error / abs(won[name].item()))} %"
    return f"{share}, a tie of {count}" if count > 1 else share


def _ramp(count: int) -> list[str]:
    """Evenly spaced colours from dark to light."""
    at = np.linspace(0.0, len(RAMP) - 1.0, count)
    channels = [np.interp(at, range(len(RAMP)), channel) for channel in zip(*RAMP, strict=True)]
    return [
        "#" + "".join(f"{round(c):02x}" for c in color) for color in zip(*channels, strict=True)
    ]
