"""Picture of the load on the base of a case: its greatest pressure on a patch."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

from pandas import DataFrame

from sweep.numbers import in_unit, significant, text_in
from sweep.report.figures.case_plots import BLUE, mark, plain
from sweep.report.figures.storyboard import headline, path_of, turns

if TYPE_CHECKING:
    from matplotlib.axes import Axes


def base_pressure(ax: Axes, history: DataFrame, row: Mapping[str, Any]) -> None:
    """Greatest pressure on a patch of the base over time, or over the path of a driven platen.

    Its peak is marked with its place.
    """
    (place, words), pressure = path_of(history, row), in_unit(history["base_pressure_Pa"], "kPa")
    for at, turn in turns(history, row).items():
        mark(ax, place[at], turn, after=turn.startswith("cycle"))
    ax.plot(place, pressure, color=BLUE, lw=1.8)
    peak = int(pressure.argmax())
    where = text_in(history["base_pressure_x_m"][peak], "mm", 3)
    label = f"{significant(pressure[peak], 3)} kPa, x = {where}"
    ax.plot(place[peak], pressure[peak], "o", color=BLUE, label=label)
    ax.set(xlabel=words, ylabel="greatest pressure on a patch of the base, kPa")
    ax.set_title(headline(row), loc="left", fontsize="medium")
    ax.margins(x=0.0)
    ax.set_ylim(bottom=0.0)
    ax.legend(frameon=False, loc="upper left", bbox_to_anchor=(1, 1))
    plain(ax)
