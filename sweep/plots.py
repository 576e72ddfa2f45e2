"""Pictures of one case: force against strain, where the energy is, and the shapes it goes through.

Functions draw into axes or figures that they are given. Lengths are drawn in mm, energies in mJ;
colours are Okabe and Ito's, which do not depend on telling red from green.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from itertools import cycle
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from matplotlib.figure import Figure
from matplotlib.patches import PathPatch, Rectangle
from matplotlib.path import Path as Outline
from matplotlib.ticker import LogLocator, NullFormatter

from sweep.silhouette import silhouette

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import SubFigure
    from pandas import DataFrame

BLUE, SKY, ORANGE, GREEN = "#0072b2", "#56b4e9", "#e69f00", "#009e73"
VERMILION, PURPLE, YELLOW, GREY = "#d55e00", "#cc79a7", "#f0e442", "#8a8a8a"
WALL, PLATEN = "#2b4c6f", "#c9c9c9"

ENERGIES = {
    "stretch_J": ("stretching", BLUE),
    "bend_J": ("bending", SKY),
    "contact_J": ("contact", ORANGE),
    "kinetic_J": ("motion", YELLOW),
    "dissipated_material_J": ("lost in the material", VERMILION),
    "dissipated_friction_J": ("lost to friction", PURPLE),
    "dissipated_integrator_J": ("lost by the time steps", GREY),
}
NEGLIGIBLE = 0.005  # share of the work below which an energy is not worth a colour
SHAPES = 6
AIRBORNE = 0.1  # of its height above its place at rest: a specimen there has jumped


def blank(width: float, height: float) -> Figure:
    """An empty figure (inches) that makes room for its labels."""
    return Figure(figsize=(width, height), layout="constrained")


def save(figure: Figure, path: Path) -> Path:
    """Write a figure as PNG."""
    path.parent.mkdir(parents=True, exist_ok=True)
    figure.savefig(path, dpi=160, facecolor="white")
    return path


def force_displacement(ax: Axes, history: DataFrame, row: Mapping[str, Any]) -> None:
    """Force on the platen against strain: the way down, the way back, and what lies beneath.

    history : as `read_history` gives it; row : the case's row of the summary.
    """
    strain, force = 100.0 * history["strain"], history["reaction_top_N"]
    turn = int(strain.argmax()) + 1
    ax.fill_between(strain[:turn], force[:turn], color=SKY, alpha=0.3, linewidth=0)
    ax.plot(strain[turn - 1 :], force[turn - 1 :], color=ORANGE, lw=1.6, ls="--", label="unloading")
    ax.plot(strain[:turn], force[:turn], color=BLUE, lw=2.2, label="loading")
    bottom = history["reaction_bottom_N"]
    if np.abs(bottom - force).max() > 0.02 * np.abs(force).max():
        ax.plot(strain, bottom, color=GREY, lw=0.9, zorder=1, label="on the support")
    _mark_plateau(ax, row)
    ax.set(xlabel="strain, %", ylabel="force, N")
    per_gram = row["specific_absorption_J_per_g"]
    ax.set_title(f"absorbs {1e3 * row['absorbed_energy_J']:.3g} mJ, {per_gram:.3g} J/g", loc="left")
    ax.set(xlim=(0.0, strain.max()), ylim=(min(0.0, force[:turn].min()), None))
    ax.legend(frameon=False, loc="upper left")
    scale = 10.0 * row["height_m"]  # mm of travel for one percent
    travel = ax.secondary_xaxis("top", functions=(lambda x: x * scale, lambda x: x / scale))
    travel.set_xlabel("travel of the top, mm")
    _plain(ax, top=True)


def _mark_plateau(ax: Axes, row: Mapping[str, Any]) -> None:
    """Height of the plateau up to densification, and the strain of the latter."""
    area = (row["width_m"] + row["wall_thickness_m"]) * row["depth_m"]
    plateau, packed = area * row["plateau_stress_Pa"], 100.0 * row["densification_strain"]
    if row["loading_mode"] != "displacement" or not np.isfinite(plateau + packed):
        return
    ax.plot([0.0, packed, packed], [plateau, plateau, 0.0], color="black", lw=1.0, ls=":")
    early = packed < 50.0 * row["peak_strain"]
    note: dict[str, Any] = {"textcoords": "offset points", "va": "top"}
    ax.annotate(f"plateau {plateau:.3g} N", (0.98 * packed, plateau), (0, -4), ha="right", **note)
    ax.annotate(
        f"densification\nat {packed:.0f} %",
        (packed, 0.4 * plateau),
        (4 if early else -4, 0),
        ha="left" if early else "right",
        **note,
    )


def energies(ax: Axes, history: DataFrame, row: Mapping[str, Any]) -> None:
    """Where the work done is: stored in the walls, moving, or lost, stacked in mJ.

    Against time for a dead load; otherwise against the way the platen has gone, down and back.
    """
    work = 1e3 * history["work_in_J"]
    if row["loading_mode"] == "displacement":
        way = 1e3 * history["top_displacement_m"].diff().abs().cumsum().fillna(0.0)
        ax.set_xlabel("path of the platen, down and back up, mm")
        ax.axvline(way[history["strain"].idxmax()], color="black", lw=1.0, ls=":")
    else:
        way = 1e3 * history["time_s"]
        ax.set_xlabel("time, ms")
    parts = {
        label: (1e3 * history[name], color)
        for name, (label, color) in ENERGIES.items()
        if history[name].abs().max() > NEGLIGIBLE * history["work_in_J"].abs().max()
    }
    values, colors = zip(*parts.values(), strict=True) if parts else ((), ())
    ax.stackplot(way, *values, colors=colors, labels=list(parts), linewidth=0)
    ax.plot(way, work, color="black", lw=1.4, label="work done")
    ax.set_ylabel("energy, mJ")
    ax.margins(x=0.0)
    ax.set_ylim(bottom=min(0.0, work.min()))
    handles, labels = ax.get_legend_handles_labels()
    ax.legend(handles[::-1], labels[::-1], frameon=False, loc="upper left", bbox_to_anchor=(1, 1))
    _plain(ax)


def deformed_shapes(
    fig: Figure | SubFigure, frames: Mapping[str, Any], times: bool = False
) -> None:
    """Six shapes in a row with walls as thick as they are: at even strains on the way down, then
    the last one; or, with `times`, at even times.

    frames : as `read_frames` gives them.
    """
    chosen = (
        _even_times(frames["time_s"], frames["strain"])
        if times
        else _even_strains(frames["strain"])
    )
    axes = fig.subplots(1, len(chosen), sharex=True, sharey=True, squeeze=False)[0]
    points, plates = 1e3 * frames["position_m"][chosen], 1e3 * frames["plate_y_m"][chosen]
    thickness = 1e3 * frames["edge_thickness_m"]
    ground = points[0, :, 1].min() - 0.5 * thickness.max()
    low, high = points.min((0, 1)) - thickness.max(), points.max((0, 1)) + thickness.max()
    room = 0.06 * (high - low).max()
    for ax, i, position, plate in zip(axes, chosen, points, plates, strict=True):
        loops = silhouette(position, frames["edges"], thickness)
        walls = Outline.make_compound_path(*(Outline(loop, closed=True) for loop in loops))
        ax.add_patch(PathPatch(walls, facecolor=WALL, edgecolor="none", snap=False))
        lower = ground if np.isnan(plate[0]) else plate[0]
        _platen(ax, (low[0], high[0]), lower - room, room)
        if np.isfinite(plate[1]):
            _platen(ax, (low[0], high[0]), plate[1], room)
        time = f"\n{1e3 * frames['time_s'][i]:.0f} ms" if times else ""
        ax.set_title(f"{100 * frames['strain'][i]:.0f} %{time}", fontsize="medium")
        ax.set_aspect("equal")
        ax.set_axis_off()
    below = min(low[1], ground - room) - room
    axes[0].set(xlim=(low[0], high[0]), ylim=(below, high[1] + room))
    _scale_bar(axes[0], low[0], below)


def absorption_map(fig: Figure, ranking: DataFrame) -> None:
    """Mass against absorbed energy, a panel a scene: colour = cells, sign = material.

    ranking : all places (`top=None`). The line joins the Pareto front, numbers are its walls in mm.
    """
    names = ranking.attrs
    of = "panel" if "panel_mass_g" in ranking else "specimen"
    for ax, rows in _scene_axes(fig, ranking):
        for (cells, color), (material, sign), points in _families(rows, ranking):
            mass, energy = points[names["mass"]], points[names["energy"]]
            ax.scatter(mass, energy, c=color, marker=sign, s=34, lw=0, label=f"{cells}, {material}")
        _pareto_front(ax, rows[rows["pareto"]].sort_values(names["mass"]), names)
        for budget in names["budgets_g"]:
            ax.axvline(budget, color=GREY, lw=1.0, ls=":")
        ax.margins(0.1)
        ax.set(xscale="log", yscale="log")
        ax.set(xlabel=f"mass of the {of}, g", ylabel=f"energy absorbed by the {of}, J")
        for axis in (ax.xaxis, ax.yaxis):
            axis.set_major_locator(LogLocator(subs=(1.0, 2.0, 5.0)))
            axis.set_major_formatter("{x:g}")
            axis.set_minor_formatter(NullFormatter())
    _legend(fig, "cells, material\nline: Pareto front, its walls in mm")


def _pareto_front(ax: Axes, front: DataFrame, names: Mapping[Any, Any]) -> None:
    """A line through rows in the order of their mass, each with a ring and its wall thickness."""
    mass, energy = front[names["mass"]], front[names["energy"]]
    ax.plot(mass, energy, color="black", lw=0.9, zorder=1)
    ax.scatter(mass, energy, s=70, lw=0.9, facecolor="none", edgecolor="black")
    note: dict[str, Any] = {"fontsize": "x-small", "textcoords": "offset points"}
    sides = cycle([((-5, 4), "right"), ((6, -9), "left")])  # turn about: neighbours may be close
    walls = 1e3 * front["wall_thickness_m"]
    for x, y, wall, (offset, align) in zip(mass, energy, walls, sides, strict=False):
        ax.annotate(f"{wall:.2g}", (x, y), offset, ha=align, **note)


def thickness_trends(fig: Figure, ranking: DataFrame) -> None:
    """Energy per gram against wall thickness, a panel a scene: colour = cells, sign = material."""
    per_gram = ranking.attrs["per_gram"]
    for ax, rows in _scene_axes(fig, ranking):
        for (cells, color), (material, sign), points in _families(rows, ranking):
            line = points.groupby("wall_thickness_m")[per_gram].max()
            style = "-" if sign == "o" else "--"
            ax.plot(1e3 * line.index, line, color=color, marker=sign, ms=5, ls=style,
                    label=f"{cells}, {material}")  # fmt: skip
        ax.set(xlabel="wall thickness, mm", ylabel="absorbed energy per gram, J/g")
        ax.set_ylim(bottom=0.0)
    _legend(fig, "cells, material")


def winners(fig: Figure, cases: Mapping[str, Mapping[str, Any]]) -> None:
    """Six shapes each of several cases, one below the other: what it is -> its frames."""
    strips = fig.subfigures(len(cases), 1, squeeze=False)[:, 0]
    for strip, (name, frames) in zip(strips, cases.items(), strict=True):
        strip.suptitle(name, x=0.01, ha="left", fontsize="medium")
        deformed_shapes(strip, frames)


def _scene_axes(fig: Figure, ranking: DataFrame) -> Iterator[tuple[Axes, DataFrame]]:
    """One set of axes a scene, at most three a row."""
    scenes = ranking.groupby("scene", sort=False)
    columns = min(3, len(scenes))
    rows = -(-len(scenes) // columns)
    axes = fig.subplots(rows, columns, squeeze=False).ravel()
    for ax in axes[len(scenes) :]:
        ax.remove()
    for ax, (scene, group) in zip(axes, scenes, strict=False):
        yield ax, group
        ax.set_title(scene, loc="left", fontsize="medium")
        ax.grid(color="#e6e6e6", lw=0.6)
        ax.set_axisbelow(True)
        _plain(ax)


def _families(rows: DataFrame, among: DataFrame) -> Iterator[tuple[Any, Any, DataFrame]]:
    """Rows of the same cells and material, with the colour and the sign of these among all."""
    cells = sorted({f"{x} x {y}" for x, y in zip(among["cells_x"], among["cells_y"], strict=True)})
    colors = dict(zip(cells, cycle([SKY, ORANGE, GREEN, VERMILION, BLUE, PURPLE]), strict=False))
    signs = dict(zip(sorted(among["material"].unique()), cycle("o^sDvP"), strict=False))
    for (x, y, material), points in rows.groupby(["cells_x", "cells_y", "material"]):
        yield (f"{x} x {y}", colors[f"{x} x {y}"]), (material, signs[material]), points


def _legend(fig: Figure, title: str) -> None:
    """One legend for all axes, to the right of them."""
    found: dict[str, Any] = {}
    for ax in fig.axes:
        handles, labels = ax.get_legend_handles_labels()
        found |= dict(zip(labels, handles, strict=True))
    fig.legend(found.values(), found.keys(), loc="outside right upper", frameon=False, title=title)


def _even_times(time: np.ndarray, strain: np.ndarray) -> list[int]:
    """Frames at even times, up to the moment when a released specimen jumps off its support."""
    airborne = np.flatnonzero(strain < -AIRBORNE)
    time = time[: airborne[0]] if len(airborne) else time
    wanted = np.linspace(time[0], time[-1], SHAPES)
    return list(dict.fromkeys(np.abs(time[:, None] - wanted).argmin(0).tolist()))


def _even_strains(strain: np.ndarray) -> list[int]:
    """Frames at even strains down to the greatest, then the last frame if it came back up."""
    deepest = int(np.argmax(strain))
    back = deepest < len(strain) - 1
    wanted = np.linspace(strain[0], strain[deepest], SHAPES - back)
    down = np.abs(strain[: deepest + 1, None] - wanted).argmin(0)
    return list(dict.fromkeys([*down.tolist(), *([len(strain) - 1] if back else [])]))


def _platen(ax: Axes, span: tuple[float, float], bottom: float, height: float) -> None:
    """A plate over the width of the picture, from `bottom` upwards."""
    left, right = span
    ax.add_patch(
        Rectangle((left, bottom), right - left, height, facecolor=PLATEN, edgecolor="none")
    )


def _scale_bar(ax: Axes, left: float, below: float) -> None:
    """A length of 5 mm under the first shape."""
    ax.plot([left, left + 5.0], [below, below], color="black", lw=1.5, clip_on=False)
    ax.annotate("5 mm", (left + 2.5, below), (0, -3), va="top", ha="center", fontsize="small",
                textcoords="offset points", annotation_clip=False)  # fmt: skip


def _plain(ax: Axes, top: bool = False) -> None:
    """Axes without a box."""
    ax.spines["right"].set_visible(False)
    ax.spines["top"].set_visible(top)
