"""Divides curves into straight pieces: Bezier curves of degree 1 to 3, to which DXF and SVG are
reduced.
"""

from collections.abc import Iterable
from math import ceil, comb, radians

import numpy as np
from numpy.typing import NDArray

from sweep.config.faults import MisfitError

Floats = NDArray[np.float64]

TURN = radians(12.0)  # turn of one straight piece, within 0.6 % of the radius: 32 in a circle
SAMPLES = np.linspace(0.0, 1.0, 65)  # points at which the direction of a curve is taken
MOST_LINES = 20_000


def straightened(curves: Iterable[Floats]) -> Floats:
    """Straight pieces (s, 2, 2) of Bezier curves, each with 2 to 4 control points (k, 2)."""
    pieces: list[Floats] = []
    count = 0
    for curve in curves:
        if not np.isfinite(curve).all():
            raise MisfitError("has coordinates that are no finite numbers")
        at = _points(curve)
        pieces.append(np.stack([at[:-1], at[1:]], axis=1))
        count += len(pieces[-1])
        if count > MOST_LINES:
            raise MisfitError(f"more than {MOST_LINES:,} straight lines, or pieces of curves")
    return np.concatenate(pieces) if pieces else np.empty((0, 2, 2))


def _points(curve: Floats) -> Floats:
    """Points of a curve between which it turns evenly, by at most `TURN`; only its ends if it is
    straight.
    """
    if len(curve) == 2:
        return curve
    slope = _at(np.diff(curve, axis=0), SAMPLES)
    slope = slope[np.linalg.norm(slope, axis=1) > 1e-9 * np.ptp(curve)]
    turned = np.abs(np.diff(np.unwrap(np.arctan2(slope[:, 1], slope[:, 0]))))
    total = np.concatenate([[0.0], np.cumsum(turned)])
    count = ceil(total[-1] / TURN - 1e-6) if len(slope) > 1 else 0
    if count < 2:
        return curve[[0, -1]]
    share = np.interp(np.linspace(0.0, total[-1], count + 1), total, np.linspace(0, 1, len(total)))
    points = _at(curve, share)
    points[[0, -1]] = curve[[0, -1]]
    return points


def _at(control: Floats, share: Floats) -> Floats:
    """Points (n, 2) of a Bezier curve of control points (k, 2) at parameters (n,) from 0 to 1."""
    degree = len(control) - 1
    power = np.arange(degree + 1)
    times = [comb(degree, k) for k in power.tolist()]
    weight = times * share[:, None] ** power * (1.0 - share[:, None]) ** (degree - power)
    return np.asarray(weight @ control)
