"""Load on the base: force and pressure on a patch, impulse, and the motion of a base that moves
freely.
"""

from math import nan

import numpy as np

from sweep.array_types import Floats
from sweep.config.case import Case
from sweep.config.kinds.custom_loading import CustomLoading
from sweep.config.kinds.impact import Impact
from sweep.simulation.filter_class import filtered_force
from sweep.simulation.striker import Curves, rebound
from sweep.simulation.time_resolution import peak_row

OF_A_HIT = ("base_impulse_Ns", "target_speed_m_per_s", "peak_target_acceleration_m_per_s2")


def patch_width(case: Case) -> float:
    """Width (m) of the patch of the base on which pressure is measured; at most the width of the
    lattice.
    """
    loading = case.loading
    return nan if isinstance(loading, CustomLoading) else min(loading.base_patch, case.footprint[0])


def base_columns(case: Case, history: Curves) -> dict[str, float]:
    """The columns of the base: greatest pressure and its place, impulse, motion of the target."""
    loading, pressure = case.loading, history["base_pressure_Pa"]
    row = None if np.isnan(pressure).any() else peak_row(loading, pressure)
    columns = {
        "peak_base_pressure_Pa": nan if row is None else float(pressure[row]),
        "peak_base_pressure_x_m": nan if row is None else float(history["base_pressure_x_m"][row]),
        "indentation_m": float(history["top_displacement_m"].max()),
    } | dict.fromkeys(OF_A_HIT, nan)
    return columns | (hit_columns(loading, history) if isinstance(loading, Impact) else {})


def force_on_support(loading: Impact, history: Curves) -> Floats:
    """Force of an impact on the support behind its filter, (rows,) N; in the end it bears the
    weight.
    """
    time, force = history["time_s"], history["reaction_bottom_N"]
    return filtered_force(time, force, loading.filter_class, (0.0, loading.weight))


def hit_columns(loading: Impact, history: Curves) -> dict[str, float]:
    """Impulse on the base until the rebound of the striker; speed of the target at that time, and
    its greatest acceleration, filtered; NaN if the base is fixed.
    """
    force, row = history["reaction_bottom_N"], rebound(loading, history).row
    impulse = np.sum(force[1 : row + 1] * np.diff(history["time_s"][: row + 1]))
    columns = {"base_impulse_Ns": float(impulse)}
    if loading.target_mass is None:
        return columns
    greatest = float(force_on_support(loading, history).max())
    return columns | {
        "target_speed_m_per_s": float(history["target_speed_m_per_s"][row]),
        "peak_target_acceleration_m_per_s2": greatest / loading.target_mass,
    }
