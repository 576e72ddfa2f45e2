"""Errors of the load steps of a quasi-static crush, in the work that the platen does and in a peak
of its force.

The march estimates the error of each step (`kernels.solve.load_step_error`); here the rows of a
crush are judged as a whole. In the work, with steps d of the platen:

    |F''| d^3 / 12      of the trapezoidal rule, with F'' of the quadratic through three reactions
    (r1 - r0) d / 2     of friction, whose forces r are estimated before the step: dissipation / d

The first errors add up; the second ones change their sign from step to step, and the root of the
sum of their squares is taken. docs/accuracy.md compares the sum with true errors.

Walls that relax resist at the speed at which they buckle, and are soft at once afterwards: a peak
between two rows, of which the curve shows only the flanks. It lies above the greatest row F by no
more than the force still rose in the step before it; and, as the force falls the faster the nearer
it is to the peak, by about twice what it falls in the step after it. The estimate is the lesser of
the two. It is next to nothing where walls are elastic, which go on at the force at which they
buckle, or snap after a slow rise.

In a step that is too long, walls that relax also buckle too early, with a smooth peak. That shows
in the rows that rise to it, by |(a1' - a0') a1'| d, a force: the third part of the error of the
march / d, with energies a^2. It is not weighted here, as no step is chosen by it.
"""

from collections.abc import Mapping, Sequence
from math import inf, nan

import numpy as np
from numpy.typing import NDArray

from sweep.array_types import Floats
from sweep.config.case import Case
from sweep.config.kinds.crush import Crush

STORED = "stretch_J", "bend_J", "contact_J"
STEPS = 3  # the fewest in which a curve of force has two second derivatives


def load_step_error(case: Case, loading: Mapping[str, Floats]) -> float:
    """Estimated error of the load steps in the work of a crush / that work; loading: its rows.

    NaN of other loadings and without work, infinite with fewer steps than `STEPS`.
    """
    if not _is_static(case):
        return nan
    travel, moved = _advance(loading)
    force = loading["reaction_top_N"][moved]
    step, work = np.diff(travel), abs(float(np.trapezoid(force, travel)))
    if len(step) < STEPS:
        return inf
    if work == 0.0:
        return nan
    slope = np.diff(force) / step
    friction = np.diff(loading["dissipated_friction_J"][moved]) / step
    second_derivative = 2.0 * np.diff(slope) / (step[1:] + step[:-1])
    curved = np.abs(second_derivative) * step[1:] ** 3 / 12.0
    lagged = np.diff(friction) * step[1:] / 2.0
    return float(curved.sum() + np.sqrt(np.sum(lagged**2))) / work


def peak_step_error(case: Case, loading: Mapping[str, Floats]) -> float:
    """Estimated error of the load steps in a peak that no force before it exceeds / that peak: the
    greatest of all such peaks, 0 without one; loading: its rows. NaN of other loadings.
    """
    if not _is_static(case):
        return nan
    travel, moved = _advance(loading)
    force = np.fmax(loading["reaction_top_N"], loading["reaction_bottom_N"])[moved]
    if len(force) < STEPS:
        return 0.0
    before, peak, after = force[:-2], force[1:-1], force[2:]
    is_greatest = peak > np.maximum.accumulate(np.fmax(before, 0.0))
    step, rise, is_peak = np.diff(travel), peak - before, is_greatest & (after < peak)
    missed = np.minimum(rise * step[1:] / step[:-1], 2.0 * (peak - after))
    error = float((missed[is_peak] / peak[is_peak]).max(initial=0.0))
    if case.material.relaxes:
        stored = [loading[name][moved] for name in STORED]
        early = _of_relaxation(step, stored) / step
        rising = early[:-1] / _next_peak(peak, is_peak)
        error = max(error, float(rising[is_greatest].max(initial=0.0)))
    return error


def _next_peak(force: Floats, is_peak: NDArray[np.bool_]) -> Floats:
    """The force at the next peak from each row on; after the last one, the greatest force."""
    peaks = np.append(force[is_peak], force.max())
    return peaks[np.searchsorted(np.flatnonzero(is_peak), np.arange(len(force)))]


def _of_relaxation(step: Floats, stored: Sequence[Floats]) -> Floats:
    """Sum |(a1' - a0') a1'| d^2 of steps d (m), for stored energies a^2 (J). The first step, which
    has no a0', takes the value of the second one.
    """
    error = np.zeros_like(step)
    for energy in stored:
        slope = np.diff(np.sqrt(np.fmax(energy, 0.0))) / step
        error[1:] += np.abs(np.diff(slope) * slope[1:]) * step[1:] ** 2
    error[0] = error[1]
    return error


def _is_static(case: Case) -> bool:
    return isinstance(case.loading, Crush) and case.loading.quasi_static


def _advance(loading: Mapping[str, Floats]) -> tuple[Floats, NDArray[np.bool_]]:
    """Travel at the rows that are farther than all before, and which these are."""
    travel = np.abs(loading["top_displacement_m"])
    moved = np.r_[True, travel[1:] > np.maximum.accumulate(travel)[:-1]]
    return travel[moved], moved
