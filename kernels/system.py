"""The linear system of a step: walls condensed one by one, then the joints and what touches.

A wall that nothing touches is condensed on its two joints. A wall in contact is open: its inner
nodes stand in the block matrix beside the joints. Order and pattern are analysed once for a set of
open walls and couplings.
"""

from typing import NamedTuple

import numpy as np

from kernels import blocks, condense, order
from kernels.blocks import DRIVEN, HELD, INNER
from kernels.jit import jit, jit_exact, jit_inlined, jit_owning

CONDENSED, OPEN, RIGID = range(3)


class Layout(NamedTuple):
    """Coordinates: x and y of every node, rotations of joints, lower and upper platen.

    leader (n,): the coordinate itself if it moves, the upper platen if it is tied to it, else -1.
    driven: coordinate that is led to a target, -1 if none. n_nodes, n_joints: joints come first.
    inner (w,): first inner node of each wall, the others follow along it. wall_of (n_nodes,): wall
    of an inner node, -1 for a joint. outer (w, 6): coordinates of its joints. scale: stiffness of
    the stiffest element, N/m.
    """

    leader: np.ndarray
    driven: int
    n_nodes: int
    n_joints: int
    inner: np.ndarray
    wall_of: np.ndarray
    outer: np.ndarray
    scale: float


class System(NamedTuple):
    """kind (w,) of each wall. row_start (w + 1,), rows (r, 12), own (r,): see `condense`.

    target_start (w + 1,), target: where the entries of a wall go in the values of ``matrix``.
    outer (6, 6), joints (6,): scratch.
    """

    kind: np.ndarray
    row_start: np.ndarray
    rows: np.ndarray
    own: np.ndarray
    target_start: np.ndarray
    target: np.ndarray
    matrix: object
    outer: np.ndarray
    joints: np.ndarray


@jit_exact
def _point(layout, c):
    """Return the point whose unknown coordinate ``c`` is (n_nodes: the platen), -1 if none."""
    leader = layout.leader[c]
    if leader < 0 or leader == layout.driven:
        return -1
    if leader < 2 * layout.n_nodes:
        return leader // 2
    joint = leader - 2 * layout.n_nodes
    return joint if joint < layout.n_joints else layout.n_nodes


@jit_exact
def _is_fixed(layout, c):
    return layout.leader[c] != c or c == layout.driven


@jit_exact
def _kind(layout, w, m, touched):
    """Return how wall ``w`` with ``m`` inner unknowns enters the system."""
    inside, ends, first = 0, 0, 2 * layout.inner[w]
    for c in range(first, first + m):
        inside += _is_fixed(layout, c)
    for c in layout.outer[w]:
        ends += _is_fixed(layout, c)
    together = layout.leader[layout.outer[w, 1]] == layout.leader[layout.outer[w, 4]]
    if inside + ends == m + condense.OUTER and together:
        return RIGID
    return CONDENSED if inside == 0 and not touched else OPEN


@jit_exact
def _link(bits, index, points, count):
    """Join all numbered ``points``."""
    for a in range(count):
        for b in range(a):
            if index[points[a]] >= 0 and index[points[b]] >= 0:
                order.connect(bits, index[points[a]], index[points[b]])


@jit_exact
def _points_of(layout, node, points, count):
    """Append the points that the coordinates of ``node`` (n_nodes: the platen) belong to."""
    platen = layout.leader.size - 1
    if node == layout.n_nodes:
        if _point(layout, platen) >= 0:
            points[count] = node
            count += 1
        return count
    points[count] = node
    if _point(layout, 2 * node + 1) == layout.n_nodes:
        points[count + 1] = layout.n_nodes
        return count + 2
    return count + 1


@jit_owning
def _graph(layout, walls, kind, couplings):
    """Return (index (n_nodes + 1,), bits): the number of each point, -1 if none, and who couples."""
    index = np.full(layout.n_nodes + 1, -1)
    count = 0
    for c in range(layout.leader.size):
        p = _point(layout, c)
        if p >= 0 and index[p] < 0:
            w = layout.wall_of[p] if p < layout.n_nodes else -1
            if w < 0 or kind[w] == OPEN:
                index[p] = count
                count += 1
    bits = order.graph(count)
    points = np.empty(8, np.int64)
    for w in range(kind.size):
        first, last = walls.start[w], walls.start[w + 1]
        if kind[w] == CONDENSED:
            n = _points_of(layout, walls.edges[first, 0], points, 0)
            n = _points_of(layout, walls.edges[last - 1, 1], points, n)
            _link(bits, index, points, n)
        elif kind[w] == OPEN:
            for k in range(first, last):
                n = _points_of(layout, walls.edges[k, 0], points, 0)
                n = _points_of(layout, walls.edges[k, 1], points, n)
                if k + 1 < last:
                    n = _points_of(layout, walls.edges[k + 1, 1], points, n)
                _link(bits, index, points, n)
    for k in range(couplings.shape[0]):
        n = 0
        for node in couplings[k]:
            n = _points_of(layout, node, points, n)
        _link(bits, index, points, n)
    return index, bits


@jit_owning
def _homes(layout, kind, index, sequence):
    """Return the home of every coordinate."""
    position = np.empty(sequence.size, np.int64)
    for p in range(sequence.size):
        position[sequence[p]] = p
    home = np.full(layout.leader.size, HELD)
    for c in range(home.size):
        leader, point = layout.leader[c], _point(layout, c)
        if leader >= 0 and leader == layout.driven:
            home[c] = DRIVEN
        elif point >= 0 and index[point] >= 0:
            slot = 0 if point == layout.n_nodes else (c % 2 if c < 2 * layout.n_nodes else 2)
            home[c] = 3 * position[index[point]] + slot
        elif point >= 0:
            home[c] = INNER
    return home


@jit_exact
def _coordinate(layout, w, m, i):
    """Return the coordinate of local unknown ``i`` of wall ``w``: inner ones, then the joints'."""
    return 2 * layout.inner[w] + i if i < m else layout.outer[w, i - m]


@jit_owning
def _targets(layout, row_start, kind, home, start, row):
    """Return (target_start, target): where `_scatter` puts the entries of each wall."""
    target_start = np.zeros(kind.size + 1, np.int64)
    for w in range(kind.size):
        m = row_start[w + 1] - row_start[w]
        size = 0 if kind[w] == RIGID else 21 + (condense.WIDTH * m if kind[w] == OPEN else 0)
        target_start[w + 1] = target_start[w] + size
    nowhere = blocks.SIZE * (start.size - 1 + row.size)
    target = np.full(target_start[-1], nowhere)
    for w in range(kind.size):
        m, t = row_start[w + 1] - row_start[w], target_start[w]
        if kind[w] == OPEN:
            for k in range(m):
                for c in range(condense.WIDTH):
                    other = k + c if c < condense.BAND else m + c - condense.BAND
                    if other < m or c >= condense.BAND:
                        i, j = _coordinate(layout, w, m, k), _coordinate(layout, w, m, other)
                        if home[i] >= 0 and home[j] >= 0:
                            at = blocks.position(home, start, row, i, j)
                            target[t] = at if at >= 0 else nowhere
                    t += 1
        if kind[w] != RIGID:
            for c in range(condense.OUTER):
                for d in range(c + 1):
                    i, j = layout.outer[w, c], layout.outer[w, d]
                    if home[i] >= 0 and home[j] >= 0:
                        at = blocks.position(home, start, row, i, j)
                        target[t] = at if at >= 0 else nowhere
                    t += 1
    return target_start, target


@jit_owning
def analyse(layout, walls, couplings):
    """Return a `System` with room for ``couplings`` (c, k): nodes that share a term (n_nodes: the
    upper platen; a node may be repeated).
    """
    n_walls = walls.start.size - 1
    touched = np.zeros(n_walls, np.bool_)
    for node in couplings.flat:
        if node < layout.n_nodes and layout.wall_of[node] >= 0:
            touched[layout.wall_of[node]] = True
    kind, row_start = np.empty(n_walls, np.int64), np.zeros(n_walls + 1, np.int64)
    for w in range(n_walls):
        m = 2 * (walls.start[w + 1] - walls.start[w] - 1)
        row_start[w + 1] = row_start[w] + m
        kind[w] = _kind(layout, w, m, touched[w])
    index, bits = _graph(layout, walls, kind, couplings)
    sequence = order.minimum_degree(bits)
    start, row = order.columns(bits, sequence)
    home = _homes(layout, kind, index, sequence)
    target_start, target = _targets(layout, row_start, kind, home, start, row)
    return System(
        kind, row_start, np.zeros((row_start[-1], condense.WIDTH)), np.zeros(row_start[-1]),
        target_start, target, blocks.shaped(home, start, row), np.zeros((6, 6)), np.zeros(6),
    )  # fmt: skip


@jit
def _scatter(values, target, rows, outer):
    """Add the entries of a wall to the block matrix: its ``rows`` too where they have targets."""
    t = 0
    if target.size > 21:
        for k in range(rows.shape[0]):
            for c in range(condense.WIDTH):
                values[target[t]] += rows[k, c]
                t += 1
    for c in range(condense.OUTER):
        for d in range(c + 1):
            values[target[t]] += outer[c, d]
            t += 1


@jit_inlined
def factor(system, layout, walls, stiffness):
    """Add the walls to what the matrix holds and factor all.

    Return (wall, failed, pivot): where the first negative pivot is, failed = -1 if there is none;
    wall = -1 if it is in the block matrix.
    """
    wall, failed, pivot = -1, -1, 0.0
    for w in range(system.kind.size):
        if system.kind[w] == RIGID:
            continue
        span = slice(system.row_start[w], system.row_start[w + 1])
        rows, own = system.rows[span], system.own[span]
        condense.fill(walls.start[w], walls.start[w + 1], w, stiffness, rows, system.outer)
        if system.kind[w] == CONDENSED:
            first = 2 * layout.inner[w]
            diagonal = system.matrix.diagonal[first : first + rows.shape[0]]
            failed, pivot = condense.eliminate(rows, diagonal, own, system.outer, layout.scale)
            if failed >= 0:
                wall = w
                break
        targets = system.target[system.target_start[w] : system.target_start[w + 1]]
        _scatter(system.matrix.values, targets, rows, system.outer)
    if failed < 0:
        blocks.settle(system.matrix, layout.scale)
        failed, pivot = blocks.factor(system.matrix, layout.scale)
    return wall, failed, pivot


@jit_inlined
def _inner(system, layout, w):
    """Return the coordinates of the inner unknowns of wall ``w``."""
    first = 2 * layout.inner[w]
    return slice(first, first + system.row_start[w + 1] - system.row_start[w])


@jit_inlined
def _expand(system, layout, b):
    """Write the solution of the block matrix to ``b`` and solve the condensed walls for the rest."""
    home, vector, joints = system.matrix.home, system.matrix.vector, system.joints
    for c in range(b.size):
        if home[c] >= 0:
            b[c] = vector[home[c]]
        elif home[c] != INNER:
            b[c] = 0.0
    for w in range(system.kind.size):
        if system.kind[w] == CONDENSED:
            rows = system.rows[system.row_start[w] : system.row_start[w + 1]]
            for c in range(condense.OUTER):
                joints[c] = b[layout.outer[w, c]]
            condense.backward(rows, b[_inner(system, layout, w)], joints, rows.shape[0])


@jit
def solve(system, layout, b):
    """Solve in place for a right side ``b`` (n,) by coordinate; what is held stays at zero."""
    home, vector, joints = system.matrix.home, system.matrix.vector, system.joints
    vector[:] = 0.0
    for c in range(b.size):
        if home[c] >= 0:
            vector[home[c]] += b[c]
    for w in range(system.kind.size):
        if system.kind[w] == CONDENSED:
            rows = system.rows[system.row_start[w] : system.row_start[w + 1]]
            joints[:] = 0.0
            condense.forward(rows, b[_inner(system, layout, w)], joints)
            for c in range(condense.OUTER):
                h = home[layout.outer[w, c]]
                if h >= 0:
                    vector[h] += joints[c]
    blocks.forward(system.matrix)
    blocks.backward(system.matrix, system.matrix.start.size - 1)
    _expand(system, layout, b)


@jit
def descend(system, layout, wall, failed, direction):
    """Fill ``direction`` (n,) with d such that d^T A d is the negative pivot of `factor`."""
    direction[:] = 0.0
    if wall >= 0:
        rows = system.rows[system.row_start[wall] : system.row_start[wall + 1]]
        system.joints[:] = 0.0
        inner = direction[_inner(system, layout, wall)]
        inner[failed] = 1.0
        condense.backward(rows, inner, system.joints, failed)
    else:
        blocks.descend(system.matrix, failed)
        _expand(system, layout, direction)
