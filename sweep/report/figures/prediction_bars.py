"""Predicted ranges as bars, beside the measured values with their scatter."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

from sweep.ranking.comparison import Comparison
from sweep.report.figures.case_plots import BLUE, GREY, GRID, VERMILION, plain

if TYPE_CHECKING:
    from matplotlib.axes import Axes

ROW, WIDTH, MARGIN = 0.3, 9.0, 1.2  # inches: height of a row, width, height without rows
THIN = 0.004  # share of the measured value: least width of a bar


def size(comparisons: Sequence[Comparison]) -> tuple[float, float]:
    """Width and height (inches) of a figure."""
    return WIDTH, MARGIN + ROW * len(comparisons)


def prediction_bars(ax: Axes, comparisons: Sequence[Comparison]) -> None:
    """A bar for each prediction / middle of the measured range; predictions outside in another
    colour.

    Rows without a prediction or a measured value are left out.
    """
    rows = [row for row in comparisons if row.off is not None]
    for place, row in enumerate(rows):
        assert row.measured is not None  # as `off` is known
        assert row.predicted is not None
        middle = 0.5 * sum(row.measured)
        low, high = (value / middle for value in row.predicted)
        color = BLUE if row.off == 0.0 else VERMILION
        ax.barh(place, max(high - low, THIN), left=low, height=0.6, color=color)
        scatter = row.measured.high / middle - 1.0
        ax.errorbar(1.0, place, xerr=scatter, fmt="o", ms=4, color="black", capsize=3)
    ax.plot([], [], lw=6.0, color=BLUE, label="predicted range, inside")
    ax.plot([], [], lw=6.0, color=VERMILION, label="outside")
    ax.errorbar([], [], xerr=[], fmt="o", ms=4, color="black", label="measured, with scatter")
    ax.axvline(1.0, color=GREY, lw=0.8, zorder=0)
    ax.set_yticks(range(len(rows)), [f"{row.source}: {row.quantity}" for row in rows],
                  fontsize="small")  # fmt: skip
    ax.invert_yaxis()
    ax.set(xscale="log", xlabel="predicted / measured")
    ticks = [0.5, 0.7, 1.0, 1.5, 2.0, 3.0, 4.0]
    ax.set_xticks(ticks, [f"{tick:g}" for tick in ticks])
    ax.set_xticks([], minor=True)
    ax.grid(color=GRID, lw=0.6, axis="x")
    ax.set_axisbelow(True)
    plain(ax)
    ax.legend(loc="lower center", bbox_to_anchor=(0.5, 1.0), ncols=3, frameon=False)
