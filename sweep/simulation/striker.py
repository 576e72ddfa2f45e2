"""Force, work, stop and rebound of a striker.

An accelerometer on the striker measures the force of the lattice on it / its mass, dv/dt + g with
gravity: 0 in free fall, 1 g0 at rest on the lattice. This is the G of a drop test, peak force /
weight (ASTM D1596), and it is reported as the deceleration.

A base that moves (`loading.target_mass`) takes part in the motion: stroke, stop and rebound
describe the striker relative to the base, with the reduced mass; the energy of the common motion of
striker and base after the hit is neither absorbed nor returned.

The striker stops at its lowest point. Its rebound ends when the lattice no longer pushes it: its
mechanical energy, m v^2 / 2 - m g s after a descent s, is then greatest on the way up. Later a
glued platen would hold it back. A run ends when the striker is back where it met the lattice, when
its weight has brought it down again and it has stopped at a smaller depth than before, or when
without weight all energy is spent: walls that are damped far more than critically would take
thousands of times as long to push it back.
"""

from collections.abc import Mapping
from math import nan
from typing import NamedTuple

import numpy as np

from sweep.array_types import Floats
from sweep.config.case import Case
from sweep.config.kinds.dead_load import DeadLoad
from sweep.config.kinds.impact import Impact
from sweep.config.kinds.striker import WithStriker
from sweep.scene.plates.scene import Scene as PlateScene
from sweep.scene.scene import Scene
from sweep.simulation.filter_class import filtered_peak
from sweep.simulation.solid import filled

Curves = Mapping[str, Floats]
MEASURES = (
    "peak_deceleration_m_per_s2",
    "peak_deceleration_filtered_m_per_s2",
    "stroke_left_m",
    "bottomed_out",
    "rebound_speed_m_per_s",
    "rebound_share",
)


SWING = 0.1  # share of the stroke by which a striker comes down again
SPENT = 1e-4  # share of the energy of a striker that may be left when the impact is over
STILL = 1e-3  # of the stroke; a stopping striker moves by 1 % in the last tenth of its way down


class Rebound(NamedTuple):
    """The rebound of a striker from the base, or its state in the last row if it does not rebound.

    speed: away from the base, m/s. energy: mechanical energy relative to the base, J; 0 at rest at
    first touch. row: of the history.
    """

    speed: float
    energy: float
    row: int


def closing_speed(history: Curves) -> Floats:
    """Speed at which the striker approaches the base, (rows,) m/s."""
    return history["striker_speed_m_per_s"] - history["target_speed_m_per_s"]


def against_falling(loading: Impact, time: Floats, velocity: Floats) -> Floats:
    """Velocity (rows,) of the striker upwards in a frame that falls freely, m/s.

    Its slope is the force of the lattice on the striker / its mass.
    """
    return velocity + loading.weight / loading.striker_mass * time


def striker_curves(
    loading: Impact, time: Floats, velocity: Floats, of_base: Floats
) -> dict[str, Floats]:
    """History columns of a striker. time (rows,) s; velocity, of_base (rows,) m/s, upwards.

    The force is the mean since the previous row: (force - weight) x time = change of momentum.
    """
    pushed = against_falling(loading, time, velocity)
    deceleration = np.append(0.0, np.diff(pushed) / np.diff(time))
    return {
        "reaction_top_N": loading.striker_mass * deceleration,
        "striker_speed_m_per_s": -velocity,
        "target_speed_m_per_s": -of_base,
        "deceleration_m_per_s2": deceleration,
    }


def kinetic(loading: Impact, history: Curves) -> Floats:
    """Kinetic energy of striker and base, without the rows glued to them, (rows,) J."""
    striker, base = history["striker_speed_m_per_s"], history["target_speed_m_per_s"]
    return 0.5 * (loading.striker_mass * striker**2 + (loading.target_mass or 0.0) * base**2)


def work_on_lattice(case: Case, history: Curves) -> Floats:
    """Work done on the lattice so far, (rows,) J; in an impact, by striker, weight and base."""
    if isinstance(case.loading, Impact):
        return history["work_in_J"] - kinetic(case.loading, history)
    return history["work_in_J"]


def striker_columns(
    case: Case, scene: Scene | PlateScene, history: Curves, stroke: float
) -> dict[str, float]:
    """The columns `MEASURES`: the stroke left for a dead load between platens and for any striker
    but a platen, on a flat base, as a lattice also bends between ribs; the others for an impact;
    NaN for the rest. stroke: the greatest, m.
    """
    loading = case.loading
    columns = dict.fromkeys(MEASURES, nan)
    on_ribs = isinstance(loading, WithStriker) and loading.base == "ribs"
    shaped = isinstance(loading, WithStriker) and loading.striker != "flat"
    pressed = isinstance(loading, DeadLoad) and loading.platen != "none"
    if not on_ribs and (shaped or pressed or isinstance(loading, Impact)):
        columns |= stroke_columns(case, scene, stroke)
    return columns | (hit_columns(loading, history) if isinstance(loading, Impact) else {})


def stroke_columns(case: Case, scene: Scene | PlateScene, stroke: float) -> dict[str, float]:
    """stroke_left_m: the stroke that closes all voids, minus the greatest stroke; bottomed_out:
    whether no stroke is left.
    """
    outer = case.lattice.outer_size
    height = case.height if case.shells else outer[1]
    voids = (1.0 - filled(case, scene)) * height
    left = float(voids - stroke)
    return {"stroke_left_m": left, "bottomed_out": float(left <= 0.0)}


def hit_columns(loading: Impact, history: Curves) -> dict[str, float]:
    """Deceleration and rebound of a striker that flies."""
    thrown = rebound(loading, history)
    peak = history["deceleration_m_per_s2"].max()
    time, velocity = history["time_s"], -history["striker_speed_m_per_s"]
    pushed = against_falling(loading, time, velocity)
    filtered = filtered_peak(
        time, pushed, loading.filter_class, loading.weight / loading.striker_mass
    )
    return {
        "peak_deceleration_m_per_s2": float(peak),
        "peak_deceleration_filtered_m_per_s2": float(filtered),
        "rebound_speed_m_per_s": thrown.speed,
        "rebound_share": max(thrown.energy, 0.0) / loading.relative_energy,
    }


def rebound(loading: Impact, history: Curves) -> Rebound:
    """The rebound of a striker; a striker that never moves up stays at its lowest place."""
    speed, travel = closing_speed(history), history["top_displacement_m"]
    moving = 0.5 * loading.reduced_mass * speed**2
    energy = np.where(speed < 0.0, moving - loading.weight * travel, -np.inf)
    row = int(energy.argmax())
    if speed[row] >= 0.0:
        return Rebound(0.0, -loading.weight * float(travel.max()), len(speed) - 1)
    return Rebound(-float(speed[row]), float(energy[row]), row)


def brought(loading: Impact, history: Curves) -> float:
    """Energy of the striker relative to the base at first touch, plus the work of its weight until
    it stops, J.
    """
    return loading.relative_energy + loading.weight * float(history["top_displacement_m"].max())


def second_stop(heights: Floats) -> int | None:
    """The row at which a striker stops again at a smaller depth, if it does. heights (rows,) m.

    It has come down again by a share `SWING` of its stroke: vibrating walls are no second stop.
    """
    lowest = int(heights.argmin())
    after = heights[lowest:]
    sunk, moves = np.maximum.accumulate(after) - after, np.diff(after)
    turned = (moves[:-1] < 0.0) & (moves[1:] >= 0.0)
    stops = np.flatnonzero(turned & (sunk[1:-1] >= SWING * (heights[0] - heights[lowest])))
    return lowest + int(stops[0]) + 1 if len(stops) else None


def spent(rows: np.ndarray) -> int | None:
    """The row at which striker and lattice have no more than a share `SPENT` of the energy left, if
    they do, while the striker moves up slower than before; rows (rows,) of `rows.ROW`.
    """
    left = rows["kinetic"] + rows["stretch"] + rows["bend"] + rows["contact"]
    fastest = int(rows["speed"].argmax())
    if rows["speed"][fastest] <= 0.0:
        return None
    after = np.flatnonzero(left[fastest + 1 :] <= SPENT * rows["work"].max())
    return fastest + 1 + int(after[0]) if len(after) else None


def rests(history: Curves) -> bool:
    """Whether a striker hardly moves in the last tenth of a run, by a share `STILL` of its stroke.

    Under its weight it may come to rest on the lattice without moving up.
    """
    time, travel = history["time_s"], history["top_displacement_m"]
    moved = travel[-1] - np.interp(0.9 * time[-1], time, travel)
    return bool(abs(moved) <= STILL * travel.max())
