"""A moving picture of a case: its stored shapes one after another, beside the force so far."""

from __future__ import annotations

from collections.abc import Mapping
from io import BytesIO
from typing import TYPE_CHECKING, Any

import numpy as np

from sweep.report import case_plots
from sweep.report.storyboard import headline

if TYPE_CHECKING:
    from pathlib import Path

    from matplotlib.axes import Axes
    from matplotlib.figure import Figure
    from pandas import DataFrame

SIZE = (8.0, 4.2)  # inches
PLACES = {"left": 0.02, "right": 0.97, "bottom": 0.14, "top": 0.84, "wspace": 0.25}
DPI, COLOURS = 80, 128
STEP, REST = 120, 1200  # ms that a shape and the last one are shown


def write_gif(
    path: Path, row: Mapping[str, Any], frames: Mapping[str, Any], history: DataFrame
) -> None:
    """Write the animation of a case, which repeats for ever."""
    from PIL import Image

    count, figure = len(frames["strain"]), case_plots.blank(*SIZE)
    figure.set_layout_engine("none")  # pictures of one series have one layout
    pictures = []
    for k in range(count):
        figure.clear()
        moment(figure, row, frames, history, k)
        pictures.append(Image.open(_rendered(figure)).convert("RGB").quantize(COLOURS))
    shown = [STEP] * (count - 1) + [REST]
    pictures[0].save(path, save_all=True, append_images=pictures[1:], duration=shown, loop=0)


def moment(
    figure: Figure,
    row: Mapping[str, Any],
    frames: Mapping[str, Any],
    history: DataFrame,
    k: int,
) -> None:
    """Draw shape number ``k`` on the left, and on the right the force up to its time."""
    left, right = figure.subplots(1, 2, gridspec_kw=PLACES)
    figure.suptitle(headline(row), x=0.01, ha="left", fontsize="medium")
    case_plots.one_shape(left, frames, k)
    _force(right, row, frames, history, k)


def _rendered(figure: Figure) -> BytesIO:
    """A figure as PNG."""
    picture = BytesIO()
    figure.savefig(picture, dpi=DPI, format="png", facecolor="white")
    picture.seek(0)
    return picture


def _force(
    ax: Axes, row: Mapping[str, Any], frames: Mapping[str, Any], history: DataFrame, k: int
) -> None:
    """The whole curve in grey, what has happened in blue, and a dot at the shape that is shown."""
    custom = row["loading_mode"] == "custom"
    place = 1e3 * history["time_s"] if custom else 100.0 * history["strain"]
    force = history["reaction_top_N"]
    last = _last_row(history, frames, k)
    ax.plot(place, force, color=case_plots.GRID, lw=2.0)
    ax.plot(place[: last + 1], force[: last + 1], color=case_plots.BLUE, lw=2.0)
    ax.plot(place[last], force[last], "o", color=case_plots.VERMILION)
    ax.set(xlabel="time, ms" if custom else "strain, %", ylabel="force, N")
    case_plots.plain(ax)


def _last_row(history: DataFrame, frames: Mapping[str, Any], k: int) -> int:
    """Number of the row of the history at the time of a shape."""
    return int(np.abs(history["time_s"].to_numpy() - frames["time_s"][k]).argmin())
