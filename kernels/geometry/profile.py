"""Rigid convex profiles: distance of points and segments, and the share of a move up to contact.

A profile is a chain of straight lines, convex and open, rounded by a radius r: the set of all
points within r of the chain, or of what the chain encloses on its left. One vertex is a circle, two
are a rib with a round end, three a wedge, four a punch. It moves with one coordinate, in y. With
the closest point c of the chain to a point p,

    d = |p - c| - r,  n = (p - c) / |p - c|,  grad d = n,  d2 d = (I - n n^T) b,

b = 1 / |p - c| if c is a vertex, 0 on a straight line. Both are exact: the offset of a convex set.
"""

import math
from typing import NamedTuple

import numpy as np

from kernels.compile.jit import jit_exact

KEPT = 0.1  # share of the distance that is kept
MOST_ROUNDS = 100  # the share reached after so many steps is admissible too
CLOSE = 0.1  # share of the kept distance: the advance ends when it is closer to that distance


class Profiles(NamedTuple):
    """The profiles of a scene, and the walls that they may touch; lengths in m.

    start (k + 1,): first vertex of each. vertex (v, 2): x, and y above the carrier. weight (v,):
    contact length with walls between their nodes, 0 where a vertex is only an end of a straight
    line. radius (k,). carrier (k,): the coordinate that moves each. box (k, 4): least and greatest
    x, then y above the carrier. nodes (n,), edges (m, 2). subtract (m, 2): as in `contact.Contact`.
    tributary, node_half (all nodes,), edge_half (m,): length and half thickness.
    """

    start: np.ndarray
    vertex: np.ndarray
    weight: np.ndarray
    radius: np.ndarray
    carrier: np.ndarray
    box: np.ndarray
    nodes: np.ndarray
    edges: np.ndarray
    subtract: np.ndarray
    tributary: np.ndarray
    node_half: np.ndarray
    edge_half: np.ndarray


@jit_exact
def along(vx, vy, ax, ay, bx, by):
    """Return tau in [0, 1], the closest point of a-b to v."""
    ux, uy = bx - ax, by - ay
    l2, at = ux * ux + uy * uy, (vx - ax) * ux + (vy - ay) * uy
    if at <= 0.0:
        return 0.0
    return 1.0 if at >= l2 else at / l2


@jit_exact
def _is_inside(profiles, k, px, py):
    """Return whether a chain of more than one line encloses the point."""
    first, last = profiles.start[k], profiles.start[k + 1] - 1
    for i in range(first, last):
        ax, ay = profiles.vertex[i, 0], profiles.vertex[i, 1]
        bx, by = profiles.vertex[i + 1, 0], profiles.vertex[i + 1, 1]
        if (bx - ax) * (py - ay) - (by - ay) * (px - ax) <= 0.0:
            return False
    return last - first > 1


@jit_exact
def distance(profiles, k, px, py):
    """Return n, d and b at a point; y is above the carrier. d is negative inside."""
    first, end = profiles.start[k], profiles.start[k + 1]
    nx, ny, least, at_vertex = 0.0, 0.0, np.inf, True
    for i in range(first, end):
        j = min(i + 1, end - 1)
        ax, ay = profiles.vertex[i, 0], profiles.vertex[i, 1]
        bx, by = profiles.vertex[j, 0], profiles.vertex[j, 1]
        tau = along(px, py, ax, ay, bx, by)
        wx, wy = px - ax - tau * (bx - ax), py - ay - tau * (by - ay)
        apart = math.sqrt(wx * wx + wy * wy)
        if apart < least:
            nx, ny, least, at_vertex = wx, wy, apart, tau == 0.0 or tau == 1.0
    if least == 0.0:
        return 0.0, 0.0, -profiles.radius[k], 0.0
    if _is_inside(profiles, k, px, py):
        return -nx / least, -ny / least, -least - profiles.radius[k], 0.0
    bend = 1.0 / least if at_vertex else 0.0
    return nx / least, ny / least, least - profiles.radius[k], bend


@jit_exact
def to_segment(vx, vy, ax, ay, bx, by):
    """Return tau, the unit vector from a vertex to the point tau of a-b, and their distance."""
    tau = along(vx, vy, ax, ay, bx, by)
    wx, wy = ax + tau * (bx - ax) - vx, ay + tau * (by - ay) - vy
    apart = math.sqrt(wx * wx + wy * wy)
    if apart == 0.0:
        return tau, 0.0, 0.0, 0.0
    return tau, wx / apart, wy / apart, apart


@jit_exact
def gap(profiles, k, ax, ay, bx, by):
    """Return n and d of the closest points of a profile and a segment that do not cross.

    The profile is on one side of the line across n at its closest point, the segment on the other.
    """
    nx, ny, least, _ = distance(profiles, k, ax, ay)
    mx, my, d, _ = distance(profiles, k, bx, by)
    if d < least:
        nx, ny, least = mx, my, d
    for i in range(profiles.start[k], profiles.start[k + 1]):
        vx, vy = profiles.vertex[i, 0], profiles.vertex[i, 1]
        _, mx, my, apart = to_segment(vx, vy, ax, ay, bx, by)
        if apart - profiles.radius[k] < least:
            nx, ny, least = mx, my, apart - profiles.radius[k]
    return nx, ny, least


@jit_exact
def is_far(profiles, k, reach, low_x, high_x, low_y, high_y):
    """Return whether a box of points is more than ``reach`` from a profile; y above the carrier."""
    box = profiles.box
    beside = low_x > box[k, 1] + reach or high_x < box[k, 0] - reach
    return beside or low_y > box[k, 3] + reach or high_y < box[k, 2] - reach


@jit_exact
def advance(profiles, k, a, b, da, db):
    """Return a share of a move, at most 1, up to which segment a-b keeps `KEPT` of its distance.

    a, b: ends, y above the carrier; da, db: their moves relative to it. From s on, the closest
    points are separated by a line across n as long as d + (s' - s) min(n . da, n . db) > 0. Each
    step of s is therefore the distance still to be used up, divided by the speed of approach to
    this line.
    """
    _, _, d = gap(profiles, k, a[0], a[1], b[0], b[1])
    least, s = KEPT * d, 0.0
    if d <= 0.0:
        return 0.0
    for _ in range(MOST_ROUNDS):
        ax, ay, bx, by = a[0] + s * da[0], a[1] + s * da[1], b[0] + s * db[0], b[1] + s * db[1]
        nx, ny, d = gap(profiles, k, ax, ay, bx, by)
        closing = -min(nx * da[0] + ny * da[1], nx * db[0] + ny * db[1])
        if (1.0 - s) * closing <= d - least:
            return 1.0
        s += max(d - least, 0.0) / closing
        if d <= (1.0 + CLOSE) * least:
            return s
    return s
