"""Bars of energy per gram, to compare patterns: one for each design, the best on top."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from math import inf
from textwrap import fill
from typing import TYPE_CHECKING, Any

import numpy as np
from pandas import DataFrame

from sweep.numbers import in_unit
from sweep.ranking.budget import greatest_mass
from sweep.ranking.merit import doubtful
from sweep.ranking.ranking import Ranking
from sweep.report.figures.case_plots import GREY, beside, legend, walls
from sweep.report.figures.design_style import errors_of
from sweep.report.figures.ranking_plots import COARSE, HEAVY, heading, mark_coarse
from sweep.report.tables.design_text import design_labels
from sweep.report.tables.requirement_notes import titled

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

DARK = "#3b528b"
ROW, DRAWN_ROW = 0.25, 0.5  # inches for a bar, without and with a drawing
WIDTH, DRAWN = 9.0, 0.7  # inches of the figure, and for a drawing as wide as high
WIDEST = 2.5  # widths over heights of a drawing as high as its row; wider ones are drawn smaller
PAD = 3.0  # points between the drawings and the names
LETTERS = 46  # most letters of a line of a name beside a drawing


def pattern_bars(
    fig: Figure, ranking: Ranking, shapes: Mapping[str, Mapping[str, Any]] | None = None
) -> None:
    """Energy per gram of every design with its error bar, the best on top, one panel per scene.

    Bars of doubtful designs are open, bars above all budgets grey; an i marks coarse steps.
    shapes: case_id -> frames; then each name has a drawing.
    """
    designs, per_gram = ranking.table, ranking.per_gram
    heavy = designs[ranking.mass] > greatest_mass(max(ranking.budgets_g, default=inf))
    scenes = designs.groupby("scene", sort=False)
    axes = fig.subplots(len(scenes), 1, squeeze=False).ravel()
    for ax, (scene, rows) in zip(axes, scenes, strict=True):
        ordered = rows.sort_values([per_gram, "case_id"])
        colors = [GREY if above else DARK for above in heavy[ordered.index]]
        bars = ax.barh(range(len(ordered)), ordered[per_gram], color=colors, ec=colors)
        for bar, doubt in zip(bars, doubtful(ordered), strict=True):
            bar.set(fill=not doubt)
        errors = errors_of(ordered, per_gram)
        ax.errorbar(ordered[per_gram], range(len(ordered)), xerr=errors, fmt="none", ecolor="black")
        coarse = ordered["coarse"].to_numpy()
        mark_coarse(ax, ordered[per_gram][coarse], np.flatnonzero(coarse))
        labels = design_labels(ordered, designs)
        labels = [fill(label, LETTERS) for label in labels] if shapes else labels
        ax.set_yticks(range(len(ordered)), labels, fontsize="small")
        if shapes:
            _draw(ax, [shapes[case_id] for case_id in ordered["case_id"]])
        ax.margins(y=0.5 / len(ordered))
        ax.set_title(heading(titled(str(scene), ranking)), loc="left", fontsize="medium")
        ax.set_xlabel(f"energy absorbed\n{ranking.until}, J/g")
        ax.spines[["top", "right"]].set_visible(False)
    entries: list[dict[str, Any]] = [HEAVY | {"marker": "s"}] * bool(heavy.any())
    entries += [COARSE] * bool(designs["coarse"].any())
    legend(fig, entries, below=True)


def _draw(ax: Axes, shapes: Sequence[Mapping[str, Any]]) -> None:
    """Draw the shapes at rest left of their bars, and move the names out of their way."""
    rests = [in_unit(np.asarray(frames["position_m"][0], float), "mm") for frames in shapes]
    aspects = [float(np.divide(*np.ptp(rest, axis=0)[:2])) for rest in rests]
    drawn = DRAWN * min(WIDEST, max(1.0, *aspects))
    ax.tick_params(axis="y", length=0.0, pad=72.0 * drawn + PAD)
    for place, (frames, rest, aspect) in enumerate(zip(shapes, rests, aspects, strict=True)):
        height = 0.92 * min(1.0, WIDEST / aspect)
        left = beside(ax, drawn, place - 0.5 * height, height)
        walls(left, rest, frames)
        left.autoscale_view()


def panel_size(designs: DataFrame, drawn: bool = False) -> tuple[float, float]:
    """Width and height (inches) for one bar per design and one panel per scene."""
    row = DRAWN_ROW if drawn else ROW
    return WIDTH, row * len(designs) + 0.9 * designs["scene"].nunique()
