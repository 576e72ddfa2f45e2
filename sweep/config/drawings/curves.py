"""Divides curves into straight pieces: Bezier curves of degree 1 to 3, to which DXF and SVG are
reduced.
"""

from collections.abc import Iterable
from math import ceil, comb, radians

import numpy as np

from sweep.array_types import Floats
from sweep.config.faults import MisfitError

TURN = radians(12.0)  # turn of one straight piece, within 0.6 % of the radius: 32 in a circle
SAMPLES = np.linspace(0.0, 1.0, 65)  # points at which the direction of a curve is taken
ROUND = 16  # least number of straight pieces of a circle
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


def without_marks(ends: Floats) -> tuple[Floats, list[str]]:
    """Lines (s, 2, 2) without the small circles around their ends, which mark joints; and a note.

    A circle is a mark if lines end at its centre, all of them longer than four times its radius.
    """
    near = 1e-9 * np.abs(ends).max(initial=0.0)
    apart = (np.abs(ends[1:, 0] - ends[:-1, 1]) > near).any(axis=1)
    circles = [
        loop
        for loop in np.split(np.arange(len(ends)), np.flatnonzero(apart) + 1)
        if len(loop) >= ROUND and _is_circle(ends[loop], near)
    ]
    if not circles:
        return ends, []
    others = np.delete(ends, np.concatenate(circles), axis=0)
    length = np.linalg.norm(others[:, 1] - others[:, 0], axis=1)
    marks = []
    for loop in circles:
        centre = _centre(ends[loop])
        radius = np.linalg.norm(ends[loop[0], 0] - centre)
        here = (np.linalg.norm(others - centre, axis=2) < 0.1 * radius).any(axis=1)
        if here.any() and radius < 0.25 * length[here].min():
            marks.append(loop)
    count = f"{len(marks)} x small circle around the end of a line, a mark of a joint"
    return (np.delete(ends, np.concatenate(marks), axis=0), [count]) if marks else (ends, [])


def _centre(ring: Floats) -> Floats:
    return np.asarray(0.5 * (ring[:, 0].max(axis=0) + ring[:, 0].min(axis=0)))


def _is_circle(ring: Floats, near: float) -> bool:
    """Whether lines (s, 2, 2), one after another, are a circle; some may have no length."""
    radii = np.linalg.norm(ring[:, 0] - _centre(ring), axis=1)
    closed = bool((np.abs(ring[-1, 1] - ring[0, 0]) <= near).all())
    return closed and float(np.ptp(radii)) < 0.01 * float(radii.mean())


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
