"""Triangulated surfaces, also branched ones: their edges, areas and a share of area per edge."""

import numpy as np

from kernels.compile.jit import jit_exact, jit_owning
from kernels.geometry.space.vectors import cross, length, minus, row


@jit_exact
def _find(first, following, high, low, other):
    """Return the number of the edge from ``low`` to ``other`` in a list, -1 if it is not there."""
    e = first[low]
    while e >= 0 and high[e] != other:
        e = following[e]
    return e


@jit_owning
def edges_of(triangles, n_nodes):
    """Return (edges (l, 2), sides (k, 3)): all edges, and the numbers of the edges ab, bc, ca of
    each triangle.
    """
    most = 3 * triangles.shape[0]
    edges, sides = np.empty((most, 2), np.int64), np.empty((triangles.shape[0], 3), np.int64)
    first, following = np.full(n_nodes, -1), np.full(most, -1)
    high, count = np.empty(most, np.int64), 0
    for k in range(triangles.shape[0]):
        for i in range(3):
            a, b = triangles[k, i], triangles[k, (i + 1) % 3]
            low, other = min(a, b), max(a, b)
            e = _find(first, following, high, low, other)
            if e < 0:
                e, count = count, count + 1
                edges[e, 0], edges[e, 1], high[e] = low, other, other
                following[e], first[low] = first[low], e
            sides[k, i] = e
    return edges[:count].copy(), sides


@jit_exact
def area(points, triangles, k):
    """Return the area of triangle ``k`` in m^2. points (n, 3) m."""
    a, b, c = triangles[k, 0], triangles[k, 1], triangles[k, 2]
    at = row(points, a)
    return 0.5 * length(cross(minus(row(points, b), at), minus(row(points, c), at)))


@jit_owning
def widths(points, triangles, edges, sides):
    """Return (l,): the width in m of the strip that belongs to each edge, a third of the area of
    its triangles divided by its length.
    """
    width = np.zeros(edges.shape[0])
    for k in range(triangles.shape[0]):
        for i in range(3):
            width[sides[k, i]] += area(points, triangles, k) / 3.0
    for e in range(edges.shape[0]):
        width[e] /= length(minus(row(points, edges[e, 1]), row(points, edges[e, 0])))
    return width
