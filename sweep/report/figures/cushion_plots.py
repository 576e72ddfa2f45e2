"""Energy-absorption diagrams (energy_absorption.png) and cushion curves (cushion_500mm.png)."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np
from pandas import DataFrame, Series, isna

from sweep.numbers import in_unit
from sweep.ranking.cushion import Crush, absorbed_below, cushion_curve, dropped_from, shoulder
from sweep.ranking.merit import doubtful
from sweep.ranking.scenes import ASSUMPTIONS
from sweep.report.figures.case_plots import legend, round_ticks
from sweep.report.figures.design_style import PLAIN, THIN, Looks, looks
from sweep.report.figures.ranking_plots import SHAPED, scene_axes

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

DESIGN = [
    *("lattice_kind", "infill_share", "cells_x", "cells_y", "wall_thickness_m", "width_m"),
    *("height_m", "depth_m", "material", "platen"),
]
LEVELS = 2000  # stresses at which an envelope is drawn
MARGIN = 0.8  # share of the first value in view: start of an axis
SHOWN = 30.0  # greatest / least value of an axis, seen from its interesting end
BEST: dict[str, Any] = {"s": 34.0, "edgecolor": "white", "lw": 0.6, "zorder": 3}
RING: dict[str, Any] = {"facecolor": "none", "zorder": 4}
ENVELOPE: dict[str, Any] = {"color": "black", "lw": 1.0, "ls": ":"}
MOST = {"marker": "", "label": "envelope: most energy"}


def absorption_diagram(fig: Figure, designs: DataFrame, crushes: Mapping[str, Crush]) -> None:
    """Energy per volume over greatest stress, a panel per scene and a curve per design.

    Both are divided by the modulus of the material, if the modulus of every design is known. The
    marker is at the shoulder, the greatest energy / stress. The dotted line is the most energy that
    any of the designs absorbs below a stress. crushes: by case id.
    """
    look, related = looks(designs), bool((designs["material_modulus_Pa"] > 0.0).all())
    for ax, rows in scene_axes(fig, designs):
        curves = [(row, _scaled(crush, row, related)) for row, crush in _crushed(rows, crushes)]
        for row, crush in curves:
            _curve(ax, crush.greatest, crush.work, look, rows.loc[[row.name]], shoulder(crush))
        stresses, most = envelope([crush for _, crush in curves])
        ax.plot(stresses, most, **ENVELOPE)
        ax.set(xscale="log", yscale="log")
        if curves:
            bottom = min(crush.work[-1] for _, crush in curves) / SHOWN
            ax.set_ylim(bottom=bottom)
            ax.set_xlim(MARGIN * min(c.greatest[c.work >= bottom].min() for _, c in curves))
            round_ticks(ax.xaxis)
            round_ticks(ax.yaxis)
        ax.set_xlabel("greatest stress / modulus" if related else "greatest stress, kPa")
        ax.set_ylabel("energy per volume / modulus" if related else "energy per volume, kJ/m³")
    legend(fig, [*look.legend(lines=True), _entry("shoulder"), PLAIN | ENVELOPE | MOST])


def cushion_diagram(
    fig: Figure,
    designs: DataFrame,
    crushes: Mapping[str, Crush],
    drop_height: float,
    falls: DataFrame,
) -> None:
    """Greatest deceleration over static stress of drops from a height (m), a panel per scene.

    The marker is at the least deceleration. falls: impacts in the results, from `drops`; rings
    mark drops of a design of the panel from this height.
    """
    look, rings = looks(designs), False
    near = falls[dropped_from(falls, drop_height)]
    for ax, rows in scene_axes(fig, designs):
        curves, peaks = [], []
        for row, crush in _crushed(rows, crushes):
            one, (static, peak) = rows.loc[[row.name]], cushion_curve(crush, drop_height)
            curves.append((in_unit(static, "kPa"), peak))
            best = int(np.argmin(peak))
            _curve(ax, *curves[-1], look, one, best if best < len(peak) - 1 else None)
            struck = same_design(near, row).dropna(subset="peak_G")
            _rings(ax, in_unit(struck["static_stress_Pa"], "kPa"), struck["peak_G"], look.of(one))
            peaks += list(struck["peak_G"])
        rings = rings or bool(peaks)
        title = f"{ax.get_title('left')},\ndropped from {drop_height:g} m"
        ax.set_title(title, loc="left", fontsize="medium")
        ax.set(xscale="log", yscale="log", ylabel="greatest deceleration, G")
        ax.set_xlabel("static stress, kPa")
        if curves:
            top = max(
                SHOWN * min(peak.min() for _, peak in curves), max(peaks, default=0.0) / MARGIN
            )
            ax.set_ylim(top=top)
            ax.set_xlim(
                MARGIN * min(static[peak <= top].min(initial=np.inf) for static, peak in curves)
            )
        round_ticks(ax.xaxis)
        round_ticks(ax.yaxis)
    struck_too = [PLAIN | {"mfc": "none", "label": "simulated impact"}] if rings else []
    legend(fig, [*look.legend(lines=True), _entry("least deceleration"), *struck_too])


def envelope(crushes: Sequence[Crush]) -> tuple[Any, Any]:
    """Stresses, and the most energy per volume that any crush absorbs below each, (n,)."""
    if not crushes:
        return np.zeros(0), np.zeros(0)
    low, high = min(c.greatest[0] for c in crushes), max(c.greatest[-1] for c in crushes)
    stresses = np.geomspace(low, high, LEVELS)
    return stresses, np.fmax.reduce([absorbed_below(crush, stresses) for crush in crushes])


def same_design(rows: DataFrame, design: Series) -> DataFrame:
    """The rows of other loadings with the design, material and platens of one row."""
    keys = [key for key in rows if key.startswith(SHAPED) and not key.startswith(ASSUMPTIONS)]
    keys = [key for key in (*DESIGN, *keys) if key in design.index]
    alike = [(rows[key] == design[key]) | (rows[key].isna() & isna(design[key])) for key in keys]
    return rows[np.logical_and.reduce(alike)]


def _crushed(rows: DataFrame, crushes: Mapping[str, Crush]) -> Iterator[tuple[Series, Crush]]:
    """The rows that have a crush in which energy was absorbed."""
    for _, row in rows.iterrows():
        if len((crush := crushes[row["case_id"]]).work):
            yield row, crush


def _scaled(crush: Crush, row: Series, related: bool) -> Crush:
    """Stress and energy per volume / modulus of the material, or in kPa and kJ/m^3."""
    if related:
        scale = 1.0 / row["material_modulus_Pa"]
        return crush._replace(greatest=scale * crush.greatest, work=scale * crush.work)
    greatest, work = in_unit(crush.greatest, "kPa"), in_unit(crush.work, "kJ/m^3")
    return crush._replace(greatest=greatest, work=work)


def _curve(ax: Axes, x: Any, y: Any, look: Looks, row: DataFrame, marked: int | None) -> None:
    """The curve of a design, as thick as its walls, dashed if doubtful, with its marker at a
    row.
    """
    style = look.of(row)
    dashes = "--" if doubtful(row).item() else "-"
    width = look.width(row["wall_thickness_m"].item())
    ax.plot(x, y, color=style["c"][0], lw=width, ls=dashes)
    if marked is not None:
        ax.scatter(x[marked], y[marked], c=style["c"], marker=style["marker"], **BEST)


def _rings(ax: Axes, x: Any, y: Any, style: dict[str, Any]) -> None:
    """Impacts of a design as open markers, twice as large as the markers of its walls in the
    legend.
    """
    area = float(style["s"][0])
    look = {"s": 2.0 * area, "lw": THIN * area**0.5, "marker": style["marker"]}
    ax.scatter(x, y, edgecolor=style["c"][0], **RING, **look)


def _entry(words: str) -> dict[str, Any]:
    """An entry of the legend for the meaning of markers."""
    return PLAIN | {"label": f"marker: {words}", "marker": ""}
