"""A net of quads on a gyroid that repeats along all axes, as in `nets` but without planes.

Its period is 1. The nets of `sweep.design.surfaces.nets` end at two planes, on curves which differ
from one plane to the other, so that they do not repeat along z.
"""

from typing import NamedTuple

import numpy as np

from sweep.design.surfaces import nets
from sweep.design.surfaces.level_set import LEVEL_SETS

GYROID = LEVEL_SETS["gyroid"]
LEVEL = 0.5  # of the grid along z, in cells, as in nets between planes


class Period(NamedTuple):
    """A net of one period; n nodes, m quads.

    points, normals (n, 3): of the nodes. quads (m, 4): nodes in order round each quad, its normal
    to the side of the gradient. shift (m, 4, 3): by how many periods a corner is moved from its
    node.
    """

    points: np.ndarray
    normals: np.ndarray
    quads: np.ndarray
    shift: np.ndarray

    @property
    def corners(self):
        """Positions of the corners of the quads, (m, 4, 3)."""
        return self.points[self.quads] + self.shift

    @property
    def quality(self):
        """The least area of two sides at a corner over the squared mean side."""
        ahead = np.roll(self.corners, -1, axis=1) - self.corners
        areas = np.linalg.norm(np.cross(ahead, -np.roll(ahead, 1, axis=1)), axis=2)
        return areas.min() / np.mean(np.linalg.norm(ahead, axis=2)) ** 2


def best_period(n):
    """The net of the best quads on grids of n cells along each axis, at `nets.PLACES`."""
    return max((build_period(n, place) for place in nets.PLACES), key=lambda net: net.quality)


def build_period(n, place):
    """The net on a grid of n cells along each axis, from ``place`` (2,) along x and y, in cells."""
    start = np.array([*place, LEVEL])
    phases = 2.0 * np.pi * (np.indices((n, n, n)).reshape(3, -1).T + start) / n
    inside = GYROID.value(phases).reshape(n, n, n) > 0.0
    cells = np.concatenate([_quads(inside, axis) for axis in range(3)])
    number = np.ravel_multi_index(np.moveaxis(cells % n, 2, 0), (n, n, n))
    used, quads = np.unique(number, return_inverse=True)
    points = (np.stack(np.unravel_index(used, (n, n, n)), axis=1) + 0.5 + start) / n
    return _smoothed(points, quads.reshape(-1, 4), cells // n, 1.0 / n)


def _quads(inside, axis):
    """The cells round each edge along ``axis`` that the surface cuts, (k, 4, 3), without regard to
    the period; inside (n, n, n): whether the function is positive.
    """
    at = np.argwhere(inside != np.roll(inside, -1, axis))
    cells = np.repeat(at[:, None], 4, axis=1)
    cells[..., (axis + 1) % 3] += nets.AROUND[:, 0] - 1
    cells[..., (axis + 2) % 3] += nets.AROUND[:, 1] - 1
    falls = inside[tuple(at.T)]
    cells[falls] = cells[falls][:, ::-1]
    return cells


def _smoothed(points, quads, shift, cell):
    """The net with its nodes on the surface, each near the mean of its neighbours."""
    one, two = quads, np.roll(quads, -1, axis=1)
    way = np.roll(shift, -1, axis=1) - shift
    sides = np.concatenate([np.dstack([one, two, way]), np.dstack([two, one, -way])])
    sides = np.unique(sides.reshape(-1, 5), axis=0)
    one, two, way = sides[:, 0], sides[:, 1], sides[:, 2:]
    n = len(points)
    count = np.bincount(one, minlength=n)[:, None]
    points = _projected(points, cell)
    for _ in range(nets.ROUNDS):
        ahead = points[two] + way - points[one]
        move = np.stack([np.bincount(one, ahead[:, k], n) for k in range(3)], axis=1) / count
        points = _projected(points + nets.STRIDE * move, cell)
    slope = GYROID.gradient(2.0 * np.pi * points)
    return Period(points, slope / np.linalg.norm(slope, axis=1)[:, None], quads, shift)


def _projected(points, cell):
    """Points (n, 3) moved to the surface by Newton's method, less than 0.3 cells a step."""
    for _ in range(nets.NEWTON):
        phases = 2.0 * np.pi * points
        slope = 2.0 * np.pi * GYROID.gradient(phases)
        move = -(GYROID.value(phases) / (slope**2).sum(axis=1))[:, None] * slope
        length = np.linalg.norm(move, axis=1)
        points = (
            points
            + move * np.minimum(1.0, nets.LONGEST * cell / np.maximum(length, 1e-300))[:, None]
        )
    return points
