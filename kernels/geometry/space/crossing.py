"""Edges that pass through triangles in stored shapes: an independent check of contact.

The sides on which points lie are signs of determinants. A sign is undecided if the determinant is
less than `SIGN_TOLERANCE` of the sum of the sizes of its terms, some 1e4 times its round-off. An
edge in the plane of a triangle, as in a flat wall, counts as apart if their distance is more than
`DISTANCE_TOLERANCE` of the length of the edge.
"""

import numpy as np

from kernels.arrays import grouped, triple
from kernels.compile.jit import jit_exact, jit_owning
from kernels.geometry.space.closest import squared_between_edges, squared_to_triangle
from kernels.geometry.space.vectors import cross, inner, minus, row

APART, UNSURE, ACROSS = -1, 0, 1
SIGN_TOLERANCE = 1e-12
DISTANCE_TOLERANCE = 1e-9
STRIPS = 1 << 12  # number of classes of position by which edges are sorted


@jit_exact
def side(a, b, c, p):
    """Return on which side of the plane a, b, c the point ``p`` lies, as a sign; 0 if undecided."""
    u, v, w = minus(b, a), minus(c, a), minus(p, a)
    value = inner(cross(u, v), w)
    one = abs(w[0]) * (abs(u[1] * v[2]) + abs(u[2] * v[1]))
    two = abs(w[1]) * (abs(u[2] * v[0]) + abs(u[0] * v[2]))
    three = abs(w[2]) * (abs(u[0] * v[1]) + abs(u[1] * v[0]))
    if not abs(value) > SIGN_TOLERANCE * (one + two + three):  # NaN too
        return 0
    return 1 if value > 0.0 else -1


@jit_exact
def _squared_distance(a, b, c, p, q):
    """Return the squared distance, m^2, of the edge p-q from the triangle a, b, c, which it does
    not cross.
    """
    ends = min(squared_to_triangle(p, a, b, c), squared_to_triangle(q, a, b, c))
    sides = min(squared_between_edges(p, q, a, b), squared_between_edges(p, q, b, c))
    return min(ends, sides, squared_between_edges(p, q, c, a))


@jit_exact
def relation(a, b, c, p, q):
    """Return whether the edge p-q passes through the triangle a, b, c (ACROSS), does not (APART),
    or is undecided (UNSURE).
    """
    ends = side(a, b, c, p) * side(a, b, c, q)
    if ends > 0:
        return APART
    one, two, three = side(p, q, a, b), side(p, q, b, c), side(p, q, c, a)
    if max(one, two, three) > 0 and min(one, two, three) < 0:
        return APART
    if ends < 0 and one * two * three != 0:
        return ACROSS
    u = minus(q, p)
    least = DISTANCE_TOLERANCE * DISTANCE_TOLERANCE * inner(u, u)
    return APART if _squared_distance(a, b, c, p, q) > least else UNSURE


@jit_exact
def _bound(points, nodes, box):
    """Write the bounding box of ``nodes`` into ``box`` (6,): least, then largest coordinates."""
    for axis in range(3):
        box[axis], box[axis + 3] = np.inf, -np.inf
        for p in nodes:
            box[axis] = min(box[axis], points[p, axis])
            box[axis + 3] = max(box[axis + 3], points[p, axis])


@jit_exact
def _overlap(box, boxes, i):
    """Return whether a bounding box overlaps box ``i`` of ``boxes``."""
    for axis in range(3):
        if boxes[i, axis] > box[axis + 3] or boxes[i, axis + 3] < box[axis]:
            return False
    return True


@jit_exact
def _share_a_node(triangle, edge):
    """Return whether a triangle and an edge have a common node."""
    for p in triangle:
        if p == edge[0] or p == edge[1]:
            return True
    return False


@jit_owning
def _by_position(points, edges):
    """Return (start, order, boxes, low, width, longest): edges sorted into strips by their left
    ends along x, and their bounding boxes (l, 6) in this order.
    """
    boxes = np.empty((edges.shape[0], 6))
    low, high, longest = np.inf, -np.inf, 0.0
    for e in range(edges.shape[0]):
        _bound(points, edges[e], boxes[e])
        left, right = boxes[e, 0], boxes[e, 3]
        low, high, longest = min(low, left), max(high, left), max(longest, right - left)
    width = max((high - low) / (STRIPS - 1), 1e-300)
    strip = np.empty(edges.shape[0], np.int64)
    for e in range(edges.shape[0]):
        strip[e] = int((boxes[e, 0] - low) / width)
    start, order = grouped(strip, STRIPS)
    return start, order, boxes[order], low, width, longest


@jit_owning
def count(points, triangles, edges, unsure):
    """Return the number of edges that pass through triangles with which they share no node, and the
    number of undecided pairs, which are written to ``unsure`` (k, 2), triangle and edge, as far as
    they fit.

    points (n, 3): one shape, finite; triangles (m, 3), edges (l, 2): nodes.
    """
    start, order, boxes, low, width, longest = _by_position(points, edges)
    crossed, undecided, box = 0, 0, np.empty(6)
    for k in range(triangles.shape[0]):
        a, b, c = triple(triangles, k)
        _bound(points, triangles[k], box)
        left, right = box[0], box[3]
        first = min(max(int((left - longest - low) / width) - 1, 0), STRIPS)
        last = min(max(int((right - low) / width) + 1, 0), STRIPS)
        for i in range(start[first], start[last]):
            e = order[i]
            if not _overlap(box, boxes, i) or _share_a_node(triangles[k], edges[e]):
                continue
            p, q = edges[e, 0], edges[e, 1]
            side = relation(
                row(points, a), row(points, b), row(points, c), row(points, p), row(points, q)
            )
            if side == ACROSS:
                crossed += 1
            elif side == UNSURE:
                if undecided < unsure.shape[0]:
                    unsure[undecided, 0], unsure[undecided, 1] = k, e
                undecided += 1
    return crossed, undecided
