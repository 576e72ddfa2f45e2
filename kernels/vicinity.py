"""Joints are not contacts: weights of the node-segment pairs that are near along the network.

A pair is weighted by the part of the node's tributary length that is farther than 1.5 t along the
network from the segment; a pair nearer than t at rest touches at 0.9 x its rest distance, so that
the rest state is free of stress. Run once for a scene.
"""

import numpy as np

from kernels.distance import squared_distance
from kernels.jit import jit_owning
from kernels.pairs import near

RADIUS = 1.5  # times the mean thickness, along the network
REST_SHARE = 0.9


@jit_owning
def incidence(n_nodes, edges):
    """Return (start (n + 1,), incident (2 m,)): the edges at each node, ascending."""
    start = np.zeros(n_nodes + 1, np.int64)
    for k in range(edges.shape[0]):
        start[edges[k, 0] + 1] += 1
        start[edges[k, 1] + 1] += 1
    for p in range(n_nodes):
        start[p + 1] += start[p]
    fill = start[:-1].copy()
    incident = np.empty(2 * edges.shape[0], np.int64)
    for k in range(edges.shape[0]):
        for p in edges[k]:
            incident[fill[p]] = k
            fill[p] += 1
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


@jit_owning
def _reach_from(source, radius, edges, l0, graph, far, queue):
    """Fill ``far`` with distances along the network up to ``radius``; return the nodes reached.

    Nodes may enter the queue again when a shorter way is found; ``far`` is infinite elsewhere.
    """
    start, incident = graph
    far[source] = 0.0
    reached = [source]
    queue[0] = source
    head, tail = 0, 1
    while head < tail:
        p = queue[head % queue.size]
        head += 1
        for q in range(start[p], start[p + 1]):
            k = incident[q]
            other = edges[k, 0] + edges[k, 1] - p
            through = far[p] + l0[k]
            if through < far[other] and through <= radius:
                if far[other] == np.inf:
                    reached.append(other)
                far[other] = through
                queue[tail % queue.size] = other
                tail += 1
    return reached


@jit_owning
def _half_weight(near_end, far_end, h, radius):
    """Return the length of a half element (h / 2) that is farther than ``radius`` from a segment.

    near_end, far_end: distances along the network of its two ends from the segment; a point s from
    the near end is min(near_end + s, far_end + h - s) away.
    """
    low = max(0.0, radius - near_end)
    high = min(0.5 * h, h + far_end - radius)
    return max(high - low, 0.0)


@jit_owning
def _weight(p, e, radius, far_from_ends, mesh):
    """Return the contact length of node ``p`` against edge ``e``, given distances from e's ends."""
    edges, l0, start, incident = mesh
    total = 0.0
    for q in range(start[p], start[p + 1]):
        k = incident[q]
        if k != e:
            other = edges[k, 0] + edges[k, 1] - p
            total += _half_weight(far_from_ends[p], far_from_ends[other], l0[k], radius)
    return total


@jit_owning
def _near_pairs(edges, l0, node_thickness, edge_thickness, tributary):
    """Return lists (node, edge, weight) of pairs whose weight the network reduces."""
    n = tributary.size
    start, incident = incidence(n, edges)
    mesh = (edges, l0, start, incident)
    longest = l0.max()
    far, queue = np.full(n, np.inf), np.empty(4 * n + 16, np.int64)
    from_segment = np.full(n, np.inf)
    node, edge, weight = [0], [0], [0.0]
    for e in range(edges.shape[0]):
        widest = RADIUS * 0.5 * (edge_thickness[e] + node_thickness.max()) + longest
        touched = [0]
        for end in edges[e]:
            for p in _reach_from(end, widest, edges, l0, (start, incident), far, queue):
                if from_segment[p] == np.inf:
                    touched.append(p)
                from_segment[p] = min(from_segment[p], far[p])
                far[p] = np.inf
        for p in touched[1:]:
            if p != edges[e, 0] and p != edges[e, 1]:
                radius = RADIUS * 0.5 * (edge_thickness[e] + node_thickness[p])
                w = _weight(p, e, radius, from_segment, mesh)
                if w < (1.0 - 1e-12) * tributary[p]:
                    node.append(p)
                    edge.append(e)
                    weight.append(w if w > 1e-9 * tributary[p] else 0.0)
        for p in touched[1:]:
            from_segment[p] = np.inf
    return node[1:], edge[1:], weight[1:]


@jit_owning
def _by_node(n, node):
    """Return (start, order) that sorts pairs by node."""
    start = np.zeros(n + 1, np.int64)
    for p in node:
        start[p + 1] += 1
    for p in range(n):
        start[p + 1] += start[p]
    return start, np.argsort(node, kind="mergesort")


@jit_owning
def _unique_with_neighbours(p, listed, mesh):
    """Return the edges of ``listed`` and all that share a vertex with them, without those at p."""
    edges, _, start, incident = mesh
    found = [np.int64(0)]
    for e in listed:
        for v in edges[e]:
            for q in range(start[v], start[v + 1]):
                k = incident[q]
                if edges[k, 0] != p and edges[k, 1] != p and k not in found[1:]:
                    found.append(k)
    return found[1:]


@jit_owning
def _subtract(p, entries, weights, mesh, subtract):
    """Fill ``subtract``: at each vertex of the entries all but the heaviest segment come off."""
    edges, _, _, _ = mesh
    for i in range(len(entries)):
        for side in range(2):
            v = edges[entries[i], side]
            subtract[i, side] = 0.0
            for j in range(len(entries)):
                e = entries[j]
                if j != i and (edges[e, 0] == v or edges[e, 1] == v):
                    heavier = weights[j] > weights[i]
                    earlier = weights[j] == weights[i] and e < entries[i]
                    if heavier or earlier:
                        subtract[i, side] = 1.0
            if subtract[i, side] == 0.0:
                subtract[i, side] = _full_elsewhere(p, v, entries, i, weights, mesh)


@jit_owning
def _full_elsewhere(p, v, entries, i, weights, mesh):
    """Return 1.0 if an ordinary edge at ``v`` that is not among the entries owns the vertex."""
    edges, _, start, incident = mesh
    first = incident[start[v]]
    for q in range(start[v], start[v + 1]):
        k = incident[q]
        if edges[k, 0] == p or edges[k, 1] == p or k in entries:
            continue
        if k == first:  # the ordinary owner keeps the vertex
            return 1.0
    return 0.0


@jit_owning
def special_pairs(x, edges, l0, node_thickness, edge_thickness, tributary):
    """Return (start, edge, weight, distance, subtract) of all pairs with rules of their own.

    Shapes (n + 1,), (s,), (s,), (s,), (s, 2); lengths in m. Every segment that shares a vertex with
    a pair of reduced weight or distance is listed too, so that vertices are counted once.
    """
    n = tributary.size
    start, incident = incidence(n, edges)
    mesh = (edges, l0, start, incident)
    node, edge, weight = _near_pairs(edges, l0, node_thickness, edge_thickness, tributary)
    near_start, near_order = _by_node(n, np.array(node, dtype=np.int64))
    close_node, close_edge, _ = near(x, n, edges, max(node_thickness.max(), edge_thickness.max()))
    close_start, close_order = _by_node(n, close_node)
    out_start = np.zeros(n + 1, np.int64)
    out_edge, out_weight, out_distance, out_subtract = [0], [0.0], [0.0], [(0.0, 0.0)]
    for p in range(n):
        listed = [np.int64(edge[k]) for k in near_order[near_start[p] : near_start[p + 1]]]
        reduced = [weight[k] for k in near_order[near_start[p] : near_start[p + 1]]]
        for k in close_order[close_start[p] : close_start[p + 1]]:
            if close_edge[k] not in listed:
                listed.append(close_edge[k])
                reduced.append(tributary[p])
        entries = listed[:0]
        if len(listed) > 0:
            entries = _unique_with_neighbours(p, listed, mesh)
        weights = np.full(len(entries), tributary[p])
        for i in range(len(entries)):
            for j in range(len(listed)):
                if listed[j] == entries[i]:
                    weights[i] = reduced[j]
        subtract = np.zeros((len(entries), 2))
        _subtract(p, entries, weights, mesh, subtract)
        for i in range(len(entries)):
            e = entries[i]
            t = 0.5 * (node_thickness[p] + edge_thickness[e])
            rest = np.sqrt(squared_distance(x, p, edges[e, 0], edges[e, 1]))
            out_edge.append(e)
            out_weight.append(weights[i])
            out_distance.append(t if rest >= t else REST_SHARE * rest)
            out_subtract.append((subtract[i, 0], subtract[i, 1]))
        out_start[p + 1] = len(out_edge) - 1
    subtract_array = np.empty((len(out_edge) - 1, 2))
    for k in range(subtract_array.shape[0]):
        subtract_array[k, 0], subtract_array[k, 1] = out_subtract[k + 1]
    return (
        out_start,
        np.array(out_edge[1:]),
        np.array(out_weight[1:]),
        np.array(out_distance[1:]),
        subtract_array,
    )
