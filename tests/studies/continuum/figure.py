"""The picture of the comparison: curves, a crushed solid, errors over the slenderness."""

from matplotlib.collections import PolyCollection

from sweep.report.case_plots import BLUE, GREY, ORANGE, SKY, VERMILION, WALL, blank
from tests.studies.continuum import study

COLORS = (SKY, "#9ecae1", BLUE, ORANGE, GREY, "black")
SHOWN = {study.POINTS: BLUE, study.BLOCKS: SKY, study.THICK: ORANGE, study.COARSER: GREY}
MEASURED = ("force at", "energy to")
APART = [f"{what} {100 * strain:.0f} %" for what in MEASURED for strain in study.APART]
NAMES = ("stiffness at rest", *APART)
CURVES = {1: "o-", 4: "s--"}  # force at the first strain, energy to the last


def draw(sides, rows):
    """sides: of the crush, the finest solid last. rows: of the slendernesses."""
    figure = blank(15.0, 4.8)
    left, middle, right = figure.subplots(1, 3, width_ratios=(1.2, 0.9, 1.1))
    _curves(left, sides)
    _shape(middle, sides[-1])
    _errors(right, rows)
    for ax in (left, right):
        ax.spines[["top", "right"]].set_visible(False)
    return figure


def _curves(ax, sides):
    for side, color in zip(sides, COLORS, strict=True):
        strain, force, _ = side.rows
        ax.plot(100.0 * strain, force, color=color, lw=1.6, label=side.name)
    ax.set(xlabel="strain, %", ylabel="force, N", title="3 x 3 cells, walls of 0.8 mm")
    ax.legend(frameon=False, fontsize="small")


def _shape(ax, side):
    """Elements of a solid as they end, drawn by their corners."""
    mesh, corner = side.body.mesh, side.body.basis.nodal_dofs[0]
    placed = side.body.points + side.shape.reshape(-1, 2)
    quads = placed[corner[mesh.t.T]]
    ax.add_collection(PolyCollection(quads, facecolor="#dbe6f1", edgecolor=WALL, lw=0.25))
    ax.set_aspect("equal")
    ax.autoscale()
    ax.set(xlabel="mm", title=f"the finer solid at {100 * study.WATCHED[-1]:.0f} %")


def _errors(ax, rows):
    slender = [row.slenderness for row in rows]
    for name, color in SHOWN.items():
        for place, style in CURVES.items():
            label = f"{name}: {NAMES[place]}"
            errors = [row.errors[name][place] for row in rows]
            ax.plot(slender, errors, style, color=color, lw=1.4, ms=4, label=label)
    ax.axhline(0.0, color=VERMILION, lw=0.8)
    ax.set(xlabel="wall thickness / pitch", ylabel="%", title="off the finer solid, no contact")
    ax.legend(frameon=False, fontsize="x-small")
