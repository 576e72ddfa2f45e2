"""Axes with labelled curves, in the style of `case_plots`."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import TYPE_CHECKING, Any

from sweep.report.figures.case_plots import BLUE, GREY, GRID, ORANGE, PURPLE, SKY, VERMILION, plain

if TYPE_CHECKING:
    from matplotlib.axes import Axes

COLORS = (BLUE, VERMILION, SKY, ORANGE, PURPLE, GREY)

Curves = Mapping[str, tuple[Any, Any]]


def curves(ax: Axes, lines: Curves, x: str, y: str, **look: Any) -> None:
    """Draw curves by their labels, with the names of both axes."""
    for color, (label, (along, up)) in zip(COLORS, lines.items(), strict=False):
        style: dict[str, Any] = {"color": color, "lw": 1.6, "label": label} | look
        ax.plot(along, up, **style)
    dress(ax, x, y)


def dress(ax: Axes, x: str, y: str) -> None:
    """Set the names of the axes and a light grid, and remove the box."""
    ax.set(xlabel=x, ylabel=y)
    ax.grid(color=GRID, lw=0.6)
    ax.set_axisbelow(True)
    plain(ax)


def title(ax: Axes, words: str) -> None:
    """A title above the left end."""
    ax.set_title(words, loc="left", fontsize="medium")


def legend(ax: Axes, **where: Any) -> None:
    """A legend without a frame, by default to the right of the axes."""
    right: dict[str, Any] = {"loc": "upper left", "bbox_to_anchor": (1, 1)}
    ax.legend(**({"frameon": False, "fontsize": "small"} | (where or right)))


def ticks(axis: Any, values: Iterable[float]) -> None:
    """Ticks of a log axis at the given values only."""
    axis.set_ticks([], minor=True)
    axis.set_ticks(list(values), [f"{value:g}" for value in values])
