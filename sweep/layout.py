"""Where the coordinates of a scene are, which of them move, and in which order they are solved.

Coordinates: x and y of every node, then the rotations of the joints, then the surfaces of the lower
and the upper platen.
"""

from dataclasses import dataclass

import numpy as np
from scipy.sparse import coo_array
from scipy.sparse.csgraph import reverse_cuthill_mckee

from kernels.bend import Bend
from sweep.mesh import Ints, Mesh


@dataclass(frozen=True)
class Layout:
    """Where the coordinates are. bottom, top: nodes of the outer rows."""

    n_nodes: int
    n_joints: int
    bottom: Ints
    top: Ints

    @property
    def rotation(self) -> Ints:
        """Coordinates of the joints' rotations, (n_joints,)."""
        return 2 * self.n_nodes + np.arange(self.n_joints)

    @property
    def low(self) -> int:
        """Coordinate of the lower platen's surface."""
        return 2 * self.n_nodes + self.n_joints

    @property
    def high(self) -> int:
        """Coordinate of the upper platen's surface."""
        return self.low + 1

    @property
    def size(self) -> int:
        """Number of coordinates."""
        return self.high + 1


def held(layout: Layout, platen: str | None) -> Ints:
    """Coordinates that never move: those of clamped rows, and the lower platen."""
    bottom, top = layout.bottom, layout.top
    clamped = [2 * bottom, 2 * bottom + 1, layout.rotation[bottom[bottom < layout.n_joints]]]
    along = [2 * top, layout.rotation[top[top < layout.n_joints]]]
    low, high = np.array([layout.low]), np.array([layout.high])
    if platen == "contact":
        return low
    if platen == "glued":
        return np.concatenate([*clamped, *along, low])
    return np.concatenate([*clamped, low, high])


def coordinates(mesh: Mesh, bending: Bend, folds: Ints) -> list[Ints]:
    """Coordinates of each element, hinge, fold, arm and coupling: (k, 4), (k, 6) ... (k, 6)."""

    def of(nodes: Ints) -> Ints:
        return np.stack([2 * nodes, 2 * nodes + 1], axis=-1).reshape(len(nodes), 2 * nodes.shape[1])

    arms = np.column_stack([of(bending.arms[:, :2]), bending.arms[:, 2]])
    pairs = bending.couplings
    ends = np.column_stack([of(bending.arms[pairs[:, 0], :2]), bending.arms[pairs, 2]])
    return [of(mesh.edges), of(bending.hinges), of(folds), arms, ends]


def _coupled(terms: list[Ints], size: int) -> coo_array:
    """Graph of coordinates that share a term; ``terms``: arrays (k, c) of coordinates."""
    i = np.concatenate([np.repeat(t, t.shape[1], axis=1).ravel() for t in terms])
    j = np.concatenate([np.tile(t, t.shape[1]).ravel() for t in terms])
    return coo_array((np.ones(len(i), dtype=np.int8), (i, j)), shape=(size, size))


def rows(layout: Layout, held: Ints, tied: Ints, terms: list[Ints]) -> Ints:
    """Row of each coordinate in an order of small profile; the upper platen's comes last."""
    leader = np.arange(layout.size)
    leader[tied] = layout.high
    free = np.ones(layout.size, dtype=bool)
    free[held] = False
    free[tied] = False
    led = free.copy()
    led[layout.high] = False
    inner = np.flatnonzero(led)
    graph = _coupled(terms, layout.size).tocsr()[inner][:, inner]
    order = inner
    if len(inner) > 0:
        order = inner[reverse_cuthill_mckee(graph, symmetric_mode=True)]
    row = np.full(layout.size, -1)
    row[order] = np.arange(len(order))
    if free[layout.high]:
        row[layout.high] = len(order)
        row[tied] = len(order)
    return row


def skyline(row: Ints, terms: list[Ints]) -> Ints:
    """First column of each row: the lowest row that shares a term with it."""
    first = np.arange(row.max() + 1)
    for coordinates in terms:
        rows = row[coordinates]
        lowest = np.where(rows < 0, row.size, rows).min(axis=1, initial=row.size)
        for column in rows.T:
            np.minimum.at(first, column[column >= 0], lowest[column >= 0])
    return first
