"""Chooses the contents of the pictures of a case: its shapes, with captions, and its energies."""

from collections.abc import Mapping
from textwrap import fill
from typing import Any

import numpy as np
from pandas import DataFrame, Series

from sweep.array_types import Floats
from sweep.columns import ALONG
from sweep.design.slicer.patterns import is_sheet
from sweep.loading_modes import MODES
from sweep.numbers import in_unit, text_in
from sweep.ranking.scenes import scene_label

INTEGRATOR = "dissipated_integrator_J"
GAINED = " + gained in load or time steps"
PARTS = {
    "stretch_J": "stretching",
    "bend_J": "bending",
    "contact_J": "contact",
    "kinetic_J": "motion",
    "dissipated_material_J": "lost in the material",
    "dissipated_friction_J": "lost to friction",
    INTEGRATOR: "lost in snap-through, in steps",
}
"""Columns of a history that add up to the work done, in words."""

NEGLIGIBLE = 0.005  # share of the work below which energies are not drawn
SHAPES = 6
TITLE = 80  # most letters in a line of a title
RELEASED = 0.01  # below this strain a specimen counts as released
ROUND_OFF = 1e-12
FLOWN = 0.5  # share of its height: a specimen lifted farther is not drawn


def headline(row: Mapping[str, Any]) -> str:
    """Design and scene of a case, each on lines of its own; row: its row of the summary."""
    return "\n".join(fill(part, TITLE, break_on_hyphens=False) for part in design_and_scene(row))


def design_and_scene(row: Mapping[str, Any]) -> tuple[str, str]:
    """Design and scene of a case in words."""
    pattern, cells = row["lattice_kind"], f", {row['cells_x']} x {row['cells_y']} cells"
    if pattern == "custom" or "." in pattern or is_sheet(pattern):  # a drawing is named by its file
        cells = ""
    if row["infill_share"] > 0.0:  # NaN without a slicer
        cells = f", {text_in(row['infill_share'], '%', 3)} infill"
    wall = f"wall {text_in(row['wall_thickness_m'], 'mm', 3)}"
    along = row["direction"] == ALONG
    if is_sheet(pattern):
        wall += f", {'along' if along else 'across'} its print axis"
    elif along:
        wall += ", along its cells"
    return f"{pattern}{cells}, {wall}, {row['material']}", scene_label(DataFrame([row]))


def last_loaded(history: DataFrame, row: Mapping[str, Any]) -> int:
    """Number of the last row of a history before the platen turns or the dead load is removed."""
    mode = MODES[row["loading_mode"]]
    if mode.dead:
        return int(np.flatnonzero(history["reaction_top_N"]).max(initial=0))
    if mode.probed:
        return len(history) - 1
    return _turn(history["strain"].to_numpy())


def turns(history: DataFrame, row: Mapping[str, Any]) -> dict[int, str]:
    """Rows of a history at which the loading turns, in words: in each of its cycles the platen
    turns, and the next cycle begins; a dead load is removed; a striker stops.
    """
    turn, last = last_loaded(history, row), len(history) - 1
    mode = MODES[row["loading_mode"]]
    if not mode.driven:
        return {turn: mode.turn} if turn < last else {}
    marks = dict[int, str]()
    for number, (_, released, ended) in enumerate(crushes(history), 2):
        marks |= {released: mode.turn, ended: f"cycle {number}"}
    return {at: words for at, words in marks.items() if at < last}


def crushes(history: DataFrame) -> list[tuple[int, int, int]]:
    """Rows of a crush at which the platen reaches its full stroke, leaves it, after a pause if
    there is one, and has moved back up, or up as far as it goes; for every cycle.
    """
    strain = history["strain"].to_numpy()
    top = np.flatnonzero(strain >= (1.0 - ROUND_OFF) * np.nanmax(strain))
    parts = np.split(top, np.flatnonzero(np.diff(top) > 1) + 1)
    turned, released = [int(part[0]) for part in parts], [int(part[-1]) for part in parts]
    until = [*turned[1:], len(strain)]
    ended = [at + int(strain[at:end].argmin()) for at, end in zip(released, until, strict=True)]
    return list(zip(turned, released, ended, strict=True))


def stacked(history: DataFrame, row: Mapping[str, Any]) -> tuple[Series, str, DataFrame]:
    """The sum of the energies of a case (J), in words, and its `PARTS` that are not negligible,
    none negative.

    The sum is the work done; energy gained by time integration is no part of the work, but added to
    it.
    """
    greatest, total = history[["work_in_J", *PARTS]].abs().max(), MODES[row["loading_mode"]].total
    parts = [name for name in PARTS if greatest[name] > NEGLIGIBLE * greatest["work_in_J"]]
    gain = -np.minimum(history[INTEGRATOR], 0.0)
    total += GAINED if INTEGRATOR in parts and gain.any() else ""
    return history["work_in_J"] + gain, total, np.maximum(history[parts], 0.0)


def path_of(history: DataFrame, row: Mapping[str, Any]) -> tuple[Series, str]:
    """Abscissa of the energies of a case, and its label: path of a driven platen, or time."""
    if MODES[row["loading_mode"]].driven:
        travel = history["top_displacement_m"].diff().abs().cumsum().fillna(0.0)
        return in_unit(travel, "mm"), "platen travel, down and up, mm"
    return in_unit(history["time_s"], "ms"), "time, ms"


def shots(frames: Mapping[str, Any], release: float | None = None) -> list[tuple[int, str]]:
    """Frames to draw, with captions: at even strains of the first loading, then the last one of the
    last unloading.

    frames: from `read_frames`; release: time (s) at which a dead load is removed. Frames of a
    structure without strain are at even times.
    """
    strain, time = frames["strain"], frames["time_s"]
    if np.isnan(strain).all():
        return [(i, f"{time[i]:.3g} s") for i in dict.fromkeys(_even(time, SHAPES))]
    turn = _turn(strain) if release is None else int((time <= release).sum()) - 1
    stood = standing(frames["position_m"], turn + 1)
    back = [turn + stood] if stood else []
    count = SHAPES - len(back) - (release is not None)
    down = sorted({*_even(strain[: turn + 1], count), turn})
    free = release is not None or strain[-1] < RELEASED
    captions = {i: text_in(strain[i], "%", 2) for i in [*down, *back]}
    captions |= dict.fromkeys(back if free else [], "released")
    clock = "" if release is None else "\n{:.0f} ms"
    return [(i, text + clock.format(in_unit(time[i], "ms"))) for i, text in captions.items()]


def _turn(strain: Floats) -> int:
    """Number of the first row at the greatest strain, which later cycles reach again."""
    return int((strain >= (1.0 - ROUND_OFF) * np.nanmax(strain)).argmax())


def _even(strain: Floats, count: int) -> list[int]:
    """Frames nearest to evenly spaced strains up to the greatest."""
    targets = np.linspace(strain[0], strain.max(), count)
    frames: list[int] = np.abs(strain[:, None] - targets).argmin(0).tolist()
    return frames


def standing(position: Floats, first: int = 0) -> int:
    """Number of frames, from the ``first`` one on, before the specimen has lifted off; position (f,
    n, 2), or (f, n, 3) for plates: the last coordinate is upwards.
    """
    height = position[..., -1]
    lifted = height[first:].min(axis=1) - height[0].min() > FLOWN * np.ptp(height[0])
    return int(np.append(lifted, True).argmax())
