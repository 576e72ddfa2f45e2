"""Which nodes are near which segments: broad phase by cells, kept between steps.

A list found with a margin stays valid until some node has moved half of that margin.
"""

from typing import NamedTuple

import numpy as np

from kernels.distance import squared_distance
from kernels.jit import jit_exact, jit_owning
from kernels.rows import grouped, pair

SHELLS = 64  # steps in which distances are told apart


class Pairs(NamedTuple):
    """Node-segment pairs that share no node.

    node (n,), edge (n,): indices. distance (n,): at least so far apart were they when they were
    listed, m, ascending. weight (n,):
    contact length in m, 0 where only crossing is watched. d_contact (n,): distance at which contact
    starts, m. subtract (n, 2): 1 where the contribution of that end of the segment is counted by
    another segment already. touching (n,), count (1,): those in contact when last evaluated.
    """

    node: np.ndarray
    edge: np.ndarray
    distance: np.ndarray
    weight: np.ndarray
    d_contact: np.ndarray
    subtract: np.ndarray
    touching: np.ndarray
    count: np.ndarray


@jit_owning
def _binned(x, n_nodes, grid):
    """Return (start, order): the nodes of cell c are order[start[c]:start[c + 1]]."""
    low_x, low_y, cell, nx, ny = grid
    home = np.empty(n_nodes, np.int64)
    for p in range(n_nodes):
        home[p] = int((x[2 * p + 1] - low_y) / cell) * nx + int((x[2 * p] - low_x) / cell)
    return grouped(home, nx * ny)


@jit_exact
def _grid(x, n_nodes, cell):
    """Return the lower corner of a grid over all nodes, its cell (grown if too many) and size."""
    low_x, low_y = np.inf, np.inf
    high_x, high_y = -np.inf, -np.inf
    for p in range(n_nodes):
        low_x, high_x = min(low_x, x[2 * p]), max(high_x, x[2 * p])
        low_y, high_y = min(low_y, x[2 * p + 1]), max(high_y, x[2 * p + 1])
    area = (high_x - low_x) * (high_y - low_y)
    cell = max(cell, np.sqrt(area / (4.0 * n_nodes)), max(high_x - low_x, high_y - low_y) * 1e-3)
    return low_x, low_y, cell, int((high_x - low_x) / cell) + 1, int((high_y - low_y) / cell) + 1


@jit_exact
def _span(x, c, a, b, radius, low, cell, most):
    """Return the first and the last cell along axis ``c`` within ``radius`` of segment a-b."""
    one, two = x[2 * a + c], x[2 * b + c]
    first = int((min(one, two) - radius - low) / cell)
    return max(first, 0), min(int((max(one, two) + radius - low) / cell), most - 1)


@jit_exact
def _list(x, edges, radius, grid, bins, node, edge, distance):
    """Write the pairs as far as there is room; return their number."""
    low_x, low_y, cell, nx, ny = grid
    start, order = bins
    count = 0
    for k in range(edges.shape[0]):
        a, b = pair(edges, k)
        left, right = _span(x, 0, a, b, radius, low_x, cell, nx)
        down, up = _span(x, 1, a, b, radius, low_y, cell, ny)
        for row in range(down, up + 1):
            for q in range(start[row * nx + left], start[row * nx + right + 1]):
                p = order[q]
                if p == a or p == b:
                    continue
                d2 = squared_distance(x, p, a, b)
                if d2 < radius * radius:
                    if count < node.size:
                        node[count], edge[count], distance[count] = p, k, np.sqrt(d2)
                    count += 1
    return count


@jit_owning
def near(x, n_nodes, edges, radius):
    """Return (node, edge, distance) of the pairs closer than ``radius`` (m) that share no node."""
    grid = _grid(x, n_nodes, radius)
    bins = _binned(x, n_nodes, grid)
    count = 8 * n_nodes
    while True:
        node, edge = np.empty(count, np.int64), np.empty(count, np.int64)
        distance = np.empty(count)
        count = _list(x, edges, radius, grid, bins, node, edge, distance)
        if count <= node.size:
            return node[:count], edge[:count], distance[:count]


@jit_owning
def find(x, contact, radius):
    """Return the `Pairs` closer than ``radius`` at ``x``, with the weights of ``contact``."""
    listed = near(x, contact.tributary.size, contact.edges, radius)
    n = listed[0].size
    shell = np.empty(n, np.int64)
    for k in range(n):
        shell[k] = min(int(listed[2][k] / radius * SHELLS), SHELLS - 1)
    _, nearest = grouped(shell, SHELLS)
    node, edge, distance = np.empty(n, np.int64), np.empty(n, np.int64), np.empty(n)
    weight, d_contact, subtract = np.empty(n), np.empty(n), np.empty((n, 2))
    for k in range(n):
        p, e = listed[0][nearest[k]], listed[1][nearest[k]]
        node[k], edge[k], distance[k] = p, e, shell[nearest[k]] * radius / SHELLS
        weight[k] = contact.tributary[p]
        d_contact[k] = 0.5 * (contact.node_thickness[p] + contact.edge_thickness[e])
        subtract[k, 0], subtract[k, 1] = contact.subtract[e, 0], contact.subtract[e, 1]
        for q in range(contact.special_start[p], contact.special_start[p + 1]):
            if contact.special_edge[q] == e:
                weight[k] = contact.special_weight[q]
                d_contact[k] = contact.special_distance[q]
                subtract[k, 0] = contact.special_subtract[q, 0]
                subtract[k, 1] = contact.special_subtract[q, 1]
    touching, count = np.empty(n, np.int64), np.zeros(1, np.int64)
    return Pairs(node, edge, distance, weight, d_contact, subtract, touching, count)


@jit_exact
def within(pairs, radius):
    """Return how many of the first pairs may be nearer than ``radius`` (m)."""
    low, high = 0, pairs.distance.size
    while low < high:
        middle = (low + high) // 2
        if pairs.distance[middle] < radius:
            low = middle + 1
        else:
            high = middle
    return low


@jit_owning
def empty():
    """Return no pairs."""
    none, nothing = np.empty(0, np.int64), np.empty(0)
    count = np.zeros(1, np.int64)
    return Pairs(none, none, nothing, nothing, nothing, np.empty((0, 2)), none, count)


@jit_exact
def farthest(x, other, n_nodes):
    """Return the largest distance that a node has moved between ``x`` and ``other``."""
    most = 0.0
    for p in range(n_nodes):
        mx, my = x[2 * p] - other[2 * p], x[2 * p + 1] - other[2 * p + 1]
        most = max(most, mx * mx + my * my)
    return np.sqrt(most)
