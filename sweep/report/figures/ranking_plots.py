"""Charts of a sweep: merit over mass (absorption.png, sink.png,
passed_on.png) and over the wall thickness (wall_thickness.png).
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from math import inf
from textwrap import TextWrapper
from typing import TYPE_CHECKING, Any

import numpy as np
from pandas import DataFrame, Series

from sweep.loading_modes import mode_of
from sweep.numbers import budget_text, in_unit
from sweep.ranking.budget import greatest_mass
from sweep.ranking.merit import doubtful
from sweep.ranking.ranking import Ranking
from sweep.report.figures.case_plots import GREY, GRID, legend, mark, plain, round_ticks
from sweep.report.figures.design_style import (
    WORDS,
    budget_winners,
    errors_of,
    faded,
    looks,
    merit_errors,
    merits,
)
from sweep.report.tables.requirement_notes import titled

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

TITLE, SMALL = 52, 62  # most letters in a line above a panel, and of small ones
WHITE = (1.0, 1.0, 1.0, 1.0)
FRONT = {"color": "black", "lw": 0.9, "label": "Pareto front; others pale"}
RING = {"ls": "", "marker": "o", "ms": 10.0, "mfc": "none", "mec": "black", "label": "best"}
HEAVY = {"ls": "", "marker": "o", "ms": 6.0, "color": GREY, "label": "above all budgets"}
COARSE: dict[str, Any] = {
    "ls": "",
    "marker": r"$\mathrm{i}$",
    "ms": 7.0,
    "mew": 0.0,  # an edge would hide the dot
    "color": "black",
    "label": "coarse steps",
}
PALE = 0.45  # share of its colour that a design off the Pareto front keeps
VARIANT = [
    "lattice_kind",
    "cells_x",
    "cells_y",
    "material",
    "direction",
]  # keys that are constant along a line of trends
SHAPED = "lattice.", "material."  # keys of a design
THICK = tuple(f"lattice.{key}" for key in ("wall_thickness", "mass", "line_width", "infill"))
"""Keys of a design that set the thickness of its walls."""
NARROW, MARGIN = 1.2, 0.1  # axis of mass: least ratio of its ends; margin at either end
BESIDE: dict[str, Any] = {
    "xytext": (6, 0), "textcoords": "offset points", "fontsize": "small", "va": "center",
}  # fmt: skip
ENDS = 0.1, 10.0  # shares of a value: limits of its error bar, since a log axis has no zero


def merit_over_mass(fig: Figure, ranking: Ranking) -> None:
    """Merit over mass, one panel per scene, with the winner of each budget named.

    ranking: all places (`top=None`), of one mode. Merit: absorbed energy, strain under a dead
    load, or force on the support under a striker, with its error bar. The stairs are the Pareto
    front, the best merit up to every mass; its designs are drawn on top, others pale, and grey if
    they are heavier than all budgets. The winner of a budget is the last design of the front within
    it.
    """
    designs, mass, energy = ranking.table, ranking.mass, ranking.energy
    noun = "panel" if mass == "panel_mass_g" else "part"
    look, most = looks(designs), greatest_mass(max(ranking.budgets_g, default=inf))
    for ax, rows in scene_axes(fig, designs.round({mass: 9})):  # without round-off
        merit, error = merits(rows, energy), merit_errors(rows, energy)
        least = mode_of(rows).least
        by_style = rows[::-1].groupby(["pareto", *WORDS])
        for _, points in by_style:  # the best are drawn last, on top
            style, share = look.of(points), 1.0 if points["pareto"].iloc[0] else PALE
            heavy = zip(style["c"], points[mass] > most, strict=True)
            style["c"] = [faded(GREY if above else color, share) for color, above in heavy]
            _dots(ax, points[mass], merit.loc[points.index], style, points)
        front = rows[rows["pareto"]].sort_values(mass)
        stairs: dict[str, Any] = {"color": "black", "lw": 0.9, "drawstyle": "steps-post"}
        _line(ax, front[mass], merit.loc[front.index], stairs, front)
        ax.set(xscale="log", yscale="log")
        ax.set_xlim(_span([*rows[mass], *ranking.budgets_g]))
        ax.margins(y=0.15)
        _error_bars(ax, rows[mass], merit, error)
        for budget in ranking.budgets_g:
            mark(ax, budget, budget_text(budget))
        words = [heading(titled(rows["scene"].iloc[0], ranking), SMALL)]
        for sentence, x, y in budget_winners(rows, ranking):
            ax.scatter(x, y, s=120, lw=1.4, facecolor="none", edgecolor="black")
            words.append(heading(sentence, SMALL))
        ax.set_title("\n".join(words), loc="left", fontsize="small")
        ax.set_xlabel(f"mass of the {noun}, g")
        own = least and f"{least.axis}{', of a specimen' if noun == 'panel' else ''}"
        ax.set_ylabel(own or f"energy absorbed by the {noun}\n{ranking.until}, J")
        round_ticks(ax.xaxis)
        round_ticks(ax.yaxis)
    barred = bool(merit_errors(designs, energy).notna().any())
    entries = [*look.legend(barred=barred), FRONT, RING]
    heavy, coarse = (designs[mass] > most).any(), designs["coarse"].any()
    legend(fig, entries + [HEAVY] * bool(heavy) + [COARSE] * bool(coarse))


def thickness_trends(fig: Figure, ranking: Ranking) -> None:
    """Energy per gram over wall thickness, one panel per scene.

    Lines are named by their numbers of cells where these vary and the colour does not show them.
    """
    designs, per_gram = ranking.table, ranking.per_gram
    look, cells = looks(designs), ["cells_x", "cells_y"]
    varied = designs.groupby("lattice_kind")[cells].nunique().gt(1).any(axis=None)
    named, coarse = varied and "cells_x" not in look.tint, False
    for ax, rows in scene_axes(fig, designs):
        for _, points in rows.groupby(VARIANT):
            best = points.loc[points.groupby("wall_thickness_m")[per_gram].idxmax()]
            style = look.of(best) | {"s": 28.0}
            wall = in_unit(best["wall_thickness_m"], "mm")
            _line(ax, wall, best[per_gram], {"color": style["c"][0], "lw": 1.2}, best)
            _dots(ax, wall, best[per_gram], style, best)
            coarse |= bool(best["coarse"].any())
            _error_bars(ax, wall, best[per_gram], errors_of(best, per_gram), style["c"][0])
            if named:
                numbers = " x ".join(map(str, best[cells].iloc[0]))
                ax.annotate(numbers, (wall.iloc[-1], best[per_gram].iloc[-1]), **BESIDE)
        what = f"energy absorbed\n{ranking.until}, J/g"
        ax.set(xlabel="wall thickness, mm", ylabel=what, yscale="log")
        ax.margins(x=0.15 if named else 0.05)
        title = heading(titled(rows["scene"].iloc[0], ranking))
        ax.set_title(title, loc="left", fontsize="medium")
        round_ticks(ax.yaxis)
    barred = bool(errors_of(designs, per_gram).notna().any())
    legend(fig, look.legend(walls=False, barred=barred) + [COARSE] * coarse)


def _span(values: Sequence[float]) -> tuple[float, float]:
    """Ends of a log axis that contains all values, also if all are equal."""
    low, high = min(values), max(values)
    middle, half = (low * high) ** 0.5, max(high / low, NARROW) ** (0.5 + MARGIN)
    return middle / half, middle * half


def has_trends(designs: DataFrame) -> bool:
    """True if some designs differ only in the thickness of their walls."""
    others = [key for key in designs if key.startswith(SHAPED) and key not in THICK]
    alike = designs.groupby(["scene", *VARIANT, *others], dropna=False)
    return not designs.empty and alike["wall_thickness_m"].nunique().max() > 1


def heading(words: str, letters: int = TITLE) -> str:
    """A title no wider than a panel: its lines, with further breaks after commas."""
    one_piece = words.replace(" ", "\xa0").replace(",\xa0", ", ")
    wrapper = TextWrapper(
        letters, subsequent_indent="    ", break_on_hyphens=False, break_long_words=False
    )
    return "\n".join(map(wrapper.fill, one_piece.split("\n"))).replace("\xa0", " ")


def _line(ax: Axes, x: Series, y: Series, style: dict[str, Any], points: DataFrame) -> None:
    """A line through designs; dashed to and from doubtful ones."""
    beyond = doubtful(points)
    ax.plot(x, y.mask(beyond), zorder=1, **style)
    if beyond.any():
        ax.plot(x, y, zorder=1, ls="--", **style)


def _dots(ax: Axes, x: Series, y: Series, style: dict[str, Any], points: DataFrame) -> None:
    """Designs with one marker as dots; open if doubtful; an i beside them marks coarse steps."""
    dots = ax.scatter(x, y, lw=1.2, zorder=2, **style)
    colors = dots.get_facecolor()
    beyond = doubtful(points).to_numpy()[:, None]
    faces: Any = np.where(beyond, WHITE, colors)
    dots.set(edgecolor=colors, facecolor=faces)
    mark_coarse(ax, x[points["coarse"]], y[points["coarse"]])


def mark_coarse(ax: Axes, x: Series, y: Iterable[float]) -> None:
    """Write an i beside points whose steps are coarse."""
    for at in zip(x, y, strict=True):
        ax.annotate("i", at, (5.0, 3.0), textcoords="offset points", fontsize="small")


def _error_bars(ax: Axes, x: Series, y: Series, error: Series, color: str = GREY) -> None:
    """Value ± error as a thin line behind each design with a known error."""
    mask = error.notna()
    if mask.any():
        low, high = (end.clip(*(share * y for share in ENDS)) for end in (y - error, y + error))
        ax.vlines(x[mask], low[mask], high[mask], color=color, lw=0.8, zorder=0)


def scene_axes(fig: Figure, designs: DataFrame) -> Iterator[tuple[Axes, DataFrame]]:
    """Axes and designs of each scene, at most two scenes in a row of the figure."""
    scenes = designs.groupby("scene", sort=False)
    columns = min(2, len(scenes))
    rows = -(-len(scenes) // columns)
    axes = fig.subplots(rows, columns, squeeze=False).ravel()
    for ax in axes[len(scenes) :]:
        ax.remove()
    for ax, (scene, group) in zip(axes, scenes, strict=False):
        ax.set_title(heading(str(scene)), loc="left", fontsize="medium")
        ax.grid(color=GRID, lw=0.6)
        ax.set_axisbelow(True)
        plain(ax)
        yield ax, group
