"""A mesh of shells: quads, and images of nodes where the panel repeats along x and y.

A node at the side of a period may be the image of another one, its original, which it follows at a
distance of whole periods; further images carry copies of quads that the period may touch. Images
have no mass and no area, so that each pair of surfaces counts once.
"""

from abc import ABC, abstractmethod
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from kernels.plates.element.shell import Shell
from sweep.array_types import Floats, Ints


@dataclass(frozen=True, kw_only=True)
class ShellMesh(ABC):
    """n nodes, m quads; the last axis of a node is the normal of its wall, if it has one wall.

    height: distance of the platens at rest, m. rest (n, 3): nodes at rest, m. frames (n, 9): axes
    of each node at rest as columns of a matrix, row by row. quads (m, 4), without copies: nodes (s0
    z0), (s1 z0), (s1 z1), (s0 z1). size (m, 2): lengths along s and z, m. thickness (m,), m.
    directors (m, 4, 3): normal at the corners, in the axes of their nodes. triangles (k, 3): two of
    each quad, then of their copies. original (n,): the node itself or, for an image, its original;
    shift (n, 2): by how many periods it is moved along x and y. period (2,), m; infinite if nothing
    repeats. quad_area (m,): of each quad, m^2. flat (n,): whether all quads of a node have one
    tangent plane: nothing resists a turn there about its normal, the third axis. bottom, top: nodes
    at the platens. capped: whether walls lie on the platens. smooth_corners (m, 4): a number for
    all corners of quads that share a node and a normal there. planes (2,): places of the mirror
    planes of x and y, m; infinite if there are none. on (n, 2): whether a node is on each of them.
    cell: typical width of a wall, m. force: typical force over modulus, m^2: the least t^3 / (12 l)
    of a wall of width l.
    """

    height: float
    rest: Floats
    frames: Floats
    quads: Ints
    size: Floats
    thickness: Floats
    directors: Floats
    triangles: Ints
    original: Ints
    shift: Ints
    period: Floats
    quad_area: Floats
    flat: np.ndarray
    bottom: Ints
    top: Ints
    capped: bool = False
    smooth_corners: Ints
    planes: Floats
    on: np.ndarray
    cell: float
    force: float

    @abstractmethod
    def shells(self, x_rest: Floats, moduli: tuple[float, float]) -> Shell:
        """The shells, without stress at ``x_rest``; moduli: from `law.shear_moduli`, Pa."""

    @property
    def copies(self) -> int:
        """Number of equal parts of the whole, one of which is this mesh."""
        return 4 if np.isfinite(self.planes).all() else 1

    @property
    def n_nodes(self) -> int:
        """Number of nodes, including images."""
        return len(self.rest)

    @cached_property
    def own(self) -> Ints:
        """Nodes that are no images."""
        return np.flatnonzero(self.original == np.arange(self.n_nodes))

    @cached_property
    def shown(self) -> Ints:
        """Nodes whose positions are stored: own nodes, and images in the quads."""
        return np.union1d(self.own, self.quads.ravel())

    def with_images(self, shown: Floats) -> Floats:
        """Positions (f, n, 3) of all nodes from the positions of the `shown` nodes."""
        every = shown[:, np.searchsorted(self.shown, self.original)]
        if self.shift.any():
            every[..., :2] += self.shift * self.period
        return every

    @cached_property
    def area(self) -> Floats:
        """A quarter of the area of each quad at a node, (n,) m^2."""
        return self._quarters(self.quad_area)

    @cached_property
    def volume(self) -> Floats:
        """A quarter of the volume of each quad at a node, (n,) m^3; joints count for each wall."""
        return self._quarters(self.quad_area * self.thickness)

    @property
    def node_thickness(self) -> Floats:
        """Mean thickness of the walls at a node, (n,) m."""
        own = self.volume[self.own] / self.area[self.own]
        return np.asarray(own[np.searchsorted(self.own, self.original)])

    def _quarters(self, values: Floats) -> Floats:
        corners = self.original[self.quads].ravel()
        shared = np.bincount(corners, np.repeat(0.25 * values, 4), self.n_nodes)
        return shared.astype(np.float64)


def cut(quads: Ints, first: np.ndarray) -> Ints:
    """Two triangles of each quad, (2 m, 3), with the normals of the quads; first (m,): whether they
    share the diagonal from the first corner.
    """
    a, b, c, d = quads.T
    one = np.where(first[:, None], np.column_stack([a, b, c]), np.column_stack([a, b, d]))
    two = np.where(first[:, None], np.column_stack([a, c, d]), np.column_stack([b, c, d]))
    return np.stack([one, two], axis=1).reshape(-1, 3)
