"""Designs in charts: their style, their merit, and the winners of budgets.

The style is the same in every panel: size = wall thickness; open and dashed = doubtful. With
several patterns the colour shows whichever of pattern, material and direction has most values, the
marker the next of them, or the same one if the others do not vary. With one pattern the colour
shows the cells, and the direction if it varies, and the marker the material.
"""

from collections.abc import Iterator
from itertools import cycle
from typing import Any, NamedTuple

import numpy as np
from pandas import DataFrame, Series, concat

from sweep.columns import error_column, less_is_better
from sweep.design.slicer.patterns import family_of
from sweep.loading_modes import mode_of
from sweep.numbers import budget_text, energy_text, error_share, in_unit, text_in, three_digits
from sweep.ranking.budget import greatest_mass
from sweep.ranking.merit import doubtful
from sweep.ranking.places import places_by
from sweep.ranking.ranking import Ranking
from sweep.report.tables.design_text import WAYS, design_labels

RAMP = ((68, 1, 84), (59, 82, 139), (33, 145, 140), (94, 201, 98))  # viridis: few to many cells
WORDS = {"lattice_kind": "pattern", "material": "material", "direction": "pressed"}
HUES = ("#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9", "#7a5195", "#5a5a5a")
"""Colours that a colour-blind reader can distinguish (M. Okabe and K. Ito, 2008), and two more."""
SIGNS = "o^sDvP*Xh<>pd"
OF_FAMILY = {"circle": "o", "triangle": "^", "square": "s", "diamond": "D", "hex": "h"}
OF_FAMILY |= {"kagome": "*"}
SIZES = 5  # greatest number of wall thicknesses in a legend
AREAS = (15.0, 75.0)  # points^2: marker of the thinnest and of the thickest wall
THIN = 0.2  # points of a line / diameter of the marker of a design
LINE = {"ls": "-", "marker": ""}
PLAIN = {"ls": "", "marker": "o", "ms": 6.0, "color": "#8a8a8a"}


class Looks(NamedTuple):
    """The style of all designs of a ranking.

    colors: values of the columns `tint` -> colour. signs: values of the column `sign` -> marker.
    areas: wall thickness (m) -> area of a marker (points^2). doubtful: True if some designs are
    doubtful.
    """

    tint: list[str]
    colors: dict[tuple[Any, ...], str]
    sign: str
    signs: dict[str, str]
    areas: dict[float, float]
    doubtful: bool

    def of(self, points: DataFrame) -> dict[str, Any]:
        """Keyword arguments of a scatter plot for designs with one marker."""
        return {
            "c": [self.colors[values] for values in _rows(points, self.tint)],
            "s": points["wall_thickness_m"].map(self.areas).to_numpy(),
            "marker": self.signs[points[self.sign].iloc[0]],
        }

    def width(self, thickness: float) -> float:
        """Width (points) of a line for walls of a thickness (m)."""
        return THIN * self.areas[thickness] ** 0.5

    def legend(
        self, walls: bool = True, barred: bool = False, lines: bool = False
    ) -> list[dict[str, Any]]:
        """Keyword arguments of an empty line for each entry of a legend; groups that vary have a
        heading.

        walls: with wall thicknesses; barred: with an entry for error bars; lines: designs are lines
        whose width shows their walls.
        """
        noun = WORDS[self.sign]
        signs: dict[str, dict[str, Any]] = {n: {"marker": s} for n, s in self.signs.items()}
        tints: dict[str, dict[str, dict[str, Any]]] = {}
        if self.tint == [self.sign]:
            signs = {name: look | {"color": self.colors[name,]} for name, look in signs.items()}
        else:
            heading, words = _tint_words(self.tint, list(self.colors))
            colors = zip(words, self.colors.values(), strict=True)
            tints = {heading: {word: {"color": color} for word, color in colors}}
        groups: dict[str, dict[str, dict[str, Any]]] = {
            **tints,
            noun: {WAYS.get(name, name): look for name, look in signs.items()},
            "wall": {
                text_in(t, "mm", 3): LINE | {"lw": self.width(t)} if lines else {"ms": area**0.5}
                for t, area in self.areas.items()
            },
        }
        groups["wall"] = _some(groups["wall"], SIZES)
        beyond = {**PLAIN, "mfc": "white", "ls": "--", "label": "unreliable"}
        shown = [name for name in groups if len(groups[name]) > 1 and (walls or name != "wall")]
        entries = [
            {**PLAIN, **look, "label": label}
            for name in shown
            for label, look in [(name, {"marker": ""}), *groups[name].items()]
        ]
        bar = {**PLAIN, "marker": "|", "ms": 12.0, "label": "± estimated error"}
        return entries + [bar] * barred + [beyond] * self.doubtful


def looks(designs: DataFrame) -> Looks:
    """The style of all designs of a ranking."""
    choices = {name: designs[name].nunique() for name in WORDS}
    varied = sorted((name for name in WORDS if choices[name] > 1), key=choices.__getitem__)[::-1]
    tint, sign = ["cells_x", "cells_y", *(["direction"] * (choices["direction"] > 1))], "material"
    if choices["lattice_kind"] > 1:
        tint, sign = [*varied[:1], *varied[2:]], [*varied, *varied][1]
    values = sorted(set(_rows(designs, tint)))
    walls = sorted(designs["wall_thickness_m"].unique())
    return Looks(
        tint,
        dict(zip(values, _colors(tint, len(values)), strict=True)),
        sign,
        _signs(sorted(designs[sign].unique())),
        dict(zip(walls, np.linspace(*AREAS, len(walls)), strict=True)),
        bool(doubtful(designs).any()),
    )


def _rows(designs: DataFrame, names: list[str]) -> Iterator[tuple[Any, ...]]:
    """The values of the named columns, design by design."""
    return zip(*(designs[name] for name in names), strict=True)


def _signs(names: list[str]) -> dict[str, str]:
    """A marker for each name, similar to the pattern of this name if possible."""
    families = {name: family_of(name) for name in names}
    alike = {name: OF_FAMILY[kind] for name, kind in families.items() if kind in OF_FAMILY}
    spare = cycle(sign for sign in SIGNS if sign not in alike.values())
    return {name: alike.get(name) or next(spare) for name in names}


def _tint_words(tint: list[str], values: list[tuple[Any, ...]]) -> tuple[str, list[str]]:
    """Heading and entries of the legend of colours, with only the values that vary."""
    columns = dict(zip(tint, zip(*values, strict=True), strict=True))
    parts = {WORDS[name]: [*columns[name]] for name in tint if name in WORDS}
    if "cells_x" in columns:
        pairs = zip(columns["cells_x"], columns["cells_y"], strict=True)
        parts = {"cells": [f"{x} x {y}" for x, y in pairs]} | parts
    shown = {name: words for name, words in parts.items() if len({*words}) > 1} or parts
    rows = zip(*shown.values(), strict=True)
    return ", ".join(shown), [", ".join(WAYS.get(word, word) for word in row) for row in rows]


def _some(entries: dict[str, Any], count: int) -> dict[str, Any]:
    """At most ``count`` entries, evenly spaced from the first to the last."""
    kept = np.linspace(0, len(entries) - 1, min(count, len(entries))).round()
    return {name: entries[name] for k, name in enumerate(entries) if k in kept}


def merits(rows: DataFrame, energy: str) -> Series:
    """The compared values of the designs of one scene: strain in %, force in N, or energy in J."""
    name, unit = _compared(rows, energy)
    return in_unit(rows[name], unit)


def merit_errors(rows: DataFrame, energy: str) -> Series:
    """The errors of `merits`; NaN if unknown."""
    name, unit = _compared(rows, energy)
    return in_unit(errors_of(rows, name), unit)


def errors_of(rows: DataFrame, name: str) -> Series:
    """The errors of a column; NaN if unknown."""
    errors = rows.get(error_column(name))
    return rows[name] * np.nan if errors is None else errors


def _compared(rows: DataFrame, energy: str) -> tuple[str, str]:
    """The compared column of the designs of one scene, and its unit in charts."""
    least = mode_of(rows).least
    return (least.column, least.unit) if least else (energy, "J")


def budget_winners(rows: DataFrame, ranking: Ranking) -> list[tuple[str, float, float]]:
    """Words, mass and merit of the best design of one scene within each budget.

    Without budgets, only for the first design. A doubtful design is never the best.
    """
    mass, energy = ranking.mass, ranking.energy
    front, (name, _) = rows[rows["pareto"]].sort_values(mass), _compared(rows, energy)
    winners = [
        (
            f"up to {budget_text(budget)}",
            front[front[mass] <= limit].tail(1),
            rows[rows[mass] <= limit],
        )
        for budget in ranking.budgets_g
        for limit in [greatest_mass(budget)]
    ]
    if not winners:
        best = rows[(rows["place"] == 1) & ~doubtful(rows)].head(1)
        winners, name = [("best", best, rows)], rows["ranked_by"].iloc[0]
    return [
        (
            f"{limit}: {_words(won, others, ranking, name)}",
            won[mass].item(),
            merits(won, energy).item(),
        )
        for limit, won, others in winners
        if not won.empty and merits(won, energy).notna().item()
    ]


def _words(won: DataFrame, among: DataFrame, ranking: Ranking, name: str) -> str:
    """A design with its merit and error, such as "cells 3 x 3, wall 0.8 mm, 13.4 J".

    name: the column in which the design is the best `among` others; its value comes last.
    """
    (design,), energy = design_labels(won, ranking.table), ranking.energy
    merit, value = merits(won, energy).item(), three_digits(won[name].item())
    mode = mode_of(won)
    words = mode.least.merit.format(three_digits(merit)) if mode.least else energy_text(merit)
    words += _of_panel(won) if mode.struck else ""
    if name == ranking.per_gram:
        words += f", {value} J/g"
    elif name != _compared(won, energy)[0]:
        words += f", {name} {value}"
    return f"{design}, {words}{_ties(among, won, name)}"


def _of_panel(won: DataFrame) -> str:
    """The force of a panel beside the force of a specimen; "" without a panel."""
    if "panel_force_N" not in won:
        return ""
    return f", {three_digits(won['panel_force_N'].item())} N on the panel"


def _ties(rows: DataFrame, won: DataFrame, name: str) -> str:
    """The error of the best design of a scene, and how many designs tie with it; "" if unknown."""
    error = errors_of(won, name).item()
    if not (np.isfinite(error) and won[name].item()):
        return ""
    others = rows.drop(index=won.index).sort_values(name, ascending=less_is_better(name))
    ordered = concat([won, others])
    count = int((places_by(ordered, name) == 1).sum())
    share = f" ± {error_share(error / abs(won[name].item()))} %"
    return f"{share}, a tie of {count}" if count > 1 else share


def _colors(tint: list[str], count: int) -> list[str]:
    """Distinct colours for words, if there are as few; from dark to light for numbers and for
    many.
    """
    return list(HUES[:count]) if tint[0] in WORDS and count <= len(HUES) else _ramp(count)


def faded(color: str, share: float) -> str:
    """A colour mixed with white, keeping a ``share`` of itself."""
    channels = (int(color[at : at + 2], 16) for at in (1, 3, 5))
    return "#" + "".join(f"{round(share * c + (1.0 - share) * 255.0):02x}" for c in channels)


def _ramp(count: int) -> list[str]:
    """Evenly spaced colours from dark to light."""
    at = np.linspace(0.0, len(RAMP) - 1.0, count)
    channels = [np.interp(at, range(len(RAMP)), channel) for channel in zip(*RAMP, strict=True)]
    return [
        "#" + "".join(f"{round(c):02x}" for c in color) for color in zip(*channels, strict=True)
    ]
