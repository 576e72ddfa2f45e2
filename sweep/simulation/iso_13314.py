"""The figures of ISO 13314, compression test for porous and cellular metals, from one crush.

Nominal stress over nominal strain, both positive. The plateau stress is the mean from 20 to 30 % or
from 20 to 40 % strain; the plateau ends where the stress is 1.3 times the latter mean. The energy
per volume W is the area below the curve up to 50 % strain or to the plateau end e, its efficiency W
/ (M e), with M the greatest stress up to e. The quasi-elastic gradient is the slope of the first
rise, here the secant between 20 and 70 % of the plateau stress, the stresses between which the
standard unloads and reloads for its elastic gradient.

Where the crush does not reach a strain or a stress, the figure is NaN.
"""

from math import nan

import numpy as np

from sweep.array_types import Floats

SHORT, LONG = (0.2, 0.3), (0.2, 0.4)  # strains of the two means
PLATEAU_END = 1.3  # ratio to the plateau stress
FIXED = 0.5  # strain up to which energies are compared
RISE = (0.2, 0.7)  # shares of the plateau stress
ROUND_OFF = 1e-9


def figures(strain: Floats, stress: Floats, density: Floats) -> dict[str, float]:
    """The columns of a crush by ISO 13314; stress, density (work per volume): (rows,) Pa."""
    plateau = mean_stress(strain, density, LONG)
    end = crossing(strain, stress, PLATEAU_END * plateau, LONG[0])
    fixed, whole = (absorbed(strain, stress, density, place) for place in (FIXED, end))
    return {
        "plateau_stress_iso_Pa": plateau,
        "plateau_stress_20_30_Pa": mean_stress(strain, density, SHORT),
        "plateau_end_strain": end,
        "quasi_elastic_gradient_Pa": gradient(strain, stress, plateau),
        "energy_to_50_J_per_m3": fixed[0],
        "efficiency_to_50": fixed[1],
        "energy_to_plateau_end_J_per_m3": whole[0],
        "efficiency_to_plateau_end": whole[1],
    }


def mean_stress(strain: Floats, density: Floats, between: tuple[float, float]) -> float:
    """Mean stress (Pa) between two strains; NaN if the crush is shorter."""
    start, end = between
    if strain[-1] < end - ROUND_OFF:
        return nan
    work = np.interp(between, strain, density)
    return float((work[1] - work[0]) / (end - start))


def crossing(strain: Floats, stress: Floats, level: float, after: float = 0.0) -> float:
    """The first strain beyond ``after`` where the stress rises to a level (Pa); NaN if it never
    does.
    """
    rises = (stress[:-1] < level) & (stress[1:] >= level)
    for row in np.flatnonzero(rises):
        place = float(np.interp(level, stress[row : row + 2], strain[row : row + 2]))
        if place >= after:
            return place
    return nan


def gradient(strain: Floats, stress: Floats, plateau: float) -> float:
    """Slope (Pa) of the first rise between two shares of the plateau stress (Pa)."""
    low, high = (crossing(strain, stress, share * plateau) for share in RISE)
    return (RISE[1] - RISE[0]) * plateau / (high - low) if high > low else nan


def absorbed(strain: Floats, stress: Floats, density: Floats, end: float) -> tuple[float, float]:
    """Work per volume (J/m^3) up to a strain, and its ratio to greatest stress x strain."""
    if not strain[-1] >= end - ROUND_OFF:
        return nan, nan
    work, last = (float(np.interp(end, strain, column)) for column in (density, stress))
    greatest = max(last, float(stress[strain <= end].max()))
    return work, work / (greatest * end) if greatest > 0.0 else nan
