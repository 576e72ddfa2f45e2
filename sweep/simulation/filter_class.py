"""Forces and decelerations of an impact as a drop test reports them: filtered by a channel
frequency class.

SAE J211-1 and ISO 6487: channel frequency class CFC passes frequencies up to CFC in Hz. The filter
is a two-pole Butterworth with a corner at 2.0775 CFC (Hz), run forwards and backwards so that
nothing is delayed: 3 dB are lost at 5/3 CFC. Samples must not be farther apart than 1 / (10 CFC).

Without a filter the greatest force is of single walls that snap or touch, for some 30 us, and
depends on the time step (docs/accuracy.md).
"""

from math import ceil, nan

import numpy as np

from sweep.config.kinds.striker import SAMPLES
from sweep.scene.mesh import Floats

CORNER = 2.0775  # corner over the class, Hz
RINGING = 5.0  # times 1 / corner after which the filter has settled
ROUND_OFF = 1e-9


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
    if len(time) < 2:
        return force
    even = evenly(time)
    step = float(even[1] - even[0])
    if 2.0 * CORNER * filter_class * step >= 1.0:
        return force
    return np.interp(time, even, filtered(np.interp(even, time, force), step, filter_class, ends))


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
