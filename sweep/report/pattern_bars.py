"""Which pattern: designs of several families side by side, as bars."""

from __future__ import annotations

from typing import TYPE_CHECKING

from sweep.report.design_style import doubtful, errors_of, until
from sweep.report.requirement_notes import titled
from sweep.report.sheets import design_labels

if TYPE_CHECKING:
    from matplotlib.figure import Figure
    from pandas import DataFrame

    from sweep.ranking.ranking import Ranking


def pattern_bars(fig: Figure, ranking: Ranking) -> None:
    """Energy per gram of every design with its error bar, the best on top, one panel per scene.

    Bars of doubtful designs are open.
    """
    designs, per_gram = ranking.table, ranking.per_gram
    scenes = designs.groupby("scene", sort=False)
    axes = fig.subplots(len(scenes), 1, squeeze=False).ravel()
    for ax, (scene, rows) in zip(axes, scenes, strict=True):
        ordered = rows.sort_values([per_gram, "case_id"])
        bars = ax.barh(range(len(ordered)), ordered[per_gram], color="#3b528b", ec="#3b528b")
        for bar, doubt in zip(bars, doubtful(ordered), strict=True):
            bar.set(fill=not doubt)
        errors = errors_of(ordered, per_gram)
        ax.errorbar(ordered[per_gram], range(len(ordered)), xerr=errors, fmt="none", ecolor="black")
        ax.set_yticks(range(len(ordered)), design_labels(ordered, designs), fontsize="small")
        ax.set_title(titled(str(scene), ranking), loc="left", fontsize="medium")
        ax.set_xlabel(f"absorbed energy per gram{until(ranking)}, J/g")
        ax.spines[["top", "right"]].set_visible(False)


def panel_size(designs: DataFrame) -> tuple[float, float]:
    """Width and height (inches) for one bar per design and one panel per scene."""
    return 9.0, 0.25 * len(designs) + 0.9 * designs["scene"].nunique()
