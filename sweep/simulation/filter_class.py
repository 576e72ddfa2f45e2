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

from sweep.config.kinds.impact import SAMPLES
from sweep.scene.mesh import Floats

CORNER = 2.0775  # corner over the class, Hz
RINGING = 5.0  # times 1 / corner after which the filter has settled
ROUND_OFF = 1e-9


def filtered_peak(time: Floats, total: Floats, filter_class: int) -> float:
    """Greatest slope of a quantity behind a filter of a class; NaN if rows are too far apart.

    time (rows,) s; total (rows,): a velocity for the deceleration, an impulse for the force.
    """
    longest = float(np.diff(time).max(initial=0.0))
    if not 0.0 < longest * SAMPLES * filter_class <= 1.0 + ROUND_OFF:
        return nan
    span = float(time[-1] - time[0])
    even = np.linspace(time[0], time[-1], ceil(span / longest * (1.0 - ROUND_OFF)) + 1)
    step = span / (len(even) - 1)
    slope = np.diff(np.interp(even, time, total)) / step
    return float(filtered(slope, step, filter_class).max())


def filtered(signal: Floats, step: float, filter_class: int) -> Floats:
    """A signal (n,), sampled every ``step`` (s), behind a filter of a class.

    Before its start the signal is 0, as nothing touches the striker; after its end it keeps its
    last value.
    """
    from scipy.signal import butter, sosfiltfilt

    corner = CORNER * filter_class
    around = ceil(RINGING / (corner * step))
    padded = np.concatenate([np.zeros(around), signal, np.full(around, signal[-1])])
    passed = sosfiltfilt(butter(2, corner, fs=1.0 / step, output="sos"), padded, padlen=0)
    return passed[around : around + len(signal)]
