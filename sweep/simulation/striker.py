"""What a striker does to a lattice and the lattice to it: force, work, stop and rebound.

The striker leaves when the lattice pushes it no more: it is fastest then. A glued one would be held
back from there on, which is no rebound; a run ends when it is back where it met the lattice.
"""

from math import nan

import numpy as np

from sweep.config.case import Case, given
from sweep.design.network import relative_density
from sweep.scene.mesh import Floats
from sweep.scene.terms import Scene

Curves = dict[str, Floats]
MEASURES = (
    "peak_deceleration_m_per_s2",
    "stroke_left_m",
    "rebound_speed_m_per_s",
    "rebound_share",
)


def striker_curves(time: Floats, velocity: Floats, case: Case) -> Curves:
    """History columns of a striker from its velocity upwards (rows,) m/s at these times (rows,) s.

    The force is the mean since the row before: force x time = change of momentum. Rows may be
    closer than the time step that was asked for, as whole steps fill the duration.
    """
    deceleration = np.append(0.0, np.diff(velocity) / np.diff(time))
    return {
        "reaction_top_N": given(case.loading.striker_mass) * deceleration,
        "striker_speed_m_per_s": -velocity,
        "deceleration_m_per_s2": deceleration,
    }


def kinetic(case: Case, speed: Floats | float) -> Floats | float:
    """Energy of the striker alone, without what is glued to it, J."""
    return 0.5 * given(case.loading.striker_mass) * speed**2


def work_on_lattice(case: Case, history: Curves) -> Floats:
    """Work done on the lattice so far, (rows,) J: of an impact, what the striker has lost."""
    if case.loading.mode == "impact":
        return history["work_in_J"] - kinetic(case, history["striker_speed_m_per_s"])
    return history["work_in_J"]


def impact_columns(case: Case, scene: Scene, history: Curves) -> dict[str, float]:
    """The columns `MEASURES`; NaN without a striker.

    The stroke left is what remains at the stop of the height that closes all voids.
    """
    if case.loading.mode != "impact":
        return dict.fromkeys(MEASURES, nan)
    lattice, rebound = case.lattice, rebound_speed(history)
    voids = (1.0 - relative_density(scene.network, lattice.outer_size)) * lattice.outer_size[1]
    left = voids - history["top_displacement_m"].max()
    share = kinetic(case, rebound) / given(case.loading.energy)
    peak = history["deceleration_m_per_s2"].max()
    return dict(zip(MEASURES, map(float, (peak, left, rebound, share)), strict=True))


def rebound_speed(history: Curves) -> float:
    """Greatest speed upwards, m/s; zero if the striker has not turned."""
    return float(max(-history["striker_speed_m_per_s"].min(), 0.0))
