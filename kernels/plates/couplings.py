"""Blocks of the matrix that couple, as their nodes share a quad or may soon touch."""

import numpy as np

from kernels.compile.jit import jit_exact, jit_owning

SOON = 1.2  # distance in units of the reach of contact below which nodes may soon touch


@jit_exact
def _add_pair(layout, i, j, entries, count):
    """Append the pair of the blocks of nodes ``i`` and ``j``, and of the blocks that they follow;
    return the number of pairs.

    If ``entries`` has no rows, the pairs are only counted.
    """
    last = layout.size.size - 1  # block of a platen
    one, other = layout.block[i], layout.block[j]
    for a, b, is_there in (
        (one, other, one >= 0 and other >= 0),
        (one, last, one >= 0 and layout.follows[j]),
        (last, other, other >= 0 and layout.follows[i]),
    ):
        if is_there and a != b:
            if entries.shape[0] > 0:
                entries[count, 0], entries[count, 1] = a, b
            count += 1
    return count


@jit_exact
def _between(layout, nodes, size, entries, count):
    """Append the pairs of all ``nodes`` of a stencil of ``size`` nodes; return the number."""
    for a in range(size):
        for b in range(a + 1):
            count = _add_pair(layout, nodes[a], nodes[b], entries, count)
    return count


@jit_exact
def _write(scene, pairs, lagged_contacts, entries, stencil):
    """Write all pairs of blocks to ``entries``; return their number. stencil (4,): scratch."""
    layout, contact, count = scene.layout, scene.contact, 0
    for e in range(scene.shell.quads.shape[0]):
        count = _between(layout, scene.shell.quads[e], 4, entries, count)
    for p in range(layout.block.size):
        for q in range(pairs.start[p], pairs.start[p + 1]):
            if pairs.bound[q] < SOON * pairs.d_contact[q]:
                stencil[0] = p
                for i in range(3):
                    stencil[1 + i] = contact.triangles[pairs.triangle[q], i]
                count = _between(layout, stencil, 4, entries, count)
    for k in range(pairs.one.size):
        if pairs.edge_bound[k] < SOON * pairs.edge_contact[k]:
            for i in range(2):
                stencil[i] = contact.edges[pairs.one[k], i]
                stencil[2 + i] = contact.edges[pairs.two[k], i]
            count = _between(layout, stencil, 4, entries, count)
    for k in range(lagged_contacts.count[0]):
        nodes, size = lagged_contacts.nodes[k], lagged_contacts.size[k]
        count = _between(layout, nodes, size, entries, count)
    return count


@jit_owning
def couplings(scene, pairs, lagged_contacts):
    """Return (k, 2): pairs of blocks that couple, or may soon; repeats are possible.

    Contacts with lagged friction couple however far they have moved apart in the step. If the upper
    platen is free, it couples with all nodes that may touch it.
    """
    stencil, none = np.empty(4, np.int64), np.empty((0, 2), np.int64)
    layout, contact = scene.layout, scene.contact
    last, count = layout.size.size - 1, _write(scene, pairs, lagged_contacts, none, stencil)
    platen = contact.high_nodes if layout.unknown[contact.high] >= 0 else np.empty(0, np.int64)
    entries = np.empty((count + platen.size, 2), np.int64)
    count = _write(scene, pairs, lagged_contacts, entries, stencil)
    for p in platen:
        if layout.block[p] >= 0:
            entries[count, 0], entries[count, 1] = layout.block[p], last
            count += 1
    return entries[:count].copy()
