"""Force, work, stop and rebound of a striker.

The rebound ends when the lattice no longer pushes the striker, which is then at its greatest
speed: after that a glued platen would hold the striker back. A run ends when the striker is back
where it met the lattice.
"""

from math import nan

import numpy as np

from sweep.config.case import Case
from sweep.config.kinds.impact import Impact
from sweep.design.network import relative_density
from sweep.scene.mesh import Floats
from sweep.scene.plates.scene import Scene as PlateScene
from sweep.scene.terms import Scene
from sweep.simulation.deceleration import filtered_peak

Curves = dict[str, Floats]
MEASURES = (
    "peak_deceleration_m_per_s2",
    "peak_deceleration_filtered_m_per_s2",
    "stroke_left_m",
    "rebound_speed_m_per_s",
    "rebound_share",
)


def striker_curves(time: Floats, velocity: Floats, mass: float) -> Curves:
    """History columns of a striker. time (rows,) s; velocity (rows,) m/s, upwards; mass in kg.

    The force is the mean since the previous row: force x time = change of momentum.
    """
    deceleration = np.append(0.0, np.diff(velocity) / np.diff(time))
    return {
        "reaction_top_N": mass * deceleration,
        "striker_speed_m_per_s": -velocity,
        "deceleration_m_per_s2": deceleration,
    }


def kinetic(loading: Impact, speed: Floats | float) -> Floats | float:
    """Kinetic energy of the striker alone, without the row glued to it, J."""
    return 0.5 * loading.striker_mass * speed**2


def work_on_lattice(case: Case, history: Curves) -> Floats:
    """Work done on the lattice so far, (rows,) J; in an impact, the energy lost by the striker."""
    if isinstance(case.loading, Impact):
        return history["work_in_J"] - kinetic(case.loading, history["striker_speed_m_per_s"])
    return history["work_in_J"]


def impact_columns(case: Case, scene: Scene | PlateScene, history: Curves) -> dict[str, float]:
    """The columns `MEASURES`; NaN without a striker.

    stroke_left_m: the stroke that closes all voids, minus the greatest stroke.
    """
    loading = case.loading
    if not isinstance(loading, Impact):
        return dict.fromkeys(MEASURES, nan)
    outer, rebound = case.lattice.outer_size, rebound_speed(history)
    height = case.height if case.along else outer[1]
    voids = (1.0 - relative_density(scene.network, outer)) * height
    left = voids - history["top_displacement_m"].max()
    share = kinetic(loading, rebound) / loading.energy
    peak = history["deceleration_m_per_s2"].max()
    velocity, passed = -history["striker_speed_m_per_s"], loading.filter_class
    filtered = filtered_peak(history["time_s"], velocity, passed)
    return dict(zip(MEASURES, map(float, (peak, filtered, left, rebound, share)), strict=True))


def rebound_speed(history: Curves) -> float:
    """Greatest speed upwards, m/s; zero if the striker never moves up."""
    return float(max(-history["striker_speed_m_per_s"].min(), 0.0))
