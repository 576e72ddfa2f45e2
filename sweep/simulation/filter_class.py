"""Forces and decelerations of an impact as a drop test reports them: filtered by a channel
frequency class.

SAE J211-1 and ISO 6487: channel frequency class CFC passes frequencies up to CFC in Hz. The filter
is a two-pole Butterworth with a corner at 2.0775 CFC (Hz), run forwards and backwards so that
nothing is delayed: 3 dB are lost at 5/3 CFC. Samples must not be farther apart than 1 / (10 CFC).

Without a filter the greatest force is of single walls that snap or touch, for some 30 us, and
depends on the time step (docs/accuracy.md).
"""

from collections.abc import Mapping
from math import ceil, nan
from typing import Any

import numpy as np

from sweep.array_types import Floats
from sweep.constants import FILTER_CLASS, SAMPLES

CORNER = 2.0775  # corner over the class, Hz
RINGING = 5.0  # times 1 / corner after which the filter has settled
ROUND_OFF = 1e-9
WAVES = 2.0  # least waves that the filter of a stroke passes


def filtered_peak(time: Floats, velocity: Floats, filter_class: int, after: float = 0.0) -> float:
    """Greatest deceleration (m/s^2) behind a filter of a class; NaN if rows are too far apart.

    time (rows,) s; velocity (rows,) m/s, upwards; after: deceleration after the last row.
    """
    longest = float(np.diff(time).max(initial=0.0))
    if not 0.0 < longest * SAMPLES * filter_class <= 1.0 + ROUND_OFF:
        return nan
    even = evenly(time)
    step = float(even[1] - even[0])
    deceleration = np.diff(np.interp(even, time, velocity)) / step
    return float(filtered(deceleration, step, filter_class, (0.0, after)).max())


def filtered_force(
    time: Floats, force: Floats, filter_class: float, ends: tuple[float, float]
) -> Floats:
    """A force behind a filter of a class, (rows,) N. time (rows,) s; force (rows,) N; ends:
    the force before the first row and after the last one.

    Unfiltered where rows are so far apart that the corner is not below half of their frequency.
    """
    if len(time) < 2 or not time[-1] > time[0]:
        return force
    even = evenly(time)
    step = float(even[1] - even[0])
    if 2.0 * CORNER * filter_class * step >= 1.0:
        return force
    return np.interp(time, even, filtered(np.interp(even, time, force), step, filter_class, ends))


def without_blows(curve: Mapping[str, Any]) -> dict[str, Floats]:
    """The reactions of a crush with a speed behind a filter, (rows,) N each; curve: its history.

    A platen that starts at full speed hits the lattice with a force that grows without bound as
    time steps get shorter. The filter has class 1000, or passes `WAVES` waves in the stroke if that
    is more. What follows the first loading starts with a blow too, and is filtered by itself.
    """
    time, travel = (np.asarray(curve[name], float) for name in ("time_s", "top_displacement_m"))
    rows = int(np.argmax(travel >= travel.max() * (1.0 - ROUND_OFF))) + 1
    stroke = float(time[rows - 1] - time[0])
    passed = max(FILTER_CLASS, WAVES / stroke) if stroke > 0.0 else FILTER_CLASS
    filtered_curves = {}
    for name in ("reaction_top_N", "reaction_bottom_N"):
        force = np.asarray(curve[name], float)
        full, last = float(force[rows - 1]), float(force[-1])
        loading = filtered_force(time[:rows], force[:rows], passed, (0.0, full))
        later = filtered_force(time[rows:], force[rows:], passed, (full, last))
        filtered_curves[name] = np.concatenate([loading, later])
    return filtered_curves


def evenly(time: Floats) -> Floats:
    """Times at an even distance, as long as the longest between rows (rows,), s."""
    longest = float(np.diff(time).max())
    span = float(time[-1] - time[0])
    return np.linspace(time[0], time[-1], ceil(span / longest * (1.0 - ROUND_OFF)) + 1)


def filtered(signal: Floats, step: float, filter_class: float, ends: tuple[float, float]) -> Floats:
    """A signal (n,), sampled every ``step`` (s), behind a filter of a class.

    ends: its values before its start and after its end.
    """
    from scipy.signal import butter, sosfiltfilt

    corner = CORNER * filter_class
    around = ceil(RINGING / (corner * step))
    padded = np.concatenate([np.full(around, ends[0]), signal, np.full(around, ends[1])])
    passed = sosfiltfilt(butter(2, corner, fs=1.0 / step, output="sos"), padded, padlen=0)
    return passed[around : around + len(signal)]
