"""Couplings of nodes that may soon share a term of the energy, and need room in the matrix."""

import numpy as np

from kernels.arrays import pair, triple
from kernels.compile.jit import jit_exact, jit_owning
from kernels.terms import fold, profile
from kernels.terms.contact import platens_of

MARGIN = 0.2  # of the contact distance: pairs within it have room before they touch; a larger share
# fills the matrix, a smaller one has it analysed more often


@jit_exact
def _couple(nodes, n, a, b, c):
    """Write a triple of nodes at row ``n``; return the next row."""
    nodes[n, 0], nodes[n, 1], nodes[n, 2] = a, b, c
    return n + 1


@jit_exact
def _node(layout, c):
    """Return the node of the position coordinate ``c``; n_nodes for a platen."""
    return c // 2 if c < 2 * layout.n_nodes else layout.n_nodes


@jit_owning
def couplings(x, scene, pairs, lagged_contacts):
    """Return the couplings (c, 3) of contacts, lagged contacts, springs, folds and profiles.

    A coupling of fewer than three nodes repeats one. The platens are node n_nodes.
    """
    layout, reach, profiles = scene.layout, 1.0 + MARGIN, scene.contact.profiles
    size = pairs.node.size + lagged_contacts.count[0] + scene.fold.limit.size
    size += 2 * scene.contact.platen_nodes.size + scene.spring.l0.size + profile.room(profiles)
    nodes, n = np.empty((size, 3), np.int64), 0
    for k in range(pairs.node.size):
        if pairs.distance[k] < reach * pairs.d_contact[k]:
            a, b = pair(scene.contact.edges, pairs.edge[k])
            n = _couple(nodes, n, pairs.node[k], a, b)
    for k in range(lagged_contacts.count[0]):
        a, b, c = triple(lagged_contacts.points, k)
        n = _couple(nodes, n, _node(layout, a), _node(layout, b), _node(layout, c))
    for k in range(scene.spring.l0.size):
        a, b = pair(scene.spring.nodes, k)
        n = _couple(nodes, n, a, a, b)
    for k in range(scene.fold.limit.size):
        if fold.opening(x, scene.fold, k) < 2.0 * scene.fold.limit[k]:
            a, b, c = triple(scene.fold.nodes, k)
            n = _couple(nodes, n, a, b, c)
    for platen, side, away in platens_of(scene.contact):
        if layout.leader[platen] >= 0 and layout.driven < 0:
            for p in scene.contact.platen_nodes:
                gap = side * (x[2 * p + 1] - x[platen]) + away
                if gap < 0.5 * reach * scene.contact.node_thickness[p]:
                    n = _couple(nodes, n, p, p, layout.n_nodes)
    return nodes[: _couple_profiles(x, profiles, layout.n_nodes, nodes, n)]


@jit_exact
def _couple_profiles(x, profiles, platen, nodes, n):
    """Write the couplings of nodes and elements with profiles; return the next row."""
    reach = 1.0 + MARGIN
    for k in range(profiles.radius.size):
        for p in profiles.nodes:
            far = reach * profiles.node_half[p]
            if profile.near_node(x, profiles, k, p, far)[2] < far:
                n = _couple(nodes, n, p, p, platen)
        for i in range(profiles.start[k], profiles.start[k + 1]):
            for e in range(profiles.edges.shape[0] if profiles.weight[i] > 0.0 else 0):
                far = reach * profiles.edge_half[e]
                if profile.near_element(x, profiles, k, i, e, far)[3] < far:
                    a, b = pair(profiles.edges, e)
                    n = _couple(nodes, n, a, b, platen)
    return n
