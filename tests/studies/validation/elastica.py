"""Inextensible elastica in elliptic integrals (Bisshopp & Drucker 1945; Love 1927, art. 262)."""

import numpy as np
from scipy.optimize import brentq
from scipy.special import ellipeinc, ellipk, ellipkinc


def cantilever(size: float) -> tuple[float, float, float]:
    """Drop and shortening of the end over L, and its slope, under a dead load P L^2 / Y I."""
    k = np.sqrt(size)

    def start(p: float) -> float:
        return float(np.arcsin(1.0 / (p * np.sqrt(2.0))))

    def excess(p: float) -> float:
        return float(ellipk(p * p) - ellipkinc(start(p), p * p) - k)

    p = brentq(excess, np.sqrt(0.5) * (1.0 + 1e-12), 1.0 - 1e-12, xtol=1e-15)
    first = start(p)
    slope = np.arcsin(2.0 * p * p - 1.0)
    ends = [ellipeinc(angle, p * p) for angle in (0.5 * np.pi, first)]
    drop = 1.0 - 2.0 / k * (ends[0] - ends[1])
    return float(drop), float(1.0 - np.sqrt(2.0 * np.sin(slope)) / k), float(slope)


def deflection(load: float) -> float:
    """Greatest deflection over L of a column under a ``load`` > 1 times its Euler load.

    p / K(p) with 2 K / pi = sqrt(load), whether both ends are hinged or both are clamped.
    """
    k = 0.5 * np.pi * np.sqrt(load)
    p = brentq(lambda p: ellipk(p * p) - k, 0.0, 1.0 - 1e-15, xtol=1e-15)
    return float(p / k)
