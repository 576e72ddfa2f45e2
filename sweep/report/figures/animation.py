"""An animation of a case: its stored shapes one after another, beside the force so far."""

from __future__ import annotations

from collections.abc import Mapping
from io import BytesIO
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from pandas import DataFrame

from sweep.loading_modes import MODES
from sweep.numbers import in_unit
from sweep.report.figures import case_plots
from sweep.report.figures.panel_piece import piece
from sweep.report.figures.probe_plots import probe_reactions
from sweep.report.figures.storyboard import headline, standing

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

SIZE = (8.0, 4.2)  # inches
PLACES = {"left": 0.02, "right": 0.97, "bottom": 0.14, "top": 0.84, "wspace": 0.25}
DPI, COLOURS = 80, 128
EACH = ("strain", "time_s", "position_m", "plate_y_m")  # one of each shape
STEP, REST = 120, 1200  # ms for which a shape and the last one are shown


def write_gif(
    path: Path, row: Mapping[str, Any], frames: Mapping[str, Any], history: DataFrame
) -> None:
    """Write the animation of a case, which repeats forever."""
    from PIL import Image

    # shapes from the first one on that has lifted off would make all others small
    count, figure = standing(frames["position_m"]), case_plots.blank(*SIZE)
    frames = piece({**frames, **{name: frames[name][:count] for name in EACH}}, row)
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
    """Draw shape number ``k`` on the left, and on the right the force, or the reactions, at that
    time.
    """
    left, right = figure.subplots(1, 2, gridspec_kw=PLACES)
    figure.suptitle(headline(row), x=0.01, ha="left", fontsize="medium")
    case_plots.one_shape(left, frames, k)
    last = int(np.abs(history["time_s"].to_numpy() - frames["time_s"][k]).argmin())
    if MODES[row["loading_mode"]].probed:
        _reactions(right, row, history, last)
    else:
        _force(right, history, last)


def _rendered(figure: Figure) -> BytesIO:
    """A figure as PNG."""
    picture = BytesIO()
    figure.savefig(picture, dpi=DPI, format="png", facecolor="white")
    picture.seek(0)
    return picture


def _force(ax: Axes, history: DataFrame, last: int) -> None:
    """The whole curve in grey, the part so far in blue, and a dot at the present shape."""
    strain, force = in_unit(history["strain"], "%"), history["reaction_top_N"]
    ax.plot(strain, force, color=case_plots.GRID, lw=2.0)
    ax.plot(strain[: last + 1], force[: last + 1], color=case_plots.BLUE, lw=2.0)
    ax.plot(strain[last], force[last], "o", color=case_plots.VERMILION)
    ax.set(xlabel="strain, %", ylabel="force, N")
    case_plots.plain(ax)


def _reactions(ax: Axes, row: Mapping[str, Any], history: DataFrame, last: int) -> None:
    """The reactions of a custom structure, and a line at the present shape."""
    probe_reactions(ax, history, row)
    ax.set_title("", loc="left")
    place = history["load_factor"] if "load_factor" in history else in_unit(history["time_s"], "ms")
    ax.axvline(place[last], color=case_plots.GREY)
    if ax.get_legend():
        ax.legend(frameon=False, fontsize="small")
    case_plots.plain(ax)
