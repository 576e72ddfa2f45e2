"""Picture of a custom structure: the reactions at its probes."""

from __future__ import annotations

import re
from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

from pandas import DataFrame

from sweep.numbers import in_unit
from sweep.report.figures.storyboard import headline

if TYPE_CHECKING:
    from matplotlib.axes import Axes

PROBE = re.compile(r"probe_(\d+)_reaction_([xy])_N")
COLORS = ("#0072b2", "#d55e00", "#e69f00", "#56b4e9", "#cc79a7", "#8a8a8a")


def probe_reactions(ax: Axes, history: DataFrame, row: Mapping[str, Any]) -> None:
    """Forces on the structure at its probes and from the floor, over load factor or time."""
    loaded = "load_factor" in history
    abscissa = history["load_factor"] if loaded else in_unit(history["time_s"], "ms")
    columns = {name: match for name in history if (match := PROBE.fullmatch(name))}
    curves = {f"{m[2]} at node {m[1]}": history[name] for name, m in columns.items()}
    curves["floor"] = history["reaction_bottom_N"]
    shown = {label: force for label, force in curves.items() if force.abs().max() > 0.0}
    for k, (label, force) in enumerate(shown.items()):
        style = "-" if k < len(COLORS) else "--"
        ax.plot(abscissa, force, color=COLORS[k % len(COLORS)], lw=1.8, ls=style, label=label)
    ax.set(xlabel="load factor" if loaded else "time, ms", ylabel="reaction, N")
    ax.set_title(headline(row), loc="left", fontsize="medium")
    ax.margins(x=0.0)
    ax.axhline(0.0, color="black", lw=0.6)
    if shown:
        ax.legend(frameon=False, loc="upper left", bbox_to_anchor=(1, 1))
