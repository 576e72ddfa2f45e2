"""Contact rules of node-segment pairs near joints, where walls touch without being in contact.

Parts that touch must have been apart. The face of a wall can be bent to a point but not shortened
further, so that the centre line turns by at most 2 / t per length, t the mean thickness. Parts of
walls may therefore come to face each other only if the path s between them along the network is
longer than

    D = t [pi/2 + |c|],   c = sum (tan(tau/2) - tau/2)   over the turns tau of the path,

pi t / 2 along a straight wall, 1.79 t round a right angle, 2.26 t if two arms are 60 degrees apart.
(To face each other the parts turn by pi in all. The corner is already a turn of tau, at which the
inner face is shorter than the centre line by t tan(tau/2). The rest, pi - tau, takes a length of at
least t (pi - tau) / 2.) A pair is weighted by the part of the node's tributary length that is
farther than D from the segment.

Walls that meet at an angle touch with centre lines less than t apart: the faces of two straight
arms with the opening gamma are in contact up to t / (2 tan(gamma/2)) from the joint, where centre
lines are t cos(gamma/2) apart. In terms of the path, contact starts at

    t_c = t s / sqrt(s^2 + t^2).

Where only part of a node's length counts, s is the mean of the paths to that part. The node itself
is nearer to the joint than this part: t_c is reduced by the ratio of the path to the node to s.
Parts of two arms at rest that are farther apart than D along the path are apart by more than t in
the plane: by D sin(gamma/2) = t [cos(gamma/2) + gamma/2 sin(gamma/2)]. Contact of walls that are
printed into each other starts at 0.9 x their rest distance, so that the rest state is free of
stress. A pair of weight 0 is no contact, but a barrier keeps it from crossing. It acts below 0.2 x
the rest distance, or below t_c if that is less; collision detection alone would stop every move
that presses the pair. The rules are evaluated once for a scene.
"""

import math
from typing import NamedTuple

import numpy as np

from kernels.arrays import greatest, grouped, pair
from kernels.compile.jit import jit_exact, jit_owning
from kernels.geometry.distance import direction, squared_distance
from kernels.geometry.near_pairs import near

REST_SHARE = 0.9
GUARDED_SHARE = 0.2  # of the rest distance: where a barrier keeps pairs of weight 0 from crossing
FAR = 5.0  # s / t beyond which t_c = t: it would be less than 2 % smaller
UNLISTED = -1.0  # weight of an edge without a rule


class Graph(NamedTuple):
    """The network: edges (m, 2) of lengths l0 (m,), m.

    The edges at node p, ascending, are incident[start[p]:start[p + 1]], d of them; place (m, 2): of
    an edge among the edges at its ends. At node p, corner[first[p] + d i + j] is tan(tau/2) - tau/2
    of the path along the edge at place i and then along the edge at place j.
    """

    edges: np.ndarray
    l0: np.ndarray
    start: np.ndarray
    incident: np.ndarray
    place: np.ndarray
    first: np.ndarray
    corner: np.ndarray


class Paths(NamedTuple):
    """Shortest paths from an edge. By node: length (n,), m, infinite without a path; the last edge
    (n,) and the sum c (n,) up to that edge. reached (n,): nodes with a path. queue, queued (n,):
    scratch.
    """

    length: np.ndarray
    last: np.ndarray
    corners: np.ndarray
    reached: np.ndarray
    queue: np.ndarray
    queued: np.ndarray


class Reduced(NamedTuple):
    """Pairs near along the network: the first ``count`` (1,) entries. weight: contact length, m.

    share (k,): t_c / t.
    """

    node: np.ndarray
    edge: np.ndarray
    weight: np.ndarray
    share: np.ndarray
    count: np.ndarray


class Rules(NamedTuple):
    """Rules of pairs; the rules of edge e are start[e] .. start[e + 1].

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
def _other(graph, k, p):
    """Return the end of edge ``k`` that is not node ``p``."""
    return graph.edges[k, 0] + graph.edges[k, 1] - p


@jit_exact
def _corner(x, edges, k, p, following):
    """Return tan(tau/2) - tau/2 of the path along edge ``k`` to node ``p``, then ``following``."""
    before = edges[k, 0] + edges[k, 1] - p
    after = edges[following, 0] + edges[following, 1] - p
    ux, uy, _ = direction(x, before, p)
    vx, vy, _ = direction(x, p, after)
    half = 0.5 * math.atan2(ux * vy - uy * vx, ux * vx + uy * vy)
    return math.tan(half) - half


@jit_owning
def _graph(x, n_nodes, edges, l0):
    """Return the `Graph` of a network at rest at ``x``."""
    start, incident = incidence(n_nodes, edges)
    place, first = np.empty(edges.shape, np.int64), np.zeros(n_nodes + 1, np.int64)
    for p in range(n_nodes):
        first[p + 1] = first[p] + (start[p + 1] - start[p]) ** 2
        for q in range(start[p], start[p + 1]):
            k = incident[q]
            place[k, 0 if edges[k, 0] == p else 1] = q - start[p]
    corner, n = np.zeros(first[n_nodes]), 0
    for p in range(n_nodes):
        for q in range(start[p], start[p + 1]):
            for r in range(start[p], start[p + 1]):
                if q != r:
                    corner[n] = _corner(x, edges, incident[q], p, incident[r])
                n += 1
    return Graph(edges, l0, start, incident, place, first, corner)


@jit_exact
def _corners(graph, paths, p, k):
    """Return c of the path to node ``p`` and on along edge ``k``, if it does not arrive along
    ``k``.
    """
    last = paths.last[p]
    i = graph.place[last, 0 if graph.edges[last, 0] == p else 1]
    j = graph.place[k, 0 if graph.edges[k, 0] == p else 1]
    degree = graph.start[p + 1] - graph.start[p]
    return paths.corners[p] + graph.corner[graph.first[p] + degree * i + j]


@jit_exact
def _least_path(corners):
    """Return D / t for the sum c of a path."""
    return 0.5 * math.pi + abs(corners)


@jit_exact
def _longest_path(graph):
    """Return the largest D / t of paths that turn by no more than pi in all.

    c grows faster than in proportion to the turn: no such path has more than two turns as sharp as
    the sharpest one, or as a right angle.
    """
    sharpest = 1.0 - 0.25 * math.pi
    for c in graph.corner:
        sharpest = max(sharpest, abs(c))
    return _least_path(2.0 * sharpest)


@jit_exact
def _find_paths(e, radius, graph, paths):
    """Find the ``paths`` from edge ``e`` up to the length ``radius``; return the number of nodes.

    Shortest paths by label correction. A node is in the queue at most once at a time, which cannot
    overflow.
    """
    reached, queue, length = paths.reached, paths.queue, paths.length
    for i in range(2):
        p = graph.edges[e, i]
        reached[i], queue[i] = p, p
        length[p], paths.last[p], paths.corners[p] = 0.0, e, 0.0
    head, tail, count = 0, 2, 2
    while head < tail:
        p = queue[head % queue.size]
        head, paths.queued[p] = head + 1, False
        for q in range(graph.start[p], graph.start[p + 1]):
            k = graph.incident[q]
            other, through = _other(graph, k, p), length[p] + graph.l0[k]
            if through < length[other] and through <= radius:
                if length[other] == np.inf:
                    reached[count] = other
                    count += 1
                paths.corners[other] = _corners(graph, paths, p, k)
                length[other], paths.last[other] = through, k
                if not paths.queued[other]:
                    queue[tail % queue.size], paths.queued[other] = other, True
                    tail += 1
    return count


@jit_exact
def _half(p, k, t, graph, paths):
    """Return the part of the half of edge ``k`` at node ``p`` that is farther than D: its length,
    and the mean length of the paths to it.

    Both ways to a point have to be long enough, via ``p`` and via the other end of ``k``.
    """
    l0, near_end, far_end = graph.l0[k], paths.length[p], np.inf
    low, high = t * _least_path(_corners(graph, paths, p, k)) - near_end, 0.5 * l0
    other = _other(graph, k, p)
    if paths.length[other] < np.inf:
        far_end = paths.length[other] + l0
        high = min(high, far_end - t * _least_path(_corners(graph, paths, other, k)))
    low = max(low, 0.0)
    middle = 0.5 * (low + high)
    return max(high - low, 0.0), min(near_end + middle, far_end - middle)


@jit_exact
def _counted_part(p, e, t, graph, paths):
    """Return the contact length of node ``p`` against edge ``e``, and t_c / t."""
    length, moment = 0.0, 0.0
    for q in range(graph.start[p], graph.start[p + 1]):
        if graph.incident[q] != e:
            part, path = _half(p, graph.incident[q], t, graph, paths)
            length += part
            moment += part * path
    if not 0.0 < moment < (1.0 - 1e-12) * FAR * t * length:
        return length, 1.0
    path = moment / length
    return length, min(paths.length[p], path) / math.hypot(path, t)


@jit_exact
def _reduce(graph, node_thickness, edge_thickness, tributary, paths, rows):
    """Write the pairs near along the network to ``rows`` as far as there is room; count all."""
    thickest, farthest, count = greatest(node_thickness), max(FAR, _longest_path(graph)), 0
    longest = greatest(graph.l0)
    for e in range(graph.edges.shape[0]):
        radius = farthest * 0.5 * (edge_thickness[e] + thickest) + longest
        n_reached = _find_paths(e, radius, graph, paths)
        for i in range(2, n_reached):
            p = paths.reached[i]
            t = 0.5 * (edge_thickness[e] + node_thickness[p])
            weight, share = _counted_part(p, e, t, graph, paths)
            if weight < (1.0 - 1e-12) * tributary[p] or share < 1.0:
                if count < rows.node.size:
                    rows.node[count], rows.edge[count] = p, e
                    rows.weight[count] = weight if weight > 1e-9 * tributary[p] else 0.0
                    rows.share[count] = share
                count += 1
        for i in range(n_reached):
            paths.length[paths.reached[i]] = np.inf
    rows.count[0] = count


@jit_owning
def _reduced(graph, node_thickness, edge_thickness, tributary):
    """Return the pairs of reduced weight or distance."""
    n = tributary.size
    paths = Paths(
        np.full(n, np.inf), np.empty(n, np.int64), np.empty(n), np.empty(n, np.int64),
        np.empty(n, np.int64), np.zeros(n, np.bool_),
    )  # fmt: skip
    size = 16 * n
    while True:
        rows = Reduced(
            np.empty(size, np.int64), np.empty(size, np.int64), np.empty(size), np.empty(size),
            np.zeros(1, np.int64),
        )  # fmt: skip
        _reduce(graph, node_thickness, edge_thickness, tributary, paths, rows)
        size = rows.count[0]
        if size <= rows.node.size:
            return rows


@jit_exact
def _list_edge(k, value, share, weight, shares, listed, count):
    """List edge ``k`` with a contact length ``value`` and ``share`` unless it is listed already;
    return the count.
    """
    if weight[k] == UNLISTED:
        weight[k], shares[k] = value, share
        listed[count] = k
        return count + 1
    return count


@jit_exact
def _entries(p, graph, tributary, reduced, near_pairs, weight, shares, listed):
    """List the edges with rules for node ``p``; return their number.

    These edges are near along the network or across it, or share a vertex with such an edge.
    """
    count = 0
    start, order, rows = reduced
    for q in range(start[p], start[p + 1]):
        k = order[q]
        count = _list_edge(
            rows.edge[k], rows.weight[k], rows.share[k], weight, shares, listed, count
        )
    start, order, edge = near_pairs
    for q in range(start[p], start[p + 1]):
        count = _list_edge(edge[order[q]], tributary[p], 1.0, weight, shares, listed, count)
    for i in range(count):
        for v in graph.edges[listed[i]]:
            for q in range(graph.start[v], graph.start[v + 1]):
                k = graph.incident[q]
                if graph.edges[k, 0] != p and graph.edges[k, 1] != p:
                    count = _list_edge(k, tributary[p], 1.0, weight, shares, listed, count)
    return count


@jit_exact
def _is_counted(p, e, v, graph, weight):
    """Return whether another edge, with the largest weight, counts vertex ``v`` of edge ``e``."""
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
    graph = _graph(x, n, edges, l0)
    rows = _reduced(graph, node_thickness, edge_thickness, tributary)
    start, order = grouped(rows.node[: rows.count[0]], n)
    reduced = start, order, rows
    widest = max(greatest(node_thickness), greatest(edge_thickness))
    node, edge, _ = near(x, n, edges, widest)
    start, order = grouped(node, n)
    near_pairs = start, order, edge
    weight, shares, listed = np.full(m, UNLISTED), np.empty(m), np.empty(m, np.int64)
    first = np.zeros(m + 1, np.int64)
    for p in range(n):
        for i in range(_entries(p, graph, tributary, reduced, near_pairs, weight, shares, listed)):
            first[listed[i] + 1] += 1
            weight[listed[i]] = UNLISTED
    for e in range(m):
        first[e + 1] += first[e]
    size, free = first[m], first.copy()
    rules = Rules(
        first, np.empty(size, np.int64), np.empty(size), np.empty(size), np.empty((size, 2))
    )
    for p in range(n):
        count = _entries(p, graph, tributary, reduced, near_pairs, weight, shares, listed)
        for i in range(count):
            e, k = listed[i], free[listed[i]]
            free[e] += 1
            a, b = pair(edges, e)
            starts = shares[e] * 0.5 * (node_thickness[p] + edge_thickness[e])
            rest = np.sqrt(squared_distance(x, p, a, b))
            rules.node[k], rules.weight[k] = p, weight[e]
            rules.distance[k] = starts if rest >= starts else REST_SHARE * rest
            if weight[e] == 0.0:
                guarded = min(GUARDED_SHARE * rest, starts)
                rules.distance[k] = guarded if tributary[p] > 0.0 else 0.0
            rules.subtract[k, 0] = 1.0 if _is_counted(p, e, a, graph, weight) else 0.0
            rules.subtract[k, 1] = 1.0 if _is_counted(p, e, b, graph, weight) else 0.0
        for i in range(count):
            weight[listed[i]] = UNLISTED
    return rules
