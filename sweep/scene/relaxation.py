"""The relaxation of a material as branches: shares of the instantaneous stress, and their times.

With a measured loss the modulus falls as a power of time, E(t) = E(t_0) (t_0 / t)^beta, so that
slow and fast cycles lose the same share. As a sum over times tau_i, evenly spaced in ln tau by d,

    t^-beta = 1 / Gamma(beta) integral tau^-beta exp(-t / tau) d ln tau
            ~ sum of d tau_i^-beta / Gamma(beta) exp(-t / tau_i) + rest

where the rest stands for all slower branches. A strip is stretched evenly in a unit of time and
released evenly until its stress is zero, at the time t = k / (k - 1) with k = 2^(1 / (1 - beta)).
It loses

    loss = 2 - t^(2 - beta) + 2 (t - 1)^(2 - beta)

of the work: 2.8 beta where the loss is small, 2.4 beta near 0.4. (Linear viscoelasticity; the
spectrum of a power law: J. D. Ferry, Viscoelastic Properties of Polymers, 1980.)
"""

from functools import lru_cache
from math import gamma
from typing import NamedTuple

import numpy as np

from sweep.array_types import Floats
from sweep.config.kinds.material import Material

FASTEST, SLOWEST, BRANCHES = 1e-5, 1e3, 13  # s, s
MOST_BETA = 0.5


class Relaxation(NamedTuple):
    """shares (n,) of the instantaneous stress, times (n,) in s. instant: instantaneous modulus over
    the modulus at the reference time.
    """

    shares: Floats
    times: Floats
    instant: float


ELASTIC = Relaxation(np.empty(0), np.empty(0), 1.0)


def relaxation_of(material: Material) -> Relaxation:
    """The branches of a material; none if it is elastic."""
    if material.loss is not None:
        shares, times = power_law(exponent(material.loss))
    elif material.relaxation_times:
        shares, times = np.array([material.relaxation_shares, material.relaxation_times])
    else:
        return ELASTIC
    assert material.reference_time is not None
    left = 1.0 + float(shares @ np.expm1(-material.reference_time / times))
    return Relaxation(shares, times, 1.0 / left)


def lost_share(beta: float) -> float:
    """Share of the work that a strip with the exponent ``beta`` loses until its stress is zero."""
    k = 2.0 ** (1.0 / (1.0 - beta))
    t = k / (k - 1.0)
    return float(2.0 - t ** (2.0 - beta) + 2.0 * (t - 1.0) ** (2.0 - beta))


@lru_cache(maxsize=64)
def exponent(loss: float) -> float:
    """The exponent of a power law with the share ``loss`` of lost work."""
    from scipy.optimize import brentq

    return float(brentq(lambda beta: lost_share(beta) - loss, 0.0, MOST_BETA, xtol=1e-14))


def power_law(beta: float) -> tuple[Floats, Floats]:
    """Shares and times of the branches of a power law."""
    times = np.geomspace(FASTEST, SLOWEST, BRANCHES)
    spacing = np.log(times[1] / times[0])
    weights = spacing * times**-beta / gamma(beta)
    rest = (times[-1] * np.exp(0.5 * spacing)) ** -beta / (beta * gamma(beta))
    return weights / (weights.sum() + rest), times
