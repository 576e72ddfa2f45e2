"""Deceleration of a striker as a drop test reports it: filtered by a channel frequency class.

SAE J211-1 and ISO 6487: channel frequency class CFC passes frequencies up to CFC in Hz. The filter
is a two-pole Butterworth with a corner at 2.0775 CFC (Hz), run forwards and backwards so that
nothing is delayed: 3 dB are lost at 5/3 CFC. Samples must not be farther apart than 1 / (10 CFC).
"""

from math import ceil, nan

import numpy as np

from sweep.scene.mesh import Floats

CORNER = 2.0775  # corner over the class, Hz
SAMPLES = 10.0  # least samples per second / class
RINGING = 5.0  # times 1 / corner after which the filter has settled
ROUND_OFF = 1e-9


def filtered_peak(time: Floats, velocity: Floats, filter_class: int) -> float:
    """Greatest deceleration (m/s^2) behind a filter of a class; NaN if rows are too far apart.

    time (rows,) s; velocity (rows,) m/s, upwards.
    """
    longest = float(np.diff(time).max(initial=0.0))
    if not 0.0 < longest * SAMPLES * filter_class <= 1.0 + ROUND_OFF:
        return nan
    span = float(time[-1] - time[0])
    even = np.linspace(time[0], time[-1], ceil(span / longest * (1.0 - ROUND_OFF)) + 1)
    step = span / (len(even) - 1)
    deceleration = np.diff(np.interp(even, time, velocity)) / step
    return float(filtered(deceleration, step, filter_class).max())


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
