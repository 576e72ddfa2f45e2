"""Error of the load steps of a quasi-static crush, in the work that the platen does.

Two errors of a step d of the platen follow from the rows, as they do in the march, which makes
steps of an accuracy (`kernels.solve.load_step_error`): |F'' d^3| / 12 of the trapezoidal rule, with
F'' of the quadratic through three reactions; and (r1 - r0) d / 2 of friction, whose normal forces
are estimated before the step, with r its dissipation / d. The first errors add up; the second ones
change their sign from step to step, and the root of the sum of their squares is taken. How well
that tells steps that are too long is in docs/accuracy.md.
"""

from collections.abc import Mapping
from math import inf, nan

import numpy as np

from sweep.config.case import Case
from sweep.config.kinds.crush import Crush
from sweep.scene.mesh import Floats

STEPS = 3  # the fewest in which a curve of force has two second derivatives


def load_step_error(case: Case, loading: Mapping[str, Floats]) -> float:
    """Estimated error of the load steps in the work of a crush / that work; loading: its rows.

    NaN of other loadings and without work, infinite with fewer steps than `STEPS`.
    """
    if not (isinstance(case.loading, Crush) and case.loading.quasi_static):
        return nan
    travel = np.abs(loading["top_displacement_m"])
    moved = np.r_[True, travel[1:] > np.maximum.accumulate(travel)[:-1]]
    travel, force = travel[moved], loading["reaction_top_N"][moved]
    step, work = np.diff(travel), abs(float(np.trapezoid(force, travel)))
    if len(step) < STEPS:
        return inf
    if work == 0.0:
        return nan
    slope = np.diff(force) / step
    friction = np.diff(loading["dissipated_friction_J"][moved]) / step
    bend = 2.0 * np.diff(slope) / (step[1:] + step[:-1])
    curved = np.abs(bend) * step[1:] ** 3 / 12.0
    lagged = np.diff(friction) * step[1:] / 2.0
    return float(curved.sum() + np.sqrt(np.sum(lagged**2))) / work
