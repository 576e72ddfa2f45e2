"""Couplings of nodes that may soon share a term of the energy: room for them in the matrix."""

import numpy as np

from kernels.arrays import pair, triple
from kernels.compile.jit import jit_exact, jit_owning
from kernels.terms import fold

MARGIN = 0.2  # of the contact distance, within which a pair gets room before it touches: a larger
# one fills the matrix, a smaller one has it analysed more often


@jit_exact
def _couple(nodes, n, a, b, c):
    """Write a triple of nodes at row ``n``; return the next row."""
    nodes[n, 0], nodes[n, 1], nodes[n, 2] = a, b, c
    return n + 1


@jit_owning
def couplings(x, scene, pairs, lagged_contacts):
    """Return the couplings (c, 3) of contacts, lagged contacts, springs and folds.

    A coupling of fewer than three nodes repeats one. The platens are node n_nodes.
    """
    layout, reach = scene.layout, 1.0 + MARGIN
    size = pairs.node.size + lagged_contacts.count[0] + scene.fold.limit.size
    size += 2 * scene.contact.platen_nodes.size + scene.spring.l0.size
    nodes, n = np.empty((size, 3), np.int64), 0
    for k in range(pairs.node.size):
        if pairs.distance[k] < reach * pairs.d_contact[k]:
            a, b = pair(scene.contact.edges, pairs.edge[k])
            n = _couple(nodes, n, pairs.node[k], a, b)
    for k in range(lagged_contacts.count[0]):
        n = _couple(
            nodes,
            n,
            lagged_contacts.nodes[k, 0],
            lagged_contacts.nodes[k, 1],
            lagged_contacts.nodes[k, 2],
        )
    for k in range(scene.spring.l0.size):
        a, b = pair(scene.spring.nodes, k)
        n = _couple(nodes, n, a, a, b)
    for k in range(scene.fold.limit.size):
        if fold.opening(x, scene.fold, k) < 2.0 * scene.fold.limit[k]:
            a, b, c = triple(scene.fold.nodes, k)
            n = _couple(nodes, n, a, b, c)
    for platen, side in ((scene.contact.low, 1.0), (scene.contact.high, -1.0)):
        if layout.leader[platen] >= 0 and layout.driven < 0:
            for p in scene.contact.platen_nodes:
                gap = side * (x[2 * p + 1] - x[platen])
                if gap < 0.5 * reach * scene.contact.node_thickness[p]:
                    n = _couple(nodes, n, p, p, layout.n_nodes)
    return nodes[:n]
