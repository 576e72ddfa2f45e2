"""Axes with labelled curves, in the style of `case_plots`."""

from sweep.report.figures.case_plots import BLUE, GREY, GRID, ORANGE, PURPLE, SKY, VERMILION, plain

COLORS = (BLUE, VERMILION, SKY, ORANGE, PURPLE, GREY)


def curves(ax, lines, x, y, **look):
    """Draw curves by their labels, with the names of both axes."""
    for color, (label, (along, up)) in zip(COLORS, lines.items(), strict=False):
        style = {"color": color, "lw": 1.6, "label": label} | look
        ax.plot(along, up, **style)
    dress(ax, x, y)


def dress(ax, x, y):
    """Set the names of the axes and a light grid, and remove the box."""
    ax.set(xlabel=x, ylabel=y)
    ax.grid(color=GRID, lw=0.6)
    ax.set_axisbelow(True)
    plain(ax)


def title(ax, words):
    """A title above the left end."""
    ax.set_title(words, loc="left", fontsize="medium")


def legend(ax, **where):
    """A legend without a frame, by default to the right of the axes."""
    right = {"loc": "upper left", "bbox_to_anchor": (1, 1)}
    ax.legend(**({"frameon": False, "fontsize": "small"} | (where or right)))


def ticks(axis, values):
    """Ticks of a log axis at the given values only."""
    axis.set_ticks([], minor=True)
    axis.set_ticks(list(values), [f"{value:g}" for value in values])
