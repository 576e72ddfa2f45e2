"""A piece of a panel that repeats without end, cut out along planes that are upright at rest.

The stored period ends along the sides of its quads. Here quads are cut where they pass through the
sides of a period; the parts move with their quad. Such periods fit side by side.
"""

from collections.abc import Iterator, Mapping
from itertools import product
from typing import Any

import numpy as np
from numpy.typing import NDArray

from sweep.array_types import Floats, Ints
from sweep.columns import TIED_SIDES

START = 0.618  # of a period, along both sides: cuts sheets into few parts, and no wall along it
SHIFTS = np.array(list(product(range(-1, 3), repeat=2)))  # periods in which a quad may be cut
SAME = 1e-9  # m: corners no farther apart at rest are one node


def piece(frames: Mapping[str, Any], row: Mapping[str, Any], times: int = 2) -> Mapping[str, Any]:
    """The shapes of ``times`` periods along both sides; unchanged if nothing repeats.

    frames, row: of a case, as `read_frames` and the summary have them.
    """
    if "quads" not in frames or not row["sides"].startswith(TIED_SIDES):
        return frames
    position, quads, of = _cut(
        np.asarray(frames["position_m"], float), frames["quads"], _period(row)
    )
    laid = places(row, times)
    points = np.repeat(position[:, None], len(laid), axis=1)
    points[..., :2] += laid[:, None]
    n = position.shape[1]
    return {
        **frames,
        "position_m": points.reshape(len(points), -1, 3),
        "quads": np.concatenate([quads + n * k for k in range(len(laid))]),
        "quad_thickness_m": np.tile(frames["quad_thickness_m"][of], len(laid)),
    }


def places(row: Mapping[str, Any], times: int = 2) -> Floats:
    """How far ``times`` periods along both sides are moved, (k, 2) m; not at all if none
    repeats.
    """
    if not row["sides"].startswith(TIED_SIDES):
        return np.zeros((1, 2))
    return np.array(list(product(range(times), repeat=2))) * _period(row)


def _period(row: Mapping[str, Any]) -> Floats:
    """Sides of a period, (2,) m."""
    return np.array([row["outer_width_m"], row["depth_m"]])


def _cut(position: Floats, quads: Ints, period: Floats) -> tuple[Floats, Ints, Ints]:
    """Positions (f, n, 3) and quads (m, 4) of one period (2,), and the original quads (m,) of these
    parts.
    """
    plan, room = position[0, quads, :2] - START * period, SHIFTS * period
    parts = [
        (quad, shift, part)
        for shift in room
        for quad in np.flatnonzero(_meets(plan + shift, period))
        for part in _quads(_inside(plan[quad] + shift, period))
    ]
    of, shifts, weights = (np.array(each) for each in zip(*parts, strict=True))
    corners = np.einsum("fmci,mkc->fmki", position[:, quads[of]], weights)
    corners[..., :2] += shifts[:, None]
    every = corners.reshape(len(corners), -1, 3)
    place = np.rint(every[0] / SAME).astype(np.int64)
    _, first, node = np.unique(place, axis=0, return_index=True, return_inverse=True)
    return every[:, first], node.reshape(-1, 4), of


def _meets(plan: Floats, period: Floats) -> NDArray[np.bool_]:
    """Which quads (m, 4, 2) overlap the rectangle from 0 to ``period``."""
    beside = np.all(plan <= 0.0, axis=1) | np.all(plan >= period, axis=1)
    return np.asarray(~beside.any(axis=1))


def _inside(corners: Floats, period: Floats) -> Floats:
    """The part of a quad (4, 2) in that rectangle: weights (k, 4) of the corners of the quad for
    each corner of the part (I. Sutherland and G. Hodgman, Reentrant polygon clipping, 1974).
    """
    weights = np.eye(4)
    for axis, side in product((0, 1), (0, 1)):
        room = (weights @ corners)[:, axis] * (1 - 2 * side) + side * period[axis]
        kept = []
        for k in range(len(weights)):
            before, now = room[k - 1], room[k]
            if before * now < 0.0:
                kept.append((now * weights[k - 1] - before * weights[k]) / (now - before))
            if now >= 0.0:
                kept.append(weights[k])
        weights = np.array(kept).reshape(-1, 4)
    return weights


def _quads(polygon: Floats) -> Iterator[Floats]:
    """The quads (4, c) of a convex polygon (k, c); for a triangle one corner occurs twice."""
    for k in range(1, len(polygon) - 1, 2):
        yield polygon[[0, k, k + 1, min(k + 2, len(polygon) - 1)]]
