"""Pictures of materials: their curves side by side, and the record of a coupon beside its fit."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING

import numpy as np

from sweep.array_types import Floats
from sweep.numbers import in_unit
from sweep.report.figures.case_plots import BLUE, GREY, ORANGE, PURPLE, SKY, VERMILION, YELLOW

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

Curve = tuple[Floats, Floats]
COLORS = (BLUE, VERMILION, ORANGE, SKY, PURPLE, GREY, YELLOW)
STYLES = ("-", "--", ":")
NEAR = -0.1, 0.1  # strain


def material_curves(figure: Figure, curves: Mapping[str, Curve]) -> None:
    """Nominal stress over nominal strain, compression and tension, with an enlarged middle.

    curves: strain (k,) and stress (k,) in Pa by the names of the materials.
    """
    whole, near = figure.subplots(1, 2)
    for k, (name, (strain, stress)) in enumerate(curves.items()):
        style = STYLES[k // len(COLORS) % len(STYLES)]
        for ax in (whole, near):
            ax.plot(
                strain,
                in_unit(stress, "MPa"),
                style,
                color=COLORS[k % len(COLORS)],
                lw=1.6,
                label=name,
            )
    whole.set_title("compression and tension", loc="left", fontsize="medium")
    near.set_title("up to 10 %", loc="left", fontsize="medium")
    ends = [np.interp(NEAR, strain, stress) for strain, stress in curves.values()]
    low, high = (1.05 * in_unit(end, "MPa") for end in (np.min(ends), np.max(ends)))
    near.set(xlim=NEAR, ylim=(low, high))
    for ax in (whole, near):
        _cross(ax)
    near.legend(frameon=False, loc="upper left")


def coupon_fit(figure: Figure, record: Curve, model: Curve, title: str) -> None:
    """The record of a coupon and the law taken through the same test; the difference below."""
    above, below = figure.subplots(2, 1, sharex=True, height_ratios=[3, 1])
    above.plot(record[0], in_unit(record[1], "MPa"), ".", color=GREY, ms=3, label="record")
    above.plot(model[0], in_unit(model[1], "MPa"), color=VERMILION, lw=1.4, label="law")
    above.set_title(title, loc="left", fontsize="small", wrap=True)
    above.legend(frameon=False)
    _cross(above)
    most = float(np.abs(record[1]).max())
    below.plot(record[0], in_unit((model[1] - record[1]) / most, "%"), ".", color=BLUE, ms=2)
    below.axhline(0.0, color="black", lw=0.6)
    above.set_xlabel("")
    below.set(xlabel="nominal strain", ylabel="law - record, % of\nthe greatest stress")


def _cross(ax: Axes) -> None:
    """Axes through the origin, with their labels."""
    ax.axhline(0.0, color="black", lw=0.6)
    ax.axvline(0.0, color="black", lw=0.6)
    ax.set(xlabel="nominal strain", ylabel="nominal stress, MPa")
