"""Broad phase in space: near pairs of nodes and triangles, and of edges, by a grid of cells."""

import math

import numpy as np

from kernels.arrays import grouped
from kernels.compile.jit import jit_exact, jit_owning
from kernels.geometry.space.closest import squared_between_edges, squared_to_triangle
from kernels.geometry.space.vectors import length, minus, point

CELLS_PER_NODE = 4.0  # greatest number of cells of a grid, per item in it
SHARE_OF_EXTENT = 1e-2  # least size of a cell, as a share of the largest extent of the grid


@jit_owning
def _grid(places, radius):
    """Return (low (3,), cell, counts (3,)) of a grid over ``places`` (n, 3) with cells of at least
    half of ``radius``.
    """
    low, high = np.full(3, np.inf), np.full(3, -np.inf)
    for i in range(places.shape[0]):
        for k in range(3):
            low[k], high[k] = min(low[k], places[i, k]), max(high[k], places[i, k])
    most = max(high[0] - low[0], high[1] - low[1], high[2] - low[2])
    cell, counts = max(0.5 * radius, SHARE_OF_EXTENT * most, 1e-300), np.empty(3, np.int64)
    while True:
        total = 1.0
        for k in range(3):
            counts[k] = int((high[k] - low[k]) / cell) + 1
            total *= counts[k]
        if total <= max(CELLS_PER_NODE * places.shape[0], 1.0):
            return low, cell, counts
        cell *= 1.25


@jit_owning
def _bins(places, grid):
    """Return (start, order): the places in cell c are order[start[c]:start[c + 1]]."""
    low, cell, counts = grid
    home = np.empty(places.shape[0], np.int64)
    for i in range(places.shape[0]):
        c = 0
        for k in range(3):
            c = c * counts[k] + int((places[i, k] - low[k]) / cell)
        home[i] = c
    return grouped(home, counts[0] * counts[1] * counts[2])


@jit_owning
def _without_images(bins, is_image):
    """Return bins, (start (c + 1,), order (m,)), without the points that are images.

    is_image (n,): of each point.
    """
    start, order = bins
    first, kept, n = np.empty(start.size, np.int64), np.empty(order.size, np.int64), 0
    for c in range(start.size - 1):
        first[c] = n
        for q in range(start[c], start[c + 1]):
            if not is_image[order[q]]:
                kept[n] = order[q]
                n += 1
    first[start.size - 1] = n
    return first, kept


@jit_exact
def _box(x, nodes, radius, box):
    """Write the bounding box of ``nodes``, ``radius`` wider on all sides, to ``box`` (2, 3)."""
    for k in range(3):
        box[0, k], box[1, k] = math.inf, -math.inf
    for i in range(nodes.size):
        at = point(x, nodes[i])
        for k in range(3):
            box[0, k] = min(box[0, k], at[k] - radius)
            box[1, k] = max(box[1, k], at[k] + radius)


@jit_exact
def _cells(box, wider, grid, span):
    """Write the first and last cell that a box grown by ``wider`` reaches to ``span`` (2, 3)."""
    low, cell, counts = grid
    for k in range(3):
        first = math.floor((box[0, k] - wider - low[k]) / cell)
        last = math.floor((box[1, k] + wider - low[k]) / cell)
        span[0, k] = int(max(first, 0.0))
        span[1, k] = int(min(last, counts[k] - 1.0))


@jit_exact
def _is_in(at, box):
    """Return whether the point ``at`` is in a box."""
    for k in range(3):
        if at[k] < box[0, k] or at[k] > box[1, k]:
            return False
    return True


@jit_exact
def _near_triangle(x, triangles, k, radius, grid, bins, scratch, neighbours):
    """Append the nodes within ``radius`` of triangle ``k`` to ``neighbours``; return the count."""
    start, order = bins
    box, span = scratch
    a, b, c = triangles[k, 0], triangles[k, 1], triangles[k, 2]
    at_a, at_b, at_c = point(x, a), point(x, b), point(x, c)
    _box(x, triangles[k], radius, box)
    _cells(box, 0.0, grid, span)
    counts, n = grid[2], 0
    for i in range(span[0, 0], span[1, 0] + 1):
        for j in range(span[0, 1], span[1, 1] + 1):
            line = (i * counts[1] + j) * counts[2]
            for q in range(start[line + span[0, 2]], start[line + span[1, 2] + 1]):
                p = order[q]
                if p == a or p == b or p == c:
                    continue
                at = point(x, p)
                if _is_in(at, box):
                    d2 = squared_to_triangle(at, at_a, at_b, at_c)
                    if d2 < radius * radius:
                        neighbours[0][n], neighbours[1][n] = p, math.sqrt(d2)
                        n += 1
    return n


@jit_owning
def _room(n):
    return np.empty(n, np.int64), np.empty(n)


@jit_owning
def grown(array, size):
    """Return a copy of ``array`` with room for ``size`` entries."""
    larger = np.empty(size, array.dtype)
    for i in range(array.size):
        larger[i] = array[i]
    return larger


@jit_owning
def node_triangle(x, n_nodes, original, triangles, radius):
    """Return (node, triangle, distance) of pairs closer than ``radius`` (m) that share no node,
    triangle by triangle. x (n,): `vectors.SIZE` coordinates a node. original (n_nodes,): images,
    whose original is another node, are left out.
    """
    node, triangle, distance = np.empty(64, np.int64), np.empty(64, np.int64), np.empty(64)
    if triangles.shape[0] == 0:
        return node[:0], triangle[:0], distance[:0]
    places, is_image = np.empty((n_nodes, 3)), np.empty(n_nodes, np.bool_)
    for p in range(n_nodes):
        places[p, 0], places[p, 1], places[p, 2] = point(x, p)
        is_image[p] = original[p] != p
    grid = _grid(places, radius)
    bins, scratch = _bins(places, grid), (np.empty((2, 3)), np.empty((2, 3), np.int64))
    bins = _without_images(bins, is_image)
    neighbours, count = _room(n_nodes), 0
    for k in range(triangles.shape[0]):
        n = _near_triangle(x, triangles, k, radius, grid, bins, scratch, neighbours)
        if count + n > node.size:
            size = 2 * (count + n)
            node, triangle = grown(node, size), grown(triangle, size)
            distance = grown(distance, size)
        for i in range(n):
            node[count + i], triangle[count + i] = neighbours[0][i], k
            distance[count + i] = neighbours[1][i]
        count += n
    return node[:count], triangle[:count], distance[:count]


@jit_exact
def _boxes_overlap(box, x, c, d):
    """Return whether the bounding box of edge c-d meets a box."""
    one, two = point(x, c), point(x, d)
    for k in range(3):
        if max(one[k], two[k]) < box[0, k] or min(one[k], two[k]) > box[1, k]:
            return False
    return True


@jit_exact
def _near_edge(x, edges, e, radius, half, grid, bins, scratch, neighbours):
    """Append the edges after ``e`` within ``radius`` of it to ``neighbours``; return their number.

    half: half the length of the longest edge, m.
    """
    start, order = bins
    box, span = scratch
    a, b = edges[e, 0], edges[e, 1]
    at_a, at_b = point(x, a), point(x, b)
    _box(x, edges[e], radius, box)
    _cells(box, half, grid, span)
    counts, n = grid[2], 0
    for i in range(span[0, 0], span[1, 0] + 1):
        for j in range(span[0, 1], span[1, 1] + 1):
            line = (i * counts[1] + j) * counts[2]
            for q in range(start[line + span[0, 2]], start[line + span[1, 2] + 1]):
                other = order[q]
                if other <= e:
                    continue
                c, d = edges[other, 0], edges[other, 1]
                if c == a or c == b or d == a or d == b or not _boxes_overlap(box, x, c, d):
                    continue
                d2 = squared_between_edges(at_a, at_b, point(x, c), point(x, d))
                if d2 < radius * radius:
                    neighbours[0][n], neighbours[1][n] = other, math.sqrt(d2)
                    n += 1
    return n


@jit_owning
def edge_edge(x, edges, own, radius):
    """Return (one, two, distance) of pairs of edges closer than ``radius`` (m) that share no node,
    one < two, by ascending ``one``. own (l,): at least one of them is not 0.
    """
    m, half, is_image = edges.shape[0], 0.0, own == 0.0
    one, two, distance = np.empty(64, np.int64), np.empty(64, np.int64), np.empty(64)
    if m == 0:
        return one[:0], two[:0], distance[:0]
    places = np.empty((m, 3))
    for e in range(m):
        a, b = point(x, edges[e, 0]), point(x, edges[e, 1])
        for k in range(3):
            places[e, k] = 0.5 * (a[k] + b[k])
        half = max(half, 0.5 * length(minus(a, b)))
    grid = _grid(places, radius + half)
    every, scratch = _bins(places, grid), (np.empty((2, 3)), np.empty((2, 3), np.int64))
    proper, neighbours, count = _without_images(every, is_image), _room(m), 0
    for e in range(m):
        bins = proper if is_image[e] else every
        n = _near_edge(x, edges, e, radius, half, grid, bins, scratch, neighbours)
        if count + n > one.size:
            size = 2 * (count + n)
            one, two, distance = grown(one, size), grown(two, size), grown(distance, size)
        for i in range(n):
            one[count + i], two[count + i] = e, neighbours[0][i]
            distance[count + i] = neighbours[1][i]
        count += n
    return one[:count], two[:count], distance[:count]


@jit_exact
def longest(move, n_nodes):
    """Return the longest move of a node in ``move`` (n,), m."""
    most = 0.0
    for p in range(n_nodes):
        most = max(most, length(point(move, p)))
    return most


@jit_exact
def farthest(x, other, n_nodes):
    """Return the longest move of a node between ``other`` and ``x``, m."""
    most = 0.0
    for p in range(n_nodes):
        most = max(most, length(minus(point(x, p), point(other, p))))
    return most
