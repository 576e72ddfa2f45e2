"""Symbolic analysis of the linear system: its unknowns, their order, and the place of every entry.

A wall without contact is condensed onto its two joints. A wall in contact is open: its inner nodes
are unknowns of the block matrix, as the joints are. Order and pattern are analysed once for a set
of open walls and couplings.
"""

from typing import NamedTuple

import numpy as np

from kernels.compile.jit import jit_exact, jit_owning
from kernels.compile.simd import LANES
from kernels.linear import minimum_degree
from kernels.linear.condensed import block_matrix, condense
from kernels.linear.condensed.block_matrix import DRIVEN, HELD, IMAGE, INNER
from kernels.linear.condensed.bundles import CONDENSED, OPEN, RIGID, Bundles, bundled

LENGTHS = 2  # coordinates of a position
PLACE = np.dtype(
    (
        np.record,  # fields are attributes in plain Python too
        [
            ("wall", np.int64),  # number of a condensed wall; -1: the block matrix
            ("row", np.int64),  # row of the wall, or home in the block matrix; -1: none
        ],
    )
)


class Layout(NamedTuple):
    """The coordinates and their unknowns. A *point* has a block of the matrix: each node, then the
    two platens as one point n_nodes, then every further rotation of a node as a point of its own.

    leader (n,): the coordinate itself if it is free, the coordinate of the platen if it is tied to
    one, -1 if held. ratio (n,): move divided by the move of the leader; 1 unless the leader is
    driven. images (k, 4): see `periodic_images`; their leader is the coordinate itself. driven:
    coordinate with a prescribed value, -1 if none. point, slot (n,): point of each coordinate, and
    its place in the block of the point. first (n_nodes,): first coordinate of the position of each
    node. origin (points,): the point itself, or the original point if it is an image. inner (r,):
    coordinates of the nodes inside walls, wall by wall. wall_of (points,): wall of an inner node,
    else -1. outer (w, 6): coordinates of the two joints of a wall; the second joint may be an
    image. scale (3,): stiffness of the stiffest element in each slot, N/m and N m.
    """

    leader: np.ndarray
    ratio: np.ndarray
    images: np.ndarray
    driven: int
    point: np.ndarray
    slot: np.ndarray
    n_nodes: int
    first: np.ndarray
    origin: np.ndarray
    inner: np.ndarray
    wall_of: np.ndarray
    outer: np.ndarray
    scale: tuple[float, float, float]


class Scattered(NamedTuple):
    """Entries of the walls that have a place in the block matrix.

    start (2 w + 1,): at 2 w the first entry of the rows of wall w, if it is open; at 2 w + 1 the
    first entry of its joints. source: index by `condense.entry` or `condense.joint_entry`. target:
    positions in the values of the matrix.
    """

    start: np.ndarray
    source: np.ndarray
    target: np.ndarray


class System(NamedTuple):
    """kind (w,): CONDENSED, OPEN or RIGID. bundles: all walls but the rigid ones.

    rows (48 r,), own (4 r,), inside (4 r,): of the r rows of all bundles, see `condense`; inside:
    right side and solution. outer (144,), joints (24,): scratch. place (1,): of the first negative
    pivot (`PLACE`).
    """

    kind: np.ndarray
    bundles: Bundles
    rows: np.ndarray
    own: np.ndarray
    inside: np.ndarray
    scattered: Scattered
    matrix: block_matrix.Blocks
    outer: np.ndarray
    joints: np.ndarray
    place: np.ndarray


@jit_exact
def _point(layout, c):
    """Return the point that holds the unknown of coordinate ``c``, -1 if it has none."""
    leader = layout.leader[c]
    if leader < 0 or leader == layout.driven:
        return -1
    return layout.origin[layout.point[leader]]


@jit_exact
def _is_fixed(layout, c):
    """Return whether coordinate ``c`` is held, tied or driven."""
    return layout.leader[c] != c or c == layout.driven


@jit_exact
def _kind(layout, w, inner, touched):
    """Return the kind of wall ``w`` with the ``inner`` coordinates.

    RIGID: all coordinates are fixed and move together, so that the wall adds nothing.
    """
    inside, ends = 0, 0
    for c in inner:
        inside += _is_fixed(layout, c)
    for c in layout.outer[w]:
        ends += _is_fixed(layout, c)
    together = layout.leader[layout.outer[w, 1]] == layout.leader[layout.outer[w, 4]]
    if inside + ends == inner.size + condense.OUTER and together:
        return RIGID
    return CONDENSED if inside == 0 and not touched else OPEN


@jit_exact
def _link(bits, index, points, count):
    """Connect all numbered ``points`` with each other in the graph."""
    for a in range(count):
        for b in range(a):
            if index[points[a]] >= 0 and index[points[b]] >= 0:
                minimum_degree.connect(bits, index[points[a]], index[points[b]])


@jit_exact
def _points_of(layout, point, points, count):
    """Append the points of the unknowns of ``point``; return the new count.

    A free size of a period takes the place of the platen.
    """
    if point == layout.n_nodes:
        if _point(layout, layout.leader.size - 1) >= 0:
            points[count] = point
            count += 1
        return count
    points[count] = layout.origin[point]
    if points[count] != point or _is_tied(layout, point):
        points[count + 1] = layout.n_nodes
        return count + 2
    return count + 1


@jit_exact
def _is_tied(layout, node):
    """Return whether a platen leads a coordinate of the position of ``node``."""
    for c in range(layout.first[node], layout.first[node] + LENGTHS):
        if _point(layout, c) == layout.n_nodes:
            return True
    return False


@jit_exact
def _turning(layout, c, points, count):
    """Append the point of the rotation ``c`` unless it is a node; return the new count."""
    if layout.point[c] > layout.n_nodes:
        points[count] = layout.point[c]
        return count + 1
    return count


@jit_owning
def _graph(layout, walls, kind, couplings):
    """Return (index (points,), bits): number of each point, -1 if none, and their graph."""
    index = np.full(layout.origin.size, -1)
    count = 0
    for c in range(layout.leader.size):
        p = _point(layout, c)
        if p >= 0 and index[p] < 0:
            w = layout.wall_of[p]
            if w < 0 or kind[w] == OPEN:
                index[p] = count
                count += 1
    bits = minimum_degree.graph(count)
    points = np.empty(8, np.int64)
    for w in range(kind.size):
        first, last = walls.start[w], walls.start[w + 1]
        if kind[w] == CONDENSED:
            n = _points_of(layout, walls.edges[first, 0], points, 0)
            n = _points_of(layout, walls.edges[last - 1, 1], points, n)
            n = _turning(layout, walls.dofs[first, 2], points, n)
            n = _turning(layout, walls.dofs[last - 1, 5], points, n)
            _link(bits, index, points, n)
        elif kind[w] == OPEN:
            for k in range(first, last):
                n = _points_of(layout, walls.edges[k, 0], points, 0)
                n = _points_of(layout, walls.edges[k, 1], points, n)
                n = _turning(layout, walls.dofs[k, 2], points, n)
                n = _turning(layout, walls.dofs[k, 5], points, n)
                _link(bits, index, points, n)
    for k in range(couplings.shape[0]):
        n = 0
        for point in couplings[k]:
            n = _points_of(layout, point, points, n)
        _link(bits, index, points, n)
    return index, bits


@jit_owning
def _homes(layout, index, sequence):
    """Return the home (n,) of every coordinate; ``sequence``: order of elimination."""
    position = np.empty(sequence.size, np.int64)
    for p in range(sequence.size):
        position[sequence[p]] = p
    home = np.full(layout.leader.size, HELD)
    for c in range(home.size):
        leader, point = layout.leader[c], _point(layout, c)
        if leader >= 0 and leader == layout.driven:
            home[c] = DRIVEN
        elif point >= 0 and index[point] >= 0:
            home[c] = block_matrix.home_of(position[index[point]], layout.slot[leader])
        elif point >= 0:
            home[c] = INNER
    for k in range(layout.images.shape[0]):
        home[layout.images[k, 0]] = IMAGE - k
    return home


@jit_exact
def _coordinate(layout, w, inner, i):
    """Return the coordinate of local unknown ``i`` of wall ``w``: ``inner`` ones, then joints."""
    return inner[i] if i < inner.size else layout.outer[w, i - inner.size]


@jit_exact
def _is_coupled(k, c, m):
    """Return whether entry ``c`` of row ``k`` of ``m`` may differ from zero before elimination."""
    if c < condense.BAND:
        return c < condense.BAND - k % condense.NODE and k + c < m
    return k < condense.NODE if c < condense.BAND + condense.NODE else k >= m - condense.NODE


@jit_owning
def _scattered(layout, row_start, kind, home, start, row):
    """Return the `Scattered` entries of all walls."""
    n_walls, t = kind.size, 0
    most = n_walls * condense.OUTER**2 + condense.WIDTH * row_start[-1]
    first = np.zeros(2 * n_walls + 1, np.int64)
    source, target = np.empty(most, np.int64), np.empty(most, np.int64)
    for w in range(n_walls):
        m, inner = row_start[w + 1] - row_start[w], layout.inner[row_start[w] : row_start[w + 1]]
        for k in range(m if kind[w] == OPEN else 0):
            for c in range(condense.WIDTH):
                if _is_coupled(k, c, m):
                    other = k + c if c < condense.BAND else m + c - condense.BAND
                    i, j = inner[k], _coordinate(layout, w, inner, other)
                    source[t], target[t] = condense.entry(k, c), -1
                    if home[i] >= 0 and home[j] >= 0:
                        target[t] = block_matrix.position(home, start, row, i, j)
                    t += target[t] >= 0
        first[2 * w + 1] = t
        for c in range(condense.OUTER if kind[w] != RIGID else 0):
            for d in range(c + 1):
                i, j = layout.outer[w, c], layout.outer[w, d]
                source[t], target[t] = condense.joint_entry(c, d), -1
                if home[i] >= 0 and home[j] >= 0:
                    target[t] = block_matrix.position(home, start, row, i, j)
                t += target[t] >= 0
        first[2 * w + 2] = t
    return Scattered(first, source[:t].copy(), target[:t].copy())


@jit_owning
def analyse(layout, walls, couplings):
    """Return a `System` with room for ``couplings`` (c, k): points that share a term, repeats
    allowed.
    """
    n_walls = walls.start.size - 1
    touched = np.zeros(n_walls, np.bool_)
    for point in couplings.flat:
        if layout.wall_of[point] >= 0:
            touched[layout.wall_of[point]] = True
    kind, row_start = np.empty(n_walls, np.int64), np.zeros(n_walls + 1, np.int64)
    for w in range(n_walls):
        m = condense.NODE * (walls.start[w + 1] - walls.start[w] - 1)
        row_start[w + 1] = row_start[w] + m
        kind[w] = _kind(layout, w, layout.inner[row_start[w] : row_start[w] + m], touched[w])
    index, bits = _graph(layout, walls, kind, couplings)
    sequence = minimum_degree.minimum_degree(bits)
    start, row = minimum_degree.columns(bits, sequence)
    home = _homes(layout, index, sequence)
    scattered = _scattered(layout, row_start, kind, home, start, row)
    matrix = block_matrix.zero_matrix(home, start, row, layout.ratio, layout.images)
    bundles = bundled(kind, walls.start, row_start, layout.inner, layout.outer)
    n = LANES * bundles.start[-1]
    return System(
        kind, bundles, np.zeros(condense.WIDTH * n), np.zeros(n), np.zeros(n),
        scattered, matrix, np.zeros(LANES * condense.OUTER**2),
        np.zeros(LANES * condense.OUTER), np.zeros(1, PLACE),
    )  # fmt: skip
