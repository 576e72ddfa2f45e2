"""The arrays of a lattice between platens whose left and right sides are tied to each other.

It is the middle of a wide panel: one period, whose nodes have images to the left and to the right.
The width of the period is a coordinate before the surfaces of the platens. It is fixed, unless
nothing holds it (`Case.widens`): then it is an unknown, and the mean lateral force is zero.
"""

from dataclasses import dataclass

import numpy as np

from sweep.config.case import Case
from sweep.config.kinds.cells import Cells
from sweep.scene.images import Period, Repeated, draw, images_of, parts_of
from sweep.scene.lattice import initial_velocity, leaders, reported, rest_of
from sweep.scene.mesh import bow, row_nodes
from sweep.scene.scene import Scene, assemble, force_scale


@dataclass(frozen=True)
class BesideEachOther(Repeated):
    """Numbering of a period between platens: the width of the period comes before the platens."""

    @property
    def width(self) -> int:
        """Coordinate of the width of the period."""
        return super().low

    @property
    def low(self) -> int:
        """Coordinate of the lower platen's surface."""
        return self.width + 1


def build_tied(case: Case) -> Scene:
    """Build the arrays of a lattice with tied sides."""
    lattice, loading = case.lattice, case.loading
    assert isinstance(lattice, Cells)
    amplitude = lattice.imperfection * lattice.wall_thickness
    period = draw(case, lattice, lambda y: bow(y, amplitude, lattice.height), loading.platen)
    numbering = _numbering(period)
    fixed = numbering.unused if case.widens else np.append(numbering.unused, numbering.width)
    leader = leaders(numbering, case, fixed)
    free = np.array([float(case.widens), 0.0])
    images = images_of(numbering, leader, (numbering.width, numbering.width), free)
    parts = parts_of(case, period, numbering, leader, images)
    rest = rest_of(period.whole, numbering, parts.contact.node_thickness)
    return Scene(
        period.mesh, period.network, assemble(case, period.mesh, numbering, parts),
        np.insert(rest, numbering.width, lattice.width),
        *reported(numbering, loading),
        force_scale=force_scale(case, period.network),
        velocity=initial_velocity(numbering, parts.layout.leader, loading),
        around=period.around,
        solid_joint_share=float(period.arms.sheared.mean()),
    )  # fmt: skip


def _numbering(period: Period) -> BesideEachOther:
    """The numbering of a period; its rows include the images of their nodes."""
    network = period.network
    bottom, top = (
        row_nodes(network, period.whole, np.flatnonzero(np.isin(network.origin, joints)))
        for joints in (network.bottom, network.top)
    )
    return BesideEachOther(len(period.origin), bottom, top, period.origin, period.shift)
