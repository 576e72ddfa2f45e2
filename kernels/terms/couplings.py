"""Which nodes may soon share a term of the energy, so that the matrix needs room for them."""

import numpy as np

from kernels.arrays import pair, triple
from kernels.compile.jit import jit_exact, jit_owning
from kernels.terms import fold

LIKELY = 0.2  # of its contact distance: a pair that much farther away gets room; more fills the
# matrix, less has it analysed anew more often


@jit_exact
def _couple(nodes, n, a, b, c):
    """Write the ``n``-th three nodes; return the next number."""
    nodes[n, 0], nodes[n, 1], nodes[n, 2] = a, b, c
    return n + 1


@jit_owning
def couplings(x, scene, found, lagged_contacts):
    """Return (c, 3) nodes of what may soon share a term: contacts, lagged ones, springs, folds."""
    layout, reach = scene.layout, 1.0 + LIKELY
    most = found.node.size + lagged_contacts.count[0] + scene.fold.limit.size
    most += scene.contact.plate_nodes.size + scene.spring.l0.size
    nodes, n = np.empty((most, 3), np.int64), 0
    for k in range(found.node.size):
        if found.distance[k] < reach * found.d_contact[k]:
            a, b = pair(scene.contact.edges, found.edge[k])
            n = _couple(nodes, n, found.node[k], a, b)
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
    if layout.leader[scene.contact.high] >= 0 and layout.driven < 0:
        for p in scene.contact.plate_nodes:
            gap = x[scene.contact.high] - x[2 * p + 1]
            if gap < 0.5 * reach * scene.contact.node_thickness[p]:
                n = _couple(nodes, n, p, p, layout.n_nodes)
    return nodes[:n]
