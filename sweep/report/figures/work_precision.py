"""Work-precision diagrams: error against processor time, one line per method."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from sweep.numbers import in_unit
from sweep.ranking.accuracy import TARGETS, Study, front
from sweep.report.figures.case_plots import (
    BLUE,
    GREY,
    GRID,
    ORANGE,
    PURPLE,
    SKY,
    VERMILION,
    plain,
    round_ticks,
)
from sweep.report.tables.accuracy_tables import LEAST_SHOWN, measure_noun, percents

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure, SubFigure

COLORS = (BLUE, VERMILION, ORANGE, PURPLE, SKY, GREY)
SIGNS = "osD^vP"


def work_precision(fig: Figure, studies: dict[str, Study]) -> None:
    """One row of panels per scene, one panel per measure. studies: by title."""
    strips = fig.subfigures(len(studies), 1, squeeze=False)[:, 0]
    for strip, (title, study) in zip(strips, studies.items(), strict=True):
        strip.suptitle(title, x=0.01, ha="left", fontsize="medium")
        _scene(strip, study)


def _scene(fig: SubFigure, study: Study) -> None:
    axes = fig.subplots(1, len(study.references), sharex=True, squeeze=False)[0]
    for ax, name in zip(axes, study.references, strict=True):
        ax.set(xscale="log", yscale="log", xlabel="processor time, s", ylabel="error, %")
        ax.set_title(measure_noun(study, name), loc="left", fontsize="medium")
        ax.grid(color=GRID, lw=0.6)
        ax.set_axisbelow(True)
        plain(ax)
        _lines(ax, study, name)
        round_ticks(ax.xaxis)
        round_ticks(ax.yaxis)
    handles, labels = axes[0].get_legend_handles_labels()
    fig.legend(handles, labels, loc="outside right upper", frameon=False)


def _lines(ax: Axes, study: Study, name: str) -> None:
    """Settings as dots, the front of a method as its line, the front of all methods ringed.

    Errors below the uncertainty of the reference are drawn at that uncertainty.
    """
    doubt = study.references[name].doubt
    rows = study.settings.dropna(subset=name)
    rows = rows.assign(**{name: in_unit(rows[name].clip(lower=max(doubt, LEAST_SHOWN)), "%")})
    for k, (method, group) in enumerate(rows.groupby("method", sort=False)):
        look: dict[str, Any] = {"color": COLORS[k % len(COLORS)]}
        best = group[front(group, name)].sort_values("cpu_s")
        dots: dict[str, Any] = {
            "marker": SIGNS[k % len(SIGNS)],
            "s": 14.0,
            "alpha": 0.45,
            "lw": 0.0,
        }
        ax.scatter(group["cpu_s"], group[name], **dots, **look)
        ax.plot(best["cpu_s"], best[name], lw=1.8, label=method, **look)
    ringed = rows[front(rows, name)]
    ring: dict[str, Any] = {"s": 60.0, "facecolor": "none", "edgecolor": "black", "lw": 0.9}
    ax.scatter(ringed["cpu_s"], ringed[name], label="Pareto front", **ring)
    for target in TARGETS:
        ax.axhline(in_unit(target, "%"), color=GREY, lw=0.9, ls=":")
    low, floor = ax.get_ylim()[0], in_unit(doubt, "%")
    if low < floor < float("inf"):
        ax.axhspan(low, floor, color=GRID, lw=0.0, zorder=0)
        ax.annotate(f"uncertainty of the reference: {percents(doubt)}", (0.02, floor), (0, -3),
                    xycoords=ax.get_yaxis_transform(), textcoords="offset points", va="top",
                    fontsize="x-small", color="#555555")  # fmt: skip
        ax.set_ylim(bottom=low)
