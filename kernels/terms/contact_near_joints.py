"""Contact rules of node-segment pairs near joints, where walls touch without being in contact.

A pair is weighted by the part of the node's tributary length that is farther than 1.5 t along the
network from the segment, t the mean thickness. Contact of a pair nearer than t at rest starts at
0.9 x its rest distance, so that the rest state is free of stress. Evaluated once for a scene.
"""

from typing import NamedTuple

import numpy as np

from kernels.arrays import greatest, grouped, pair
from kernels.compile.jit import jit_exact, jit_owning
from kernels.geometry.distance import squared_distance
from kernels.geometry.near_pairs import near

RADIUS = 1.5  # times the mean thickness, along the network
REST_SHARE = 0.9
UNLISTED = -1.0  # weight of an edge without a rule


class Graph(NamedTuple):
    """The network: edges (m, 2) of lengths l0 (m,), m. The edges at node p, ascending, are
    incident[start[p]:start[p + 1]].
    """

    edges: np.ndarray
    l0: np.ndarray
    start: np.ndarray
    incident: np.ndarray


class Reduced(NamedTuple):
    """Pairs of reduced weight (contact length, m): the first ``count`` (1,) entries."""

    node: np.ndarray
    edge: np.ndarray
    weight: np.ndarray
    count: np.ndarray


class Rules(NamedTuple):
    """Rules of pairs; those of edge e are start[e] .. start[e + 1].

    node, weight (contact length, m), distance (at which contact starts, m) (s,); subtract (s, 2):
    as in `near_pairs.counted`.
    """

    start: np.ndarray
    node: np.ndarray
    weight: np.ndarray
    distance: np.ndarray
    subtract: np.ndarray


@jit_owning
def incidence(n_nodes, edges):
    """Return (start (n + 1,), incident (2 m,)): the edges at each node, ascending."""
    start, incident = grouped(edges.ravel(), n_nodes)
    for q in range(incident.size):
        incident[q] //= 2
    return start, incident


@jit_owning
def owners(n_nodes, edges):
    """Return subtract (m, 2): 0 where an edge is the first at that end, else 1."""
    subtract = np.ones((edges.shape[0], 2))
    start, incident = incidence(n_nodes, edges)
    for p in range(n_nodes):
        if start[p + 1] > start[p]:
            k = incident[start[p]]
            subtract[k, 0 if edges[k, 0] == p else 1] = 0.0
    return subtract


@jit_exact
def _network_distances(e, radius, graph, distance, reached, queue, queued):
    """Fill ``distance`` (n,) with distances along the network from edge ``e``, up to ``radius``.

    Return the number of nodes ``reached``; ``distance`` is infinite elsewhere. Shortest paths by
    label correction. A node is in the queue (n,) at most once at a time, which cannot overflow.
    """
    reached[0], reached[1] = pair(graph.edges, e)
    queue[0], queue[1] = reached[0], reached[1]
    distance[reached[0]] = distance[reached[1]] = 0.0
    head, tail, count = 0, 2, 2
    while head < tail:
        p = queue[head % queue.size]
        head, queued[p] = head + 1, False
        for q in range(graph.start[p], graph.start[p + 1]):
            k = graph.incident[q]
            other = graph.edges[k, 0] + graph.edges[k, 1] - p
            through = distance[p] + graph.l0[k]
            if through < distance[other] and through <= radius:
                if distance[other] == np.inf:
                    reached[count] = other
                    count += 1
                distance[other] = through
                if not queued[other]:
                    queue[tail % queue.size], queued[other] = other, True
                    tail += 1
    return count


@jit_exact
def _half_weight(near_end, far_end, h, radius):
    """Return the length of a half element (h / 2) that is farther than ``radius`` from a segment.

    near_end, far_end: distances of the two ends of the element from the segment along the network;
    that of a point s from the near end is min(near_end + s, far_end + h - s).
    """
    low = max(0.0, radius - near_end)
    high = min(0.5 * h, h + far_end - radius)
    return max(high - low, 0.0)


@jit_exact
def _weight(p, e, radius, distance, graph):
    """Return the contact length of node ``p`` against edge ``e``, given distances from ``e``."""
    total = 0.0
    for q in range(graph.start[p], graph.start[p + 1]):
        k = graph.incident[q]
        if k != e:
            other = graph.edges[k, 0] + graph.edges[k, 1] - p
            total += _half_weight(distance[p], distance[other], graph.l0[k], radius)
    return total


@jit_exact
def _reduce(
    graph, node_thickness, edge_thickness, tributary, distance, reached, queue, queued, found
):
    """Write the pairs of reduced weight to ``found`` as far as there is room; count all."""
    thickest, longest, count = greatest(node_thickness), greatest(graph.l0), 0
    for e in range(graph.edges.shape[0]):
        widest = RADIUS * 0.5 * (edge_thickness[e] + thickest) + longest
        n_reached = _network_distances(e, widest, graph, distance, reached, queue, queued)
        for i in range(2, n_reached):
            p = reached[i]
            radius = RADIUS * 0.5 * (edge_thickness[e] + node_thickness[p])
            weight = _weight(p, e, radius, distance, graph)
            if weight < (1.0 - 1e-12) * tributary[p]:
                if count < found.node.size:
                    found.node[count], found.edge[count] = p, e
                    found.weight[count] = weight if weight > 1e-9 * tributary[p] else 0.0
                count += 1
        for i in range(n_reached):
            distance[reached[i]] = np.inf
    found.count[0] = count


@jit_owning
def _reduced(graph, node_thickness, edge_thickness, tributary):
    """Return the pairs of reduced weight."""
    n = tributary.size
    distance, reached = np.full(n, np.inf), np.empty(n, np.int64)
    queue, queued, size = np.empty(n, np.int64), np.zeros(n, np.bool_), 8 * n
    while True:
        found = Reduced(
            np.empty(size, np.int64), np.empty(size, np.int64), np.empty(size),
            np.zeros(1, np.int64),
        )  # fmt: skip
        _reduce(
            graph,
            node_thickness,
            edge_thickness,
            tributary,
            distance,
            reached,
            queue,
            queued,
            found,
        )
        size = found.count[0]
        if size <= found.node.size:
            return found


@jit_exact
def _append(k, value, weight, listed, count):
    """Append edge ``k`` with contact length ``value`` unless it is listed; return the count."""
    if weight[k] == UNLISTED:
        weight[k] = value
        listed[count] = k
        return count + 1
    return count


@jit_exact
def _entries(p, graph, tributary, reduced, near_pairs, weight, listed):
    """List the edges with rules for node ``p``; return their number.

    They are near along the network or across it, or share a vertex with such an edge.
    """
    count = 0
    for start, order, edge, value in reduced, near_pairs:
        for q in range(start[p], start[p + 1]):
            count = _append(edge[order[q]], value[order[q]], weight, listed, count)
    for i in range(count):
        for v in graph.edges[listed[i]]:
            for q in range(graph.start[v], graph.start[v + 1]):
                k = graph.incident[q]
                if graph.edges[k, 0] != p and graph.edges[k, 1] != p:
                    count = _append(k, tributary[p], weight, listed, count)
    return count


@jit_exact
def _is_counted(p, e, v, graph, weight):
    """Return whether another edge counts vertex ``v`` of edge ``e``: that of the largest weight."""
    for q in range(graph.start[v], graph.start[v + 1]):
        k = graph.incident[q]
        if k != e and weight[k] != UNLISTED:
            if weight[k] > weight[e] or (weight[k] == weight[e] and k < e):
                return True
    first = graph.incident[graph.start[v]]  # counts the vertex if no edge has a rule
    return weight[first] == UNLISTED and graph.edges[first, 0] != p and graph.edges[first, 1] != p


@jit_owning
def special_pairs(x, edges, l0, node_thickness, edge_thickness, tributary):
    """Return the `Rules` of all pairs of reduced weight or distance.

    Every segment that shares a vertex with such a pair has a rule too, so that vertices count once.
    """
    n, m = tributary.size, edges.shape[0]
    start, incident = incidence(n, edges)
    graph = Graph(edges, l0, start, incident)
    found = _reduced(graph, node_thickness, edge_thickness, tributary)
    start, order = grouped(found.node[: found.count[0]], n)
    reduced = start, order, found.edge, found.weight
    widest = max(greatest(node_thickness), greatest(edge_thickness))
    node, edge, length = near(x, n, edges, widest)
    for k in range(node.size):
        length[k] = tributary[node[k]]
    start, order = grouped(node, n)
    near_pairs = start, order, edge, length
    weight, listed = np.full(m, UNLISTED), np.empty(m, np.int64)
    first = np.zeros(m + 1, np.int64)
    for p in range(n):
        for i in range(_entries(p, graph, tributary, reduced, near_pairs, weight, listed)):
            first[listed[i] + 1] += 1
            weight[listed[i]] = UNLISTED
    for e in range(m):
        first[e + 1] += first[e]
    size, free = first[m], first.copy()
    rules = Rules(
        first, np.empty(size, np.int64), np.empty(size), np.empty(size), np.empty((size, 2))
    )
    for p in range(n):
        count = _entries(p, graph, tributary, reduced, near_pairs, weight, listed)
        for i in range(count):
            e, k = listed[i], free[listed[i]]
            free[e] += 1
            a, b = pair(edges, e)
            t = 0.5 * (node_thickness[p] + edge_thickness[e])
            rest = np.sqrt(squared_distance(x, p, a, b))
            rules.node[k], rules.weight[k] = p, weight[e]
            rules.distance[k] = t if rest >= t else REST_SHARE * rest
            rules.subtract[k, 0] = 1.0 if _is_counted(p, e, a, graph, weight) else 0.0
            rules.subtract[k, 1] = 1.0 if _is_counted(p, e, b, graph, weight) else 0.0
        for i in range(count):
            weight[listed[i]] = UNLISTED
    return rules
