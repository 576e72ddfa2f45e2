"""Pictures of a case: force, energies, shapes; and functions shared by all pictures.

The functions draw into the figures or axes of their arguments. Lengths are in mm. The colours of
Okabe and Ito can be distinguished without distinguishing red from green.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from pathlib import Path
from textwrap import fill
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
from matplotlib.collections import PolyCollection
from matplotlib.colors import LinearSegmentedColormap
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import PathPatch, Polygon, Rectangle
from matplotlib.path import Path as Outline
from matplotlib.text import Text
from matplotlib.ticker import LogLocator, MaxNLocator, NullFormatter
from matplotlib.transforms import Bbox, ScaledTranslation
from pandas import DataFrame

from sweep.design.silhouette import silhouette
from sweep.loading_modes import MODES
from sweep.numbers import energy_text, in_unit, scaled, tenths, three_digits, to_si
from sweep.report.figures import shaded
from sweep.report.figures.storyboard import (
    PARTS,
    crushes,
    headline,
    last_loaded,
    path_of,
    shots,
    stacked,
    turns,
)  # fmt: skip
from sweep.report.outlines import outlines
from sweep.whole_file import whole

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.backend_bases import RendererBase
    from matplotlib.figure import SubFigure

BLUE, SKY, ORANGE = "#0072b2", "#56b4e9", "#e69f00"
VERMILION, PURPLE, YELLOW, GREY = "#d55e00", "#cc79a7", "#f0e442", "#8a8a8a"
WALL, PLATEN, GRID = "#2b4c6f", "#c9c9c9", "#e6e6e6"

SHADES = LinearSegmentedColormap.from_list("walls", shaded.COLOURS)
COLORS = dict(zip(PARTS, (BLUE, SKY, ORANGE, YELLOW, VERMILION, PURPLE, GREY), strict=True))
PANEL, GAP = 1.9, 0.1  # inches: longer side of the picture of a shape; gap between two pictures
ENTRY, SIGN = 0.22, 0.6  # inches: height of an entry of a legend; width of its sign
LETTER, LINE = 0.075, 0.2  # inches: width of a letter of a title; height of a line
FITS = 0.97  # share of the planned scale of shapes that the layout leaves them
POWER = "$\\mathdefault{10^{"  # in labels of log axes
SAME_ENERGY = 0.03  # relative difference of an area and the energy that it represents
TICKS = 3  # least number of labels of a log axis
ROUND = ((1.0,), (1.0, 3.0), (1.0, 2.0, 5.0), (1.0, 1.5, 2.0, 3.0, 5.0, 7.0))  # x powers of ten


class Literal(Figure):
    """A figure that shows names literally: a dollar sign in them does not begin a formula."""

    def draw(self, renderer: RendererBase) -> None:
        """Draw it."""
        for text in self.findobj(Text):
            text.set_parse_math(POWER in text.get_text())
        super().draw(renderer)


def blank(width: float, height: float) -> Figure:
    """An empty figure (inches) with a layout that adapts to its labels."""
    return Literal(figsize=(width, height), layout="constrained")


def save(figure: Figure, path: Path) -> Path:
    """Write a figure as PNG."""
    with whole(path) as file:
        figure.savefig(file, dpi=160, facecolor="white")
    return path


def footnote(figure: Figure, words: str) -> None:
    """Write lines below everything in a figure, if there are any."""
    if words:
        letters = int(figure.get_figwidth() / LETTER)
        text = "\n".join(fill(line, letters) for line in words.splitlines())
        figure.supxlabel(text, x=0.01, ha="left", fontsize="small")


def force_displacement(ax: Axes, history: DataFrame, row: Mapping[str, Any]) -> None:
    """Force on the top over strain: loading, unloading, and the work below the curve as an area.

    history: from `read_history`; row: of the case in the summary. A dead load appears and
    disappears within one step. Between loose platens its travel exceeds the approach of the rows of
    nodes, as it compresses both contacts: then the absorbed energy is not the area.
    """
    strain, force = in_unit(history["strain"], "%"), history["reaction_top_N"]
    turn = released = last_loaded(history, row)
    ended = len(history) - 1
    if MODES[row["loading_mode"]].driven:
        turn, released, ended = crushes(history)[0]
    down, pause, back = slice(turn + 1), slice(turn, released + 1), slice(released, ended + 1)
    dead, absorbed = MODES[row["loading_mode"]].dead, row["absorbed_energy_J"]
    share = row["returned_energy_J"] / absorbed
    returned = "pulled back" if share < 0.0 else f"returns {tenths(share)} %"
    words = ("load applied", "load removed") if dead else ("loading", f"unloading,\n{returned}")
    style: Any = "steps-pre" if dead else "default"
    sky: dict[str, Any] = {"color": SKY, "alpha": 0.3, "lw": 0, "step": "pre" if dead else None}
    whole, below = f"absorbed energy\n{_energy(absorbed, row)}", _below(history[down], dead)
    is_whole = abs(below - absorbed) < SAME_ENERGY * absorbed
    more = f"force x shortening\n{energy_text(below)}; {whole},\nwith contact at the platens"
    ax.fill_between(strain[down], force[down], label=whole if is_whole else more, **sky)
    ax.plot(strain[down], force[down], drawstyle=style, color=BLUE, lw=2.2, label=words[0])
    if released > turn:
        ax.plot(strain[pause], force[pause], color=VERMILION, lw=1.6, label="hold")
    if released + 1 < len(history):
        dashes: dict[str, Any] = {"color": ORANGE, "lw": 1.6, "ls": "--", "drawstyle": style}
        ax.plot(strain[back], force[back], label=words[1], **dashes)
    if ended + 1 < len(history):
        again = slice(ended, None)
        ax.plot(strain[again], force[again], color=PURPLE, lw=1.0, label="further cycles")
    bottom = history["reaction_bottom_N"]
    if np.abs(bottom - force).max() > 0.02 * np.abs(force).max():
        ax.plot(strain, bottom, color=GREY, lw=1.0, zorder=1, label="on the support")
    _until_densification(ax, row)
    ax.set(xlabel="strain, %", ylabel="force, N")
    ax.set_title(headline(row), loc="left", fontsize="medium")
    ax.set(xlim=(0.0, 1.02 * strain.max()), ylim=(min(0.0, force[down].min()), None))
    scale = in_unit(to_si(row["height_m"], "%"), "mm")  # mm of travel for one percent
    travel = ax.secondary_xaxis("top", functions=(lambda x: x * scale, lambda x: x / scale))
    travel.set_xlabel("travel, mm")
    ax.legend(frameon=False, loc="upper left", bbox_to_anchor=(1, 1))
    plain(ax, top=True)


def _below(history: DataFrame, dead: bool) -> float:
    """Work (J) of the force on the top over the displacement of the top."""
    force, travel = history["reaction_top_N"].to_numpy(), history["top_displacement_m"].to_numpy()
    mean = force[1:] if dead else 0.5 * (force[1:] + force[:-1])
    return float(mean @ np.diff(travel))


def _until_densification(ax: Axes, row: Mapping[str, Any]) -> None:
    """The mean force until densification, with the energy as the area below it.

    If the efficiency still rises at full stroke, there is no densification.
    """
    strain, energy = row["packing_strain"], row["absorbed_energy_until_packed_J"]
    if not (MODES[row["loading_mode"]].driven and strain > 0.0):
        return
    mean, end = energy / (strain * row["height_m"]), tenths(strain)
    densified = np.isfinite(row["densification_strain"])
    until = f"usable until densification\nat {end} %:"
    at = until if densified else f"no densification; usable to {end} %:"
    stairs = [0.0, *[in_unit(strain, "%")] * 2], [mean, mean, 0.0]
    label = f"{at} {_energy(energy, row)},\nmean force {three_digits(mean)} N"
    ax.plot(*stairs, color="black", lw=1.0, ls=":", label=label)


def _energy(joules: float, row: Mapping[str, Any]) -> str:
    """An energy of a case, in total and per gram."""
    grams = row["mass_g"] if np.isnan(row["printed_mass_g"]) else row["printed_mass_g"]
    return f"{energy_text(joules)}, {three_digits(joules / grams)} J/g"


def energies(ax: Axes, history: DataFrame, row: Mapping[str, Any]) -> None:
    """The parts of the work done, stacked, in J or mJ: stored, kinetic, dissipated.

    Over the path of a driven platen, down and back; otherwise over time.
    """
    total, words, parts = stacked(history, row)
    factor, unit = scaled("J", total.max())
    work, values = factor * total, factor * parts.to_numpy().T
    place, label = path_of(history, row)
    ax.set_xlabel(label)
    for at, turn in turns(history, row).items():
        mark(ax, place[at], turn, after=turn.startswith("cycle"))
    colors, labels = [COLORS[name] for name in parts], [PARTS[name] for name in parts]
    ax.stackplot(place, *values, colors=colors, labels=labels, linewidth=0)
    ax.plot(place, work, color="black", lw=1.4, label=words)
    ax.set_ylabel(f"energy, {unit}")
    ax.set_title(headline(row), loc="left", fontsize="medium")
    ax.margins(x=0.0, y=0.1)
    ax.set_ylim(bottom=min(0.0, work.min()))
    handles, labels = ax.get_legend_handles_labels()
    ax.legend(handles[::-1], labels[::-1], frameon=False, loc="upper left", bbox_to_anchor=(1, 1))
    plain(ax)


class View(NamedTuple):
    """The region shown in the picture of each shape of a case, in mm.

    ground: surface of the support; margin: also the height of a drawn platen.
    """

    left: float
    right: float
    below: float
    top: float
    ground: float
    margin: float


def _view(frames: Mapping[str, Any], chosen: list[int]) -> View:
    """The view that contains the chosen frames, their platens, and a striker as far as it is no
    higher than the lattice.
    """
    if "quads" in frames:
        return _view_of_plates(frames, chosen)
    points, drawn = in_unit(frames["position_m"][chosen], "mm"), np.unique(frames["edges"])
    plates = in_unit(frames["plate_y_m"][chosen], "mm")
    thickness = in_unit(frames["edge_thickness_m"].max(), "mm")
    ground = points[0, drawn, 1].min() - 0.5 * thickness
    low, high = (end(points[:, drawn], (0, 1)) for end in (np.min, np.max))
    low, high = low - thickness, high + thickness
    margin = 0.06 * (high - low).max()
    tall = [np.ptp(shape[:, 1]) for shape in outlines(frames)[1]]
    above = min(tall[0], np.ptp(points[0, drawn, 1])) if tall else margin
    top = max(high[1], np.nanmax(plates, initial=high[1]) + above)
    below = min(low[1], ground - margin) - margin
    return View(low[0] - margin, high[0] + margin, below, top, ground, margin)


def _view_of_plates(frames: Mapping[str, Any], chosen: list[int]) -> View:
    """The view of plates from the camera; ground: height of the lower platen."""
    points = in_unit(np.asarray(frames["position_m"][chosen], float), "mm")
    margin = 0.03 * float(np.ptp(points[0], axis=0).max())
    plates = [
        shaded.platen(_extent(frames), in_unit(float(height), "mm"), margin)
        for height in frames["plate_y_m"][chosen].ravel()
    ]
    screen = np.concatenate([shaded.seen(points)[0].reshape(-1, 2), *plates])
    (left, below), (right, top) = screen.min(axis=0) - margin, screen.max(axis=0) + margin
    ground = in_unit(float(frames["plate_y_m"][chosen[0], 0]), "mm")
    return View(left, right, below - margin, top, ground, margin)


def _extent(frames: Mapping[str, Any]) -> np.ndarray:
    """Least and greatest x and y of plates at rest, (2, 2) mm."""
    plan = in_unit(np.asarray(frames["position_m"][0], float)[:, :2], "mm")
    return np.stack([plan.min(axis=0), plan.max(axis=0)])


def shapes_scale(frames: Mapping[str, Any], release: float | None = None) -> float:
    """Scale of the shapes of a picture, inches / mm."""
    view = _view(frames, list(dict(shots(frames, release))))
    return PANEL / max(view.right - view.left, view.top - view.below)


def shapes_size(
    title: str,
    frames: Mapping[str, Any],
    release: float | None = None,
    scale: float | None = None,
) -> tuple[float, float]:
    """Width and height (inches) of a figure that the shapes fill; scale: from `shapes_scale`."""
    chosen = dict(shots(frames, release))
    view = _view(frames, list(chosen))
    width, height = view.right - view.left, view.top - view.below
    scale = scale or shapes_scale(frames, release)
    lines = 3 + max(words.count("\n") for words in chosen.values())  # also title and scale bar
    row = len(chosen) * (scale * width + GAP)
    return max(row, LETTER * len(title)), scale * height + LINE * lines + GAP


def shapes_figure(title: str, frames: Mapping[str, Any], release: float | None) -> Figure:
    """A figure of the size of its `deformed_shapes`."""
    figure = blank(*shapes_size(title, frames, release))
    deformed_shapes(figure, title, frames, release)
    return figure


def deformed_shapes(
    fig: Figure | SubFigure, title: str, frames: Mapping[str, Any], release: float | None = None
) -> None:
    """Up to six shapes in a row, chosen by `shots`, with walls of their true thickness."""
    chosen = dict(shots(frames, release))
    axes = fig.subplots(1, len(chosen), sharex=True, sharey=True, squeeze=False)[0]
    fig.suptitle(title, x=0.01, ha="left", fontsize="medium")
    view = _view(frames, list(chosen))
    points, plates = (
        in_unit(frames[name][list(chosen)], "mm") for name in ("position_m", "plate_y_m")
    )
    for ax, caption, position, plate in zip(axes, chosen.values(), points, plates, strict=True):
        _shape(ax, view, frames, position, plate)
        ax.set_title(caption, fontsize="medium")
    axes[0].set(xlim=(view.left, view.right), ylim=(view.below, view.top))
    _scale_bar(axes[0], view.left, view.below)


def one_shape(ax: Axes, frames: Mapping[str, Any], number: int) -> None:
    """The shape of this number, in a view that contains all shapes."""
    view = _view(frames, list(range(len(frames["strain"]))))
    position, plate = (in_unit(frames[name][number], "mm") for name in ("position_m", "plate_y_m"))
    _shape(ax, view, frames, position, plate)
    ax.set(xlim=(view.left, view.right), ylim=(view.below, view.top))
    _scale_bar(ax, view.left, view.below)


def _shape(ax: Axes, view: View, frames: Mapping[str, Any], position: Any, plate: Any) -> None:
    """Walls of their true thickness, and the platens or the profiles in their place; position (n,
    2) and plate (2,) in mm.
    """
    if "quads" in frames:
        _plates(ax, view, frames, position, plate)
        return
    walls(ax, position, frames)
    below, above = outlines(frames)
    for shapes, height in ((below, plate[0]), (above, plate[1])):
        for shape in shapes:
            moved = shape + np.array([0.0, height])
            ax.add_patch(Polygon(moved, facecolor=PLATEN, edgecolor="none"))
    carried = np.isfinite([plate[0], frames["strain"][0]]).any() and not np.isinf(plate[0])
    if carried and not below:
        _platen(ax, view, (view.ground if np.isnan(plate[0]) else plate[0]) - view.margin)
    if np.isfinite(plate[1]) and not above:
        _platen(ax, view, plate[1])


def walls(ax: Axes, position: np.ndarray, frames: Mapping[str, Any]) -> None:
    """Draw the walls of a case, of true thickness, with nodes at ``position`` (n, 2) in mm; plates
    (n, 3) as shaded surfaces.
    """
    if "quads" in frames:
        surfaces(ax, position, frames["quads"])
        return
    loops = silhouette(position, frames["edges"], in_unit(frames["edge_thickness_m"], "mm"))
    outline = Outline.make_compound_path(*(Outline(loop, closed=True) for loop in loops))
    ax.add_patch(PathPatch(outline, facecolor=WALL, edgecolor="none", snap=False))
    ax.set_aspect("equal")
    ax.set_axis_off()


def surfaces(ax: Axes, position: np.ndarray, quads: np.ndarray) -> None:
    """Draw plates as shaded surfaces without thickness; position (n, 3) in mm."""
    faces = shaded.faces(position, quads)
    colours = SHADES(faces.shades)
    edges = np.append(0.8 * colours[:, :3], colours[:, 3:], axis=1)
    drawn = PolyCollection(list(faces.corners), facecolors=colours, edgecolors=edges, lw=0.15)
    ax.add_collection(drawn)
    ax.set_aspect("equal")
    ax.set_axis_off()


def _plates(ax: Axes, view: View, frames: Mapping[str, Any], position: Any, plate: Any) -> None:
    """Plates on the lower platen, and the outline of the upper one."""
    box = _extent(frames)
    low, high = (shaded.platen(box, float(height), view.margin) for height in plate)
    ax.add_collection(PolyCollection([low], facecolors=PLATEN, edgecolors="none"))
    surfaces(ax, position, frames["quads"])
    ax.add_collection(PolyCollection([high], facecolors="none", edgecolors=GREY, lw=0.8))


def beside(ax: Axes, inches: float, bottom: float, height: float) -> Axes:
    """New axes that begin ``inches`` left of ``ax``, from ``bottom`` on, in its unit of y."""
    left = ScaledTranslation(-inches, 0.0, ax.figure.dpi_scale_trans)
    inset = ax.inset_axes((0.0, bottom, 1.0, height), transform=ax.get_yaxis_transform() + left)
    inset.set_anchor("W")
    return inset


def winners(fig: Figure, cases: Mapping[str, Mapping[str, Any]]) -> None:
    """Six shapes of each of several cases, one case below another, all at the same scale.

    cases: title -> frames. The size of the figure is set.
    """
    scale = min(map(shapes_scale, cases.values()))
    sizes = (shapes_size(*case, scale=scale) for case in cases.items())
    widths, heights = zip(*sizes, strict=True)
    fig.set_size_inches(max(widths), sum(heights))
    strips = fig.subfigures(len(cases), 1, squeeze=False, height_ratios=heights)[:, 0]
    for strip, (name, frames) in zip(strips, cases.items(), strict=True):
        deformed_shapes(strip, name, frames)
        for ax in strip.axes:
            ax.set_axes_locator(_to_scale(FITS * scale))


def _to_scale(scale: float) -> Callable[[Axes, Any], Bbox]:
    """A locator that draws axes at a scale (inches / mm), in the middle of their place."""

    def box(ax: Axes, _: Any) -> Bbox:
        place, pixels = ax.get_position(original=True), np.array(ax.figure.bbox.size)
        spans = [high - low for low, high in (ax.get_xlim(), ax.get_ylim())]
        size = scale * np.array(spans) * ax.figure.dpi / pixels
        return Bbox.from_bounds(*(0.5 * (place.min + place.max - size)), *size)

    return box


def legend(fig: Figure, entries: list[dict[str, Any]], below: bool = False) -> None:
    """One legend for all axes, to the right of them, in as many columns as needed, or in a row
    below them.

    Every column after the first widens the figure.
    """
    handles = [Line2D([], [], **entry) for entry in entries]
    if below and handles:
        fig.legend(handles=handles, loc="outside lower right", frameon=False, ncols=len(handles))
        return
    width, height = fig.get_size_inches()
    columns = -(-len(handles) // int(height / ENTRY))
    if handles:
        longest = max(len(entry["label"]) for entry in entries)
        fig.set_size_inches(width + (columns - 1) * (SIGN + LETTER * longest), height)
        fig.legend(handles=handles, loc="outside right upper", frameon=False, ncols=columns)


def mark(ax: Axes, x: float, words: str, after: bool = False) -> None:
    """A vertical dotted line at `x`, with `words` at its upper end, before it or after it."""
    ax.axvline(x, color=GREY, lw=1.0, ls=":")
    side, shift = ("left", 3) if after else ("right", -3)
    ax.annotate(words, (x, 1.0), (shift, -2), xycoords=ax.get_xaxis_transform(), ha=side, va="top",
                textcoords="offset points", fontsize="small", color="#555555")  # fmt: skip


def round_ticks(axis: Any) -> None:
    """Ticks of a log axis at round numbers, with at least `TICKS` of them in view."""
    low, high = axis.get_view_interval()
    for locator in (*(LogLocator(subs=subs) for subs in ROUND), MaxNLocator(2 * TICKS)):
        axis.set_major_locator(locator)
        places = locator.tick_values(low, high)
        if ((low <= places) & (places <= high)).sum() >= TICKS:
            break
    axis.set_major_formatter("{x:g}")
    axis.set_minor_formatter(NullFormatter())


def _platen(ax: Axes, view: View, bottom: float) -> None:
    """A plate over the width of the picture, from `bottom` upwards."""
    width = view.right - view.left
    plate = Rectangle((view.left, bottom), width, view.margin, facecolor=PLATEN, edgecolor="none")
    ax.add_patch(plate)


def _scale_bar(ax: Axes, left: float, below: float) -> None:
    """A length of 5 mm under the first shape."""
    ax.plot([left, left + 5.0], [below, below], color="black", lw=1.5, clip_on=False)
    ax.annotate("5 mm", (left + 2.5, below), (0, -3), va="top", ha="center", fontsize="small",
                textcoords="offset points", annotation_clip=False)  # fmt: skip


def plain(ax: Axes, top: bool = False) -> None:
    """Axes without a box."""
    ax.spines["right"].set_visible(False)
    ax.spines["top"].set_visible(top)
