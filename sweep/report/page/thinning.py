"""Curves with few points: those that matter most for their shape."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

import numpy as np

if TYPE_CHECKING:
    from collections.abc import Iterable

    from numpy.typing import NDArray

    Floats = NDArray[np.float64]


def thinned(points: Floats, most: int, tolerance: float = 0.0) -> list[int]:
    """Indices of points (n, k) whose polyline stays close to all of them.

    The point farthest from the polyline is added until there are ``most`` points or none is farther
    away than ``tolerance`` (Ramer 1972, by greatest distance first).
    """
    kept = [0, len(points) - 1] if len(points) > 1 else list(range(len(points)))
    gaps = [_farthest(points, 0, len(points) - 1)] if len(points) > 2 else []
    while gaps and len(kept) < most:
        gap = max(gaps)
        if gap[0] <= tolerance:
            break
        gaps.remove(gap)
        _, middle, begin, end = gap
        kept.append(middle)
        halves = ((begin, middle), (middle, end))
        gaps += [_farthest(points, *half) for half in halves if half[1] - half[0] > 1]
    return sorted(kept)


def _farthest(points: Floats, begin: int, end: int) -> tuple[float, int, int, int]:
    """Distance and index of the point between two others that is farthest from their chord."""
    inner, start = points[begin + 1 : end], points[begin]
    chord = points[end] - start
    along = (inner - start) @ chord / max(float(chord @ chord), np.finfo(float).tiny)
    off = inner - start - np.clip(along, 0.0, 1.0)[:, None] * chord
    distance = np.linalg.norm(off, axis=1)
    found = int(distance.argmax())
    return float(distance[found]), begin + 1 + found, begin, end


def thin_curves(columns: Iterable[Any], most: int) -> list[Floats]:
    """Columns (n,) at the same ``most`` rows or fewer; each counts by its range."""
    values = np.column_stack([np.asarray(column, dtype=float) for column in columns])
    values = values[np.isfinite(values).all(axis=1)]
    if not len(values):
        return list(values.T)
    spans = np.ptp(values, axis=0)
    kept = thinned(values / np.where(spans > 0.0, spans, 1.0), most)
    return list(values[kept].T)


def force_stairs(force: Floats, work: Floats) -> tuple[Floats, Floats]:
    """Greatest force so far (N) over the work done (J), (rows + dips,) each.

    The work that is done until a force is exceeded is the last one at which these stairs are not
    above it. Where the force rises again after a dip, a point is added at its former height.
    """
    highest = np.maximum.accumulate(force)
    again = np.flatnonzero((force[1:] > highest[:-1]) & (force[:-1] < highest[:-1]))
    share = (highest[again] - force[again]) / (force[again + 1] - force[again])
    added = work[again] + share * (work[again + 1] - work[again])
    return (
        np.insert(highest, again + 1, highest[again]),
        np.insert(work, again + 1, added),
    )


def work_until(limit: float, highest: Floats, work: Floats) -> float:
    """Work (J) at which stairs of `force_stairs` first exceed a force (N); all if they never do."""
    over = np.flatnonzero(highest > limit)
    if not len(over):
        return float(work[-1])
    k = int(over[0])
    if k == 0:
        return float(work[0])
    share = (limit - highest[k - 1]) / (highest[k] - highest[k - 1])
    return float(work[k - 1] + share * (work[k] - work[k - 1]))


def numbers(values: Iterable[float], digits: int = 4) -> list[float | int | None]:
    """Values with few digits for JSON, which has no NaN."""
    return [_number(float(value), digits) for value in values]


def _number(value: float, digits: int) -> float | int | None:
    if not math.isfinite(value):
        return None
    short = float(f"{value:.{digits}g}")
    return int(short) if short.is_integer() and abs(short) < 1e9 else short
