"""Limit of values at decreasing sizes: observed order and Richardson extrapolation."""

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from sweep.array_types import Floats

ORDERS = np.linspace(0.5, 4.5, 4001)  # orders that can be observed
ALIKE = 0.5  # least cosine between two consecutive changes of values that converge


class Limit(NamedTuple):
    """Result of an extrapolation.

    correction (k,): limit - finest value. order: the observed one; NaN if none is observed. doubt:
    uncertainty of the limit, rms: of the correction, or without an order the greater of the last
    two changes.
    """

    correction: Floats
    order: float
    doubt: float


def limit(sizes: Sequence[float], values: Sequence[Floats]) -> Limit:
    """Limit of values, (k,) each, at decreasing sizes, with value = limit + c size^p."""
    changes = np.diff(values, axis=0)
    order = observed_order(sizes, changes)
    if np.isnan(order):
        return Limit(np.zeros_like(values[-1]), order, max(map(rms, changes[-2:])))
    coarse, fine = sizes[-2] ** order, sizes[-1] ** order
    correction = changes[-1] * fine / (coarse - fine)
    return Limit(correction, order, rms(correction))


def observed_order(sizes: Sequence[float], changes: Floats) -> float:
    """Order p of the last three values; NaN if they, or the three before, show no order."""
    orders = [
        _order(sizes[k : k + 3], *changes[k : k + 2])
        for k in range(max(len(sizes) - 4, 0), len(sizes) - 2)
    ]
    return orders[-1] if orders and np.isfinite(orders).all() else np.nan


def _order(sizes: Sequence[float], first: Floats, second: Floats) -> float:
    """The p with |first| / |second| = (s0^p - s1^p) / (s1^p - s2^p), which increases with p."""
    if not first @ second > ALIKE * np.sqrt((first @ first) * (second @ second)):
        return np.nan
    s0, s1, s2 = (np.asarray(size) ** ORDERS for size in sizes)
    rates = (s0 - s1) / (s1 - s2)
    rate = rms(first) / rms(second)
    return float(np.interp(rate, rates, ORDERS, left=np.nan, right=np.nan))


def rms(values: Floats) -> float:
    """Root mean square."""
    return float(np.sqrt(np.mean(np.square(values))))
