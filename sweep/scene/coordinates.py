"""The order of the coordinates of a scene: x and y of every node, the rotation of every node, the
heights of the surfaces of the lower and the upper platen.
"""

from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from sweep.array_types import Ints

NONE: Ints = np.empty(0, np.int64)
BONDED = ("glued", "sliding")  # platens that hold the outer rows; "sliding": the top moves in x
BASE = "base"  # a base that holds the lower row, below a striker


@dataclass(frozen=True)
class BetweenPlatens:
    """Indices of the coordinates: `per_node` of each node, then the surfaces of two platens."""

    per_node: ClassVar[int]
    n_nodes: int

    @property
    def low(self) -> int:
        """Coordinate of the lower platen's surface."""
        return self.per_node * self.n_nodes

    @property
    def high(self) -> int:
        """Coordinate of the upper platen's surface."""
        return self.low + 1

    @property
    def size(self) -> int:
        """Number of coordinates."""
        return self.high + 1


@dataclass(frozen=True)
class Numbering(BetweenPlatens):
    """Indices of the coordinates. bottom, top: nodes of the outer rows."""

    per_node: ClassVar[int] = 3
    bottom: Ints
    top: Ints

    @property
    def rotation(self) -> Ints:
        """Coordinates of the rotations of the nodes, (n_nodes,)."""
        return 2 * self.n_nodes + np.arange(self.n_nodes)

    @property
    def _others(self) -> int:
        """Number of coordinates that belong to no node."""
        return self.size - self.per_node * self.n_nodes

    @property
    def point(self) -> Ints:
        """Point of each coordinate, (size,): its node, or n_nodes for a platen."""
        nodes, platens = np.arange(self.n_nodes), np.full(self._others, self.n_nodes)
        return np.concatenate([nodes.repeat(2), nodes, platens])

    @property
    def slot(self) -> Ints:
        """Place of each coordinate in the block of its point, (size,): x, y, rotation.

        Both platens share a block, in which the upper one is the first; the width of a period and a
        freely moving platen are never unknowns at the same time.
        """
        along = np.tile([0, 1], self.n_nodes)
        platens = np.append(np.zeros(self._others - 2, np.int64), [1, 0])
        return np.concatenate([along, np.full(self.n_nodes, 2), platens])
