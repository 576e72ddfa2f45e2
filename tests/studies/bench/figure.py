"""The picture of the bench: growth, an iteration taken apart, the seed's scene beside others."""

from sweep.report.figures.case_plots import (
    BLUE,
    GREY,
    ORANGE,
    PURPLE,
    SKY,
    VERMILION,
    YELLOW,
    blank,
)
from tests.studies.bench import growth, iteration, scenes
from tests.studies.bench.peers import libraries

COLORS = (BLUE, SKY, GREEN := "#009e73", YELLOW, ORANGE, VERMILION, PURPLE, GREY)


def draw(grown, factored, split, seed):
    """A figure of four tables."""
    figure = blank(15.0, 4.6)
    left, middle, right = figure.subplots(1, 3, width_ratios=(1.0, 1.25, 0.9))
    _growth(left, grown, factored)
    _split(middle, split)
    _seed(right, seed)
    for ax in (left, middle, right):
        ax.spines[["top", "right"]].set_visible(False)
    return figure


def _growth(ax, grown, factored):
    """An iteration and the libraries' factors over the size."""
    power = grown.values[growth.EACH, "power"]
    own = {cells: us for cells, us in grown.row(growth.EACH).items() if cells != "power"}
    ax.loglog(*zip(*own.items(), strict=True), "o-", color=BLUE, lw=2.2, label="a whole iteration")
    ax.text(0.03, 0.97, f"iteration ~ cells$^{{{power:.2f}}}$", transform=ax.transAxes, va="top")
    names = dict.fromkeys(name for name, _ in factored.values)
    for name, color in zip(names, COLORS[1:], strict=False):
        words = "our factor + solve" if name == libraries.OURS else name
        given = zip(*factored.row(name).items(), strict=True)
        ax.loglog(*given, ".--", color=color, lw=1.2, label=words)
    ax.set(xlabel="cells a side", ylabel="µs", title="one iteration, and factor + solve")
    ax.set_xticks(list(own), [str(cells) for cells in own])
    ax.minorticks_off()
    _legend_below(ax)


def _split(ax, split):
    """Shares of an iteration, stacked."""
    parts = list(dict.fromkeys(name for name, _ in split.values))
    begun = dict.fromkeys(split.columns, 0.0)
    for part, color in zip(parts[1:], COLORS, strict=False):
        for at, column in enumerate(split.columns):
            share = 100.0 * split.values[part, column] / split.values[iteration.WHOLE, column]
            label = part if at == 0 else None
            ax.barh(at, max(share, 0.0), left=begun[column], color=color, label=label)
            begun[column] += max(share, 0.0)
    wholes = (split.texts[iteration.WHOLE, column] for column in split.columns)
    names = [f"{column}\n{us} µs" for column, us in zip(split.columns, wholes, strict=True)]
    ax.set_yticks(range(len(names)), names)
    ax.invert_yaxis()
    ax.set(xlabel="% of an iteration", title="where an iteration goes")
    _legend_below(ax)


def _legend_below(ax):
    place = {"loc": "upper center", "bbox_to_anchor": (0.45, -0.14)}
    ax.legend(frameon=False, fontsize="small", ncols=2, **place)


def _seed(ax, seed):
    """CPU seconds of the seed's scene."""
    spent = {name: s for (name, column), s in seed.values.items() if column == scenes.WHOLE}
    own = {scenes.SEED, *scenes.ALLOWED}
    colors = [BLUE if name in own else GREY for name in spent]
    ax.scatter(list(spent.values()), range(len(spent)), color=colors)
    for row, taken in enumerate(spent.values()):
        ax.annotate(f"{taken:.3g} s", (taken, row), (6, -3), textcoords="offset points")
    ax.set_xscale("log")
    ax.grid(axis="x", alpha=0.3)
    ax.set_yticks(range(len(spent)), [name.replace(", ", ",\n") for name in spent])
    ax.invert_yaxis()
    ax.margins(x=0.25)
    ax.set(xlabel="CPU s of a whole run", title=seed.title)
