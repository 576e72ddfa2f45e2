"""The picture of the comparison: the crush with contact, and errors over the slenderness."""

from sweep.report.figures.case_plots import BLUE, GREY, ORANGE, SKY, VERMILION, blank
from tests.studies.continuum import study

COLORS = (BLUE, "#9ecae1", SKY, ORANGE, VERMILION, GREY)
STYLES = {"stress": "o-", "strain": "s--"}
LAST = -1  # energy to the last strain


def draw(grids, crush):
    """grids, crush: `study.Compared`."""
    figure = blank(12.0, 4.8)
    left, right = figure.subplots(1, 2)
    _curves(left, crush)
    _errors(right, grids)
    for ax in (left, right):
        ax.spines[["top", "right"]].set_visible(False)
        ax.legend(frameon=False, fontsize="x-small")
    return figure


def _curves(ax, crush):
    for side, color in zip((*crush.sides, crush.truth), (*COLORS, "black"), strict=True):
        strain, force, _ = side.rows
        ax.plot(100.0 * strain, force, color=color, lw=1.6, label=side.name)
    thickness = crush.case.grid().thickness
    ax.set(xlabel="strain, %", ylabel="force, N", title=f"3 x 3 cells, walls of {thickness:g} mm")


def _errors(ax, grids):
    """Draw the errors of the energy, by models and planes."""
    for plane, style in STYLES.items():
        rows = [found for found in grids if found.case.plane == plane]
        slender = [found.case.slenderness for found in rows]
        errors = [[values[LAST] for _, values in found.errors()] for found in rows]
        for (name, pieces, _), color, line in zip(
            study.MODELS, COLORS, zip(*errors, strict=True), strict=False
        ):
            label = f"{name}, {pieces} elements" if plane == "stress" else None
            ax.plot(slender, line, style, color=color, lw=1.4, ms=4, label=label)
    ax.axhline(0.0, color="black", lw=0.8)
    title = "error of the energy to 30 %; dashed: plane strain"
    ax.set(xlabel="wall thickness / pitch", ylabel="%", title=title)
