"""Bundles of four walls that are alike, one in each lane of a vector (`compile.simd`)."""

from typing import NamedTuple

import numpy as np

from kernels.arrays import grouped
from kernels.compile.jit import jit_exact, jit_owning
from kernels.compile.simd import LANES

CONDENSED, OPEN, RIGID = range(3)
KINDS = 3


class Bundles(NamedTuple):
    """Walls of one kind with the same number of elements; lanes after the last wall repeat it.

    wall, first (b, 4): number and first element of each wall. size, pieces (b,): number of walls,
    and of the elements of each. start (b + 1,): first of the rows, one for each inner unknown.
    inner (4 r,), outer (b, 24): coordinates of the rows and of both joints, lane after lane. place
    (w,): 4 x bundle + lane of each wall; -1 for rigid ones, which are in no bundle.
    """

    wall: np.ndarray
    first: np.ndarray
    size: np.ndarray
    pieces: np.ndarray
    start: np.ndarray
    inner: np.ndarray
    outer: np.ndarray
    place: np.ndarray


@jit_exact
def rows_of(bundles, g, width):
    """Return the slice of bundle ``g`` in an array of ``width`` vectors of four for each row."""
    return slice(LANES * width * bundles.start[g], LANES * width * bundles.start[g + 1])


@jit_owning
def _members(kind, pieces):
    """Return (wall (b, 4), size (b,)) of the bundles; pieces (w,): elements of each wall."""
    most = pieces.max() if pieces.size > 0 else 0
    start, order = grouped(KINDS * pieces + kind, KINDS * (most + 1))
    wall, size, count = np.empty((kind.size, LANES), np.int64), np.empty(kind.size, np.int64), 0
    for alike in range(start.size - 1):
        if alike % KINDS != RIGID:
            for at in range(start[alike], start[alike + 1], LANES):
                size[count] = min(LANES, start[alike + 1] - at)
                for lane in range(LANES):
                    wall[count, lane] = order[at + min(lane, size[count] - 1)]
                count += 1
    return wall[:count].copy(), size[:count].copy()


@jit_owning
def bundled(kind, start, row_start, inner, outer):
    """Return the `Bundles` of walls by ``kind`` (w,). start, row_start (w + 1,): of the elements
    and inner unknowns of each wall. inner, outer: as in `analysis.Layout`.
    """
    wall, size = _members(kind, start[1:] - start[:-1])
    first, pieces = np.empty(wall.shape, np.int64), np.empty(size.size, np.int64)
    rows, place = np.zeros(size.size + 1, np.int64), np.full(kind.size, -1)
    for g in range(size.size):
        w = wall[g, 0]
        pieces[g], rows[g + 1] = start[w + 1] - start[w], rows[g] + row_start[w + 1] - row_start[w]
    inside = np.empty((rows[-1], LANES), np.int64)
    ends = np.empty((size.size, outer.shape[1] * LANES), np.int64)
    for g in range(size.size):
        for lane in range(LANES):
            w = wall[g, lane]
            place[w], first[g, lane] = LANES * g + min(lane, size[g] - 1), start[w]
            for k in range(rows[g + 1] - rows[g]):
                inside[rows[g] + k, lane] = inner[row_start[w] + k]
            for c in range(outer.shape[1]):
                ends[g, LANES * c + lane] = outer[w, c]
    return Bundles(wall, first, size, pieces, rows, inside.ravel(), ends, place)
