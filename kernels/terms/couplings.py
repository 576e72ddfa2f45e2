"""Which nodes may soon share a term of the energy, so that the matrix needs room for them."""

import numpy as np

from kernels.terms import fold
from kernels.compile.jit import jit_exact, jit_owning
from kernels.arrays import pair, triple

LIKELY = 0.2  # of its contact distance: a pair that much farther away gets room; more fills the
# matrix, less has it analysed anew more often


@jit_exact
def _couple(nodes, n, a, b, c):
    """Write the ``n``-th three nodes; return the next number."""
    nodes[n, 0], nodes[n, 1], nodes[n, 2] = a, b, c
    return n + 1


@jit_owning
def couplings(x, terms, found, grips):
    """Return (c, 3) nodes of what may soon share a term: contacts, grips, springs, folds."""
    layout, reach = terms.layout, 1.0 + LIKELY
    most = found.node.size + grips.count[0] + terms.fold.limit.size
    most += terms.contact.plate_nodes.size + terms.spring.l0.size
    nodes, n = np.empty((most, 3), np.int64), 0
    for k in range(found.node.size):
        if found.distance[k] < reach * found.d_contact[k]:
            a, b = pair(terms.contact.edges, found.edge[k])
            n = _couple(nodes, n, found.node[k], a, b)
    for k in range(grips.count[0]):
        n = _couple(nodes, n, grips.nodes[k, 0], grips.nodes[k, 1], grips.nodes[k, 2])
    for k in range(terms.spring.l0.size):
        a, b = pair(terms.spring.nodes, k)
        n = _couple(nodes, n, a, a, b)
    for k in range(terms.fold.limit.size):
        if fold.opening(x, terms.fold, k) < 2.0 * terms.fold.limit[k]:
            a, b, c = triple(terms.fold.nodes, k)
            n = _couple(nodes, n, a, b, c)
    if layout.leader[terms.contact.high] >= 0 and layout.driven < 0:
        for p in terms.contact.plate_nodes:
            gap = x[terms.contact.high] - x[2 * p + 1]
            if gap < 0.5 * reach * terms.contact.node_thickness[p]:
                n = _couple(nodes, n, p, p, layout.n_nodes)
    return nodes[:n]
