"""Linear against nonlinear stretching, under force and under displacement."""

from pathlib import Path

import numpy as np
from pandas import DataFrame

from sweep import plots
from sweep.figures.cases import history, ours, report, varied
from sweep.figures.panels import curves, legend, title
from sweep.params import Case

LAWS = ("nonlinear", "linear")
PRESSED = {"mode": "displacement", "strain": 0.6, "unload": False, "platen": "glued"}


def draw(folder: Path) -> tuple[str, ...]:
    """Its Figs. 9 and 10."""
    forced, pressed = _pair(report()), _pair(varied(ours(), loading=PRESSED))
    steady = _pair(ours())
    figure = plots.blank(9.0, 3.4)
    ax = figure.subplots()
    lines = {f"{law}, the report's model": _way(past) for law, past in forced.items()}
    curves(ax, lines | {f"{law}, our model": _way(past) for law, past in steady.items()},
           "time, ms", "strain, %")  # fmt: skip
    legend(ax)
    plots.save(figure, folder / "fig09_stretching_strain.png")
    figure = plots.blank(10.0, 3.6)
    left, right = figure.subplots(1, 2)
    for ax, pasts, x in ((left, forced, "time_s"), (right, pressed, "strain")):
        factor, words = (1e3, "time, ms") if x == "time_s" else (100.0, "strain, %")
        lines = {
            f"{label}, {law}": (factor * past[x], 1e3 * past[key])
            for key, label in (("bend_J", "bending"), ("stretch_J", "stretching"))
            for law, past in pasts.items()
        }
        curves(ax, lines, words, "energy, mJ")
    title(left, f"under a force of {report().loading.force:g} N, the report's model")
    title(right, "under displacement, our model")
    legend(right)
    plots.save(figure, folder / "fig10_stretching_energies.png")
    apart = {
        name: {key: _apart(pasts, key, x) for key in ("stretch_J", "bend_J", "strain")}
        for name, pasts, x in (
            ("force", forced, "time_s"), ("force_ours", steady, "time_s"), ("way", pressed, "strain"),
        )
    }  # fmt: skip
    load = _apart(pressed, "reaction_top_N", "strain")
    return (
        "Figs. 9 and 10 compare linear and nonlinear stretching under a force and find little "
        "difference; the report expected more under displacement.",
        f"Under the force the strain differs by at most {100 * apart['force']['strain']:.1f} % of "
        f"its greatest value ({100 * apart['force_ours']['strain']:.1f} % in our model), bending by "
        f"{100 * apart['force']['bend_J']:.1f} % ({100 * apart['force_ours']['bend_J']:.1f} %) and "
        f"stretching by {100 * apart['force']['stretch_J']:.0f} % "
        f"({100 * apart['force_ours']['stretch_J']:.0f} %). Under displacement, pressed to 60 % "
        f"between glued platens, the force differs by {100 * load:.1f} %, bending by "
        f"{100 * apart['way']['bend_J']:.1f} % and stretching by {100 * apart['way']['stretch_J']:.1f} %.",
        _answer(apart["force_ours"]["bend_J"], apart["way"]["bend_J"]),
    )


def _pair(case: Case) -> dict[str, DataFrame]:
    return {law: history(varied(case, material={"stretch": law})) for law in LAWS}


def _way(past: DataFrame) -> tuple[DataFrame, DataFrame]:
    return 1e3 * past["time_s"], 100.0 * past["strain"]


def _apart(pasts: dict[str, DataFrame], column: str, x: str) -> float:
    """Greatest difference of a column between the laws / its greatest value."""
    one, other = (pasts[law] for law in LAWS)
    return float(
        np.abs(one[column] - np.interp(one[x], other[x], other[column])).max() / one[column].max()
    )


def _answer(force: float, way: float) -> str:
    """The report's question: is there more divergence under displacement?"""
    more = "more" if way > force else "less"
    return (
        f"The report's question: in our model the laws part {more} under displacement than under "
        f"force ({100 * way:.1f} % against {100 * force:.1f} % of the bending energy). Walls that "
        "bend hardly stretch, so the law matters where the lattice is about to buckle: there a "
        "force lets a small difference of stiffness grow, while a displacement prescribes the way."
    )
