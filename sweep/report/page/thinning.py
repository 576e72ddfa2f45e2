"""Reduces curves to the few points that matter most for their shape."""

import math
from collections.abc import Callable, Iterable
from typing import Any

import numpy as np

from sweep.array_types import Floats, Ints

Gap = Callable[[Floats, Floats, Floats], Floats]

TINY = np.finfo(float).tiny
LEAST_WORK = 1e-3  # share of all work: below, an error counts relative to this work
ALIKE = 0.5  # share of the greatest distance: points so far away are added in the same round


def thinned(points: Floats, most: int, tolerance: float = 0.0, gap: Gap | None = None) -> list[int]:
    """Indices of points (n, k) whose polyline stays close to all of them.

    The points farthest from their chords are added until there are ``most`` points or none is
    farther away than ``tolerance`` (Ramer 1972, the greatest distances first). `gap`: the distance
    of points from start and end of their chords; Euclidean if it is not given.
    """
    if len(points) < 3:
        return list(range(len(points)))
    kept = np.array([0, len(points) - 1])
    while len(kept) < most:
        chord = _chords(kept)
        distance = (gap or _distances)(points, points[kept[chord]], points[kept[chord + 1]])
        peak = np.maximum.reduceat(distance, kept[:-1])[chord]
        farthest = _first_of_each(np.flatnonzero(distance >= peak), chord)
        far = farthest[distance[farthest] > max(tolerance, ALIKE * distance.max())]
        if not len(far):
            break
        far = far[np.argsort(-distance[far], kind="stable")][: most - len(kept)]
        kept = np.sort(np.concatenate([kept, far]))
    return [int(index) for index in kept]


def _chords(kept: Ints) -> Ints:
    """Number of the chord between kept points to which every point belongs."""
    lengths = kept[1:] - kept[:-1]
    lengths[-1] += 1
    return np.repeat(np.arange(len(lengths)), lengths)


def _distances(points: Floats, start: Floats, end: Floats) -> Floats:
    """Distances (n,) of points from their chords."""
    off, way = points - start, end - start
    along = _dot(off, way) / np.maximum(_dot(way, way), TINY)
    aside = off - np.minimum(np.maximum(along, 0.0), 1.0)[:, None] * way
    return np.sqrt(_dot(aside, aside))


def _dot(one: Floats, other: Floats) -> Floats:
    """Products (n,) of vectors (n, k) with few components, which `sum` would add up slowly."""
    return np.einsum("ij,ij->i", one, other)


def _work_gaps(points: Floats, start: Floats, end: Floats) -> Floats:
    """Relative errors of the work at the force of every point; points: squared force, work."""
    rise = end[:, 0] - start[:, 0]
    share = (points[:, 0] - start[:, 0]) / np.where(rise > 0.0, rise, 1.0)
    work = start[:, 1] + share * (end[:, 1] - start[:, 1])
    least = LEAST_WORK * points[:, 1].max()
    return np.where(rise > 0.0, np.abs(work - points[:, 1]), 0.0) / (points[:, 1] + least + TINY)


def _first_of_each(points: Ints, chord: Ints) -> Ints:
    """The first of the points, which are in order, on each chord."""
    numbers = chord[points]
    return points[np.append(True, numbers[1:] != numbers[:-1])]


def thin_curves(columns: Iterable[Any], most: int) -> list[Floats]:
    """Columns (n,) at the same ``most`` rows or fewer; each counts by its range."""
    values = np.column_stack([np.asarray(column, dtype=float) for column in columns])
    values = values[np.isfinite(values).all(axis=1)]
    if not len(values):
        return list(values.T)
    spans = np.ptp(values, axis=0)
    kept = thinned(values / np.where(spans > 0.0, spans, 1.0), most)
    return list(values[kept].T)


def force_stairs(force: Floats, work: Floats, travel: Floats) -> tuple[Floats, Floats, Floats]:
    """Greatest force so far (N), work done (J) and travel of the platen (m), (rows + dips,) each.

    The work done until a force is exceeded is the last one at which these stairs are not above it.
    Where the force rises again after a dip, a point is added at its former height.
    """
    highest = np.maximum.accumulate(force)
    again = np.flatnonzero((force[1:] > highest[:-1]) & (force[:-1] < highest[:-1]))
    former = highest[again]
    return (
        np.insert(highest, again + 1, former),
        np.insert(work, again + 1, _at(former, np.maximum(force, 0.0), work, again, 2)),
        np.insert(travel, again + 1, _at(former, force, travel, again, 1)),
    )


def _at(limit: Floats, force: Floats, values: Floats, rows: Ints, power: int) -> Floats:
    """Values between rows and the next ones at forces, linear in a power of the force."""
    before, after = force[rows] ** power, force[rows + 1] ** power
    return values[rows] + (limit**power - before) / (after - before) * (
        values[rows + 1] - values[rows]
    )


def thin_stairs(highest: Floats, done: Floats, most: int) -> list[int]:
    """At most ``most`` points of `force_stairs`, chosen for the least relative error of the
    work.
    """
    return thinned(np.column_stack([highest**2, done]), most, gap=_work_gaps)


def numbers(values: Iterable[float], digits: int = 4) -> list[float | int | None]:
    """Values with few digits for JSON, which has no NaN."""
    return [_number(float(value), digits) for value in values]


def _number(value: float, digits: int) -> float | int | None:
    if not math.isfinite(value):
        return None
    short = float(f"{value:.{digits}g}")
    return int(short) if short.is_integer() and abs(short) < 1e9 else short
