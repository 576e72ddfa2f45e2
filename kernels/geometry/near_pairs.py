"""Broad phase of contact: neighbour lists of nodes and segments from a grid of cells.

A list with a margin stays valid until some node has moved by half of the margin.
"""

from typing import NamedTuple

import numpy as np

from kernels.arrays import first_at_least, grouped, pair
from kernels.compile.jit import jit_exact, jit_owning
from kernels.geometry.distance import squared_distance

SHELLS = 64  # number of classes of distance into which pairs are sorted
CELLS_PER_RADIUS = 3.0  # cells per radius: larger cells contain more nodes that are too far away


class Pairs(NamedTuple):
    """Node-segment pairs that share no node.

    node (n,), edge (n,): indices. distance (n,): lower bound of their distance when they were
    listed, m, ascending. d_contact (n,): distance at which the barrier starts, m; 0 where collision
    detection alone prevents crossing. rule (n,): index among the special pairs of
    `contact.Contact`, -1 if none.
    """

    node: np.ndarray
    edge: np.ndarray
    distance: np.ndarray
    d_contact: np.ndarray
    rule: np.ndarray


@jit_owning
def _nodes_by_cell(x, n_nodes, grid):
    """Return (start, order): the nodes of cell c are order[start[c]:start[c + 1]]."""
    low_x, low_y, cell, nx, ny = grid
    home = np.empty(n_nodes, np.int64)
    for p in range(n_nodes):
        home[p] = int((x[2 * p + 1] - low_y) / cell) * nx + int((x[2 * p] - low_x) / cell)
    return grouped(home, nx * ny)


@jit_exact
def _grid(x, n_nodes, cell):
    """Return (low_x, low_y, cell, nx, ny) of a grid over all nodes.

    cell: size of a cell, m, increased where the grid would have too many.
    """
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
def _cells(x, a, b, radius, grid):
    """Return the columns and rows of cells, first and last, within ``radius`` of segment a-b."""
    low_x, low_y, cell, nx, ny = grid
    left, right = _span(x, 0, a, b, radius, low_x, cell, nx)
    down, up = _span(x, 1, a, b, radius, low_y, cell, ny)
    return left, right, down, up


@jit_exact
def _bound(x, edges, radius, grid, start):
    """Return an upper bound of the number of pairs: the nodes in all cells that segments reach."""
    count, nx = 0, grid[3]
    for k in range(edges.shape[0]):
        a, b = pair(edges, k)
        left, right, down, up = _cells(x, a, b, radius, grid)
        for row in range(down, up + 1):
            count += start[row * nx + right + 1] - start[row * nx + left]
    return count


@jit_exact
def _fill(x, edges, radius, grid, bins, node, edge, distance):
    """Write the pairs closer than ``radius``, edge by edge; return their number."""
    start, order = bins
    count, nx = 0, grid[3]
    for k in range(edges.shape[0]):
        a, b = pair(edges, k)
        left, right, down, up = _cells(x, a, b, radius, grid)
        for row in range(down, up + 1):
            for q in range(start[row * nx + left], start[row * nx + right + 1]):
                p = order[q]
                if p == a or p == b:
                    continue
                d2 = squared_distance(x, p, a, b)
                if d2 < radius * radius:
                    node[count], edge[count], distance[count] = p, k, np.sqrt(d2)
                    count += 1
    return count


@jit_owning
def near(x, n_nodes, edges, radius):
    """Return (node, edge, distance) of the pairs closer than ``radius`` (m) that share no node, by
    ascending edge.
    """
    grid = _grid(x, n_nodes, radius / CELLS_PER_RADIUS)
    bins = _nodes_by_cell(x, n_nodes, grid)
    room = _bound(x, edges, radius, grid, bins[0])
    node, edge, distance = np.empty(room, np.int64), np.empty(room, np.int64), np.empty(room)
    count = _fill(x, edges, radius, grid, bins, node, edge, distance)
    return node[:count], edge[:count], distance[:count]


@jit_exact
def _find_rules(node, edge, contact, at, rule):
    """Fill ``rule`` of pairs sorted by ``edge``; ``at`` (n_nodes,): scratch filled with -1."""
    k = 0
    for e in range(contact.edges.shape[0]):
        start, end = contact.special_start[e], contact.special_start[e + 1]
        for q in range(start, end):
            at[contact.special_node[q]] = q
        while k < edge.size and edge[k] == e:
            rule[k] = at[node[k]]
            k += 1
        for q in range(start, end):
            at[contact.special_node[q]] = -1


@jit_exact
def _distance(contact, p, e, rule):
    """Return the distance at which contact of a pair starts, m; 0 if it has none."""
    if rule >= 0:
        return contact.special_distance[rule]
    mean = 0.5 * (contact.node_thickness[p] + contact.edge_thickness[e])
    return mean if contact.tributary[p] > 0.0 else 0.0


@jit_owning
def find(x, contact, radius):
    """Return the `Pairs` closer than ``radius`` at ``x``, with the rules of ``contact``."""
    listed = near(x, contact.tributary.size, contact.edges, radius)
    n = listed[0].size
    shell, rules = np.empty(n, np.int64), np.empty(n, np.int64)
    _find_rules(listed[0], listed[1], contact, np.full(contact.tributary.size, -1), rules)
    for k in range(n):
        shell[k] = min(int(listed[2][k] / radius * SHELLS), SHELLS - 1)
    _, nearest = grouped(shell, SHELLS)
    node, edge, distance = np.empty(n, np.int64), np.empty(n, np.int64), np.empty(n)
    d_contact, rule = np.empty(n), np.empty(n, np.int64)
    for k in range(n):
        q = nearest[k]
        node[k], edge[k], rule[k] = listed[0][q], listed[1][q], rules[q]
        distance[k] = shell[q] * radius / SHELLS
        d_contact[k] = _distance(contact, node[k], edge[k], rule[k])
    return Pairs(node, edge, distance, d_contact, rule)


@jit_exact
def is_guarded(pairs, k, contact):
    """Return whether pair ``k`` is near a joint, and exerts no force but must not cross."""
    return pairs.rule[k] >= 0 and contact.special_weight[pairs.rule[k]] == 0.0


@jit_exact
def counted(pairs, k, contact):
    """Return the contact length of pair ``k`` in m, and for each end of its segment 1 if another
    segment counts the contribution of that end, else 0.
    """
    q, e = pairs.rule[k], pairs.edge[k]
    if is_guarded(pairs, k, contact):
        return contact.tributary[pairs.node[k]], 0.0, 0.0
    if q >= 0:
        ends = contact.special_subtract
        return contact.special_weight[q], ends[q, 0], ends[q, 1]
    return contact.tributary[pairs.node[k]], contact.subtract[e, 0], contact.subtract[e, 1]


@jit_exact
def within(pairs, radius):
    """Return the number of pairs, the first ones in the list, that may be nearer than ``radius``
    (m).
    """
    return first_at_least(pairs.distance, radius, 0, pairs.distance.size)


@jit_owning
def empty():
    """Return a list without pairs."""
    none, nothing = np.empty(0, np.int64), np.empty(0)
    return Pairs(none, none, nothing, nothing, none)


@jit_exact
def longest(move, n_nodes):
    """Return the longest move of a node in ``move`` (n,), m."""
    most = 0.0
    for p in range(n_nodes):
        mx, my = move[2 * p], move[2 * p + 1]
        most = max(most, mx * mx + my * my)
    return np.sqrt(most)


@jit_exact
def farthest(x, other, n_nodes):
    """Return the longest move of a node between ``other`` and ``x``, m."""
    most = 0.0
    for p in range(n_nodes):
        mx, my = x[2 * p] - other[2 * p], x[2 * p + 1] - other[2 * p + 1]
        most = max(most, mx * mx + my * my)
    return np.sqrt(most)
