"""Entries of the Hessian of a lattice of plates: from stencils of nodes to the matrix."""

from kernels.compile.jit import jit, jit_exact
from kernels.linear.supernodal import matrix as blocks
from kernels.plates.contacts import contact, friction, mirror
from kernels.plates.layout import PER_NODE, POSITION
from kernels.shared.lagging import slip_of


@jit_exact
def add_entry(matrix, layout, pull, c, d, value):
    """Add the second derivative ``value`` in coordinates ``c`` and ``d``, once for each pair.

    pull (n,): receives the derivatives in a driven coordinate, at the other coordinate.
    """
    one, other = layout.leader[c], layout.leader[d]
    if one < 0 or other < 0:
        return
    value *= layout.ratio[c] * layout.ratio[d]
    i, j = layout.unknown[c], layout.unknown[d]
    if i >= 0 and j >= 0:
        blocks.add_entry(matrix, i, j, 2.0 * value if i == j and c != d else value)
        return
    if other == layout.driven:
        pull[c] += value / layout.ratio[c]
    if one == layout.driven and c != d:
        pull[d] += value / layout.ratio[d]


@jit
def add_diagonal(matrix, layout, pull, diagonal):
    """Add a ``diagonal`` (n,) of the Hessian by coordinate."""
    for i in range(diagonal.size):
        if diagonal[i] != 0.0:
            add_entry(matrix, layout, pull, i, i, diagonal[i])


@jit
def _add_free(matrix, layout, i, j, part, top, left, width):
    """Add a block of ``part`` in the free coordinates of nodes ``i`` and ``j``."""
    one, other = layout.block[i], layout.block[j]
    if one < 0 or other < 0:
        return
    at, down, across = blocks.place(matrix, one, other)
    if at < 0:
        matrix.missing[0] = 1
        return
    for s in range(width):
        column = layout.slot[PER_NODE * j + s]
        if column < 0:
            continue
        first = at + across * column
        for r in range(width):
            row = layout.slot[PER_NODE * i + r]
            if row >= 0:
                matrix.values[first + down * row] += part[top + r, left + s]


@jit
def _add_following(matrix, layout, pull, i, j, part, top, left, width):
    """Add the entries of ``part`` for pairs of coordinates with one that follows a platen or is
    driven.
    """
    for r in range(width):
        c = PER_NODE * i + r
        for s in range(r + 1 if i == j else width):
            d = PER_NODE * j + s
            if layout.slot[c] < 0 or layout.slot[d] < 0:
                add_entry(matrix, layout, pull, c, d, part[top + r, left + s])


@jit
def add_stencil(matrix, layout, pull, nodes, count, width, part):
    """Add the second derivatives ``part`` in the first ``width`` coordinates of ``count`` nodes.

    part (count x width, count x width): symmetric, node by node.
    """
    for a in range(count):
        i = nodes[a]
        for b in range(a + 1):
            j, top, left = nodes[b], width * a, width * b
            _add_free(matrix, layout, i, j, part, top, left, width)
            if a != b and layout.block[i] == layout.block[j]:  # a node and its image
                _add_free(matrix, layout, j, i, part, left, top, width)
            if layout.follows[i] or layout.follows[j]:
                _add_following(matrix, layout, pull, i, j, part, top, left, width)


@jit
def add_contacts(problem, x, step, evaluation):
    """Add the second derivatives of contact at ``x``, of friction and of contact with platens."""
    scene, neighbours, buffers = problem.scene, problem.neighbours, problem.buffers
    matrix, layout, pull, part = neighbours.matrix, scene.layout, buffers.pull, buffers.part
    touching, lagged = neighbours.touching, neighbours.lagged_contacts
    for n in range(touching.count[0]):
        count = contact.block(x, scene.contact, neighbours.pairs, touching, n, part)
        add_stencil(matrix, layout, pull, touching.nodes[n], count, POSITION, part)
    slip = slip_of(problem, step)
    for k in range(lagged.count[0]):
        count = friction.block(evaluation.u, lagged, slip, k, part)
        add_stencil(matrix, layout, pull, lagged.nodes[k], count, POSITION, part)
    for i in range(scene.contact.low_nodes.size):
        _add_platen(problem, x, False, i)
    for i in range(scene.contact.high_nodes.size):
        _add_platen(problem, x, True, i)
    for i in range(scene.mirror.node.size):
        _, _, stiffness = mirror.against(x, scene.contact, scene.mirror, i)
        if stiffness != 0.0:
            c = scene.mirror.coordinate[i]
            add_entry(matrix, layout, pull, c, c, stiffness)


@jit
def _add_platen(problem, x, upper, i):
    """Add the second derivatives of the contact of platen node ``i``."""
    scene, matrix, pull = problem.scene, problem.neighbours.matrix, problem.buffers.pull
    p, _, stiffness = contact.platen_block(x, scene.contact, upper, i)
    if stiffness != 0.0:
        z, platen = PER_NODE * p + 2, scene.contact.high if upper else scene.contact.low
        add_entry(matrix, scene.layout, pull, z, z, stiffness)
        add_entry(matrix, scene.layout, pull, platen, platen, stiffness)
        add_entry(matrix, scene.layout, pull, platen, z, -stiffness)
