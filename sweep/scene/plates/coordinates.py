"""Which coordinates of a lattice of plates move, which are held, and which follow a platen.

Node i has the coordinates 6 i .. 6 i + 2, its position in m, and 6 i + 3 .. 6 i + 5, its rotation
about the three axes of its own frame, w = tan(angle / 4) axis. The last two are the heights of the
surfaces of the lower and the upper platen.

The third rotation of a node inside a wall, about the normal of the wall, is held, as nothing
resists it. Bonded platens hold the lower ends of walls in place; the upper ends follow the upper
platen. Neither kind lets an end turn about the vertical axis. "glued" leaves the slope of the wall
free, as a thin bead of glue would; "clamped" holds it, and both hold a wall that lies on them.
"contact" holds nothing. On a mirror plane of normal e a node cannot move along e, and turns about e
alone.
"""

from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from kernels.plates.layout import PER_NODE
from sweep.array_types import Floats, Ints
from sweep.scene.coordinates import BetweenPlatens
from sweep.scene.plates.shell_mesh import ShellMesh

BONDED = ("glued", "clamped")
ALONG, UP, NORMAL = range(3)  # axes of a node inside a wall
VERTICAL = 2  # of the axes x, y, z of a node of a joint


@dataclass(frozen=True)
class Numbering(BetweenPlatens):
    """Indices of the coordinates of ``n_nodes`` nodes."""

    per_node: ClassVar[int] = PER_NODE

    def position(self, nodes: Ints, axis: int) -> Ints:
        """Coordinates of nodes along an axis x, y, z."""
        return np.asarray(PER_NODE * nodes + axis)

    def of_nodes(self, nodes: Ints) -> Ints:
        """All coordinates of nodes, in order, then the coordinates of the platens."""
        own = PER_NODE * nodes[:, None] + np.arange(PER_NODE)
        return np.append(own.ravel(), [self.low, self.high])

    def rotation(self, nodes: Ints, axis: int | Ints) -> Ints:
        """Coordinates of turns of nodes about axes of their frames."""
        return np.asarray(PER_NODE * nodes + 3 + axis)


def leaders(mesh: ShellMesh, platen: str) -> Ints:
    """The coordinate that each one follows, (6 n + 2,): itself, the upper platen, or -1; for an
    image, the coordinate of its original.
    """
    numbering = Numbering(mesh.n_nodes)
    leader = np.arange(numbering.size)
    ends = np.concatenate([mesh.bottom, mesh.top])
    supports = [
        np.array([numbering.low]),
        numbering.rotation(np.flatnonzero(mesh.flat), NORMAL),
        *_mirrored(mesh, numbering),
    ]
    if platen in BONDED:
        vertical = np.where(mesh.flat[ends], UP, VERTICAL)
        supports += [numbering.position(ends, axis) for axis in (0, 1)]
        supports += [numbering.position(mesh.bottom, 2), numbering.rotation(ends, vertical)]
        leader[numbering.position(mesh.top, 2)] = numbering.high
    if platen == "clamped" or (platen in BONDED and mesh.capped):
        supports += [numbering.rotation(ends, axis) for axis in range(3)]
    leader[np.concatenate(supports)] = -1
    return leader[numbering.of_nodes(mesh.original)]


def _mirrored(mesh: ShellMesh, numbering: Numbering) -> list[Ints]:
    """Coordinates that the mirror planes of `lattice.symmetry` "quarter" hold; walls cross these
    planes at right angles.
    """
    coordinates = []
    for axis in (0, 1):
        nodes = np.flatnonzero(mesh.on[:, axis])
        coordinates += [numbering.position(nodes, axis)]
        coordinates += [numbering.rotation(nodes, UP), numbering.rotation(nodes, NORMAL)]
    return coordinates


def heights(mesh: ShellMesh, platen: str) -> tuple[float, float]:
    """Heights of the platens at rest, m.

    Bonded platens are at the ends of the walls. Loose ones touch walls at a distance of half a
    thickness, as everywhere, and start at this distance from the ends.
    """
    gap = 0.0 if platen in BONDED else 0.5 * float(mesh.node_thickness.max())
    return -gap, mesh.height + gap


def at_rest(mesh: ShellMesh, platen: str) -> Floats:
    """All coordinates at rest, (6 n + 2,)."""
    nodes = np.hstack([mesh.rest, np.zeros_like(mesh.rest)])
    return np.concatenate([nodes.ravel(), heights(mesh, platen)])


def masses(mesh: ShellMesh, total: float, striker: float) -> Floats:
    """Lumped mass of each coordinate, (6 n + 2,) kg, which sums to ``total`` along each axis.

    Rotations have no mass, as the solver re-bases them; the upper platen has the mass of the
    ``striker``.
    """
    share = total * mesh.volume / mesh.volume.sum()
    mass = np.zeros((mesh.n_nodes, PER_NODE))
    mass[:, :3] = share[:, None]
    return np.concatenate([mass.ravel(), [0.0, striker]])
