"""Images of nodes of shells whose panel repeats along x and y.

A node at the side of a period may be the image of another one, its original, which it follows at a
distance of whole periods; further images carry copies of quads that the period may touch. Images
have no mass and no area, so that each pair of surfaces counts once.
"""

from typing import Protocol

import numpy as np

from sweep.scene.mesh import Floats, Ints


class Repeating(Protocol):
    """What a mesh has of it: quads (m, 4) of the period; of its n nodes, `original` (n,), the node
    itself or that of which it is an image, and `shift` (n, 2), by how many periods it is moved;
    `period` (2,) in m.
    """

    @property
    def quads(self) -> Ints:
        """Quads of the period, (m, 4)."""
        ...

    @property
    def original(self) -> Ints:
        """Originals of the nodes, (n,)."""
        ...

    @property
    def shift(self) -> Ints:
        """Periods between them, (n, 2)."""
        ...

    @property
    def period(self) -> Floats:
        """Size of a period, (2,) in m."""
        ...


def own(mesh: Repeating) -> Ints:
    """Nodes that are no images."""
    return np.flatnonzero(mesh.original == np.arange(len(mesh.original)))


def shown(mesh: Repeating) -> Ints:
    """Nodes whose positions are stored: those of the period, and the images in its quads."""
    return np.union1d(own(mesh), mesh.quads.ravel())


def with_images(mesh: Repeating, positions: Floats) -> Floats:
    """Positions (f, n, 3) of all nodes from those of the nodes that are `shown`."""
    place = np.searchsorted(shown(mesh), mesh.original)
    every = positions[:, place]
    if mesh.shift.any():
        every[..., :2] += mesh.shift * mesh.period
    return every


def quarters(mesh: Repeating, values: Floats) -> Floats:
    """A quarter of the value (m,) of each quad at each of its nodes, (n,); none at images."""
    corners, nodes = mesh.original[mesh.quads].ravel(), len(mesh.original)
    return np.bincount(corners, np.repeat(0.25 * values, 4), nodes).astype(np.float64)
