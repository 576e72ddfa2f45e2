"""One period of a lattice that repeats: its mesh, and images of its nodes.

Elements belong to the walls of the period. A node at the end of a wall may be the image of another
node, which it follows at a distance of whole periods; further images carry copies of walls, which
the walls of the period may touch. Images have no mass, and contact counts only the nodes of the
period, so that each pair counts once.
"""

from collections.abc import Callable, Iterable
from dataclasses import dataclass, replace
from typing import NamedTuple

import numpy as np

from kernels.linear.condensed import analysis
from kernels.terms import contact
from sweep.array_types import Floats, Ints
from sweep.config.case import Case
from sweep.config.kinds.cells import Cells
from sweep.design.lattice import build_network
from sweep.design.period import Endless
from sweep.scene.bending import build_fold
from sweep.scene.contact import contact_of, projection_of
from sweep.scene.coordinates import BONDED, Numbering
from sweep.scene.joints import Arms, find_arms, point_joints
from sweep.scene.lattice import load_of
from sweep.scene.mesh import Mesh, elements_of, split_walls
from sweep.scene.scene import Parts, masses_of, solved_by, walls_of

Shift = Callable[[Floats], Floats]
"""Stress-free shift in x, m, at heights in m."""


@dataclass(frozen=True)
class Repeated(Numbering):
    """Numbering of a period with images of nodes.

    origin (n,): the node itself, or the node of the period that it copies; shift (n, 2): by how
    many periods it is moved.
    """

    origin: Ints
    shift: Ints

    @property
    def rotation(self) -> Ints:
        """Coordinates of the rotations, (n_nodes,); an image shares the rotation of its
        original.
        """
        return 2 * self.n_nodes + self.origin

    @property
    def own(self) -> np.ndarray:
        """True for nodes of the period, False for images, (n,)."""
        return np.all(self.shift == 0, axis=1)

    @property
    def unused(self) -> Ints:
        """Coordinates of rotations that images do not have."""
        return 2 * self.n_nodes + np.flatnonzero(~self.own)


class Period(NamedTuple):
    """A period as drawn. whole: the mesh of all walls, copies too; mesh: of the period alone.

    origin, shift: as in `Repeated`. arms: of all walls.
    """

    network: Endless
    whole: Mesh
    mesh: Mesh
    origin: Ints
    shift: Ints
    arms: Arms

    @property
    def around(self) -> Ints:
        """Elements of the copies, (k, 2)."""
        return self.whole.edges[len(self.mesh.edges) :]


def draw(case: Case, lattice: Cells, imperfection: Shift, platen: str | None) -> Period:
    """The mesh of a period of the ``lattice`` of a case."""
    network = build_network(lattice.geometry)
    assert isinstance(network, Endless)
    rows = [network.bottom, network.top] if platen in BONDED else []
    arms = _arms(network, case, rows)
    pieces = elements_of(network, lattice.nodes_per_wall + 1, arms)
    mesh = split_walls(network, pieces, 0.0, arms.length)
    origin, shift = network.copied(np.diff(mesh.start) - 1)
    points = mesh.points[origin]
    points[:, 0] += imperfection(points[:, 1])
    whole = replace(mesh, points=points + shift * network.period)
    elements = slice(int(np.searchsorted(whole.wall, network.own)))
    own = replace(
        whole,
        edges=whole.edges[elements],
        wall=whole.wall[elements],
        joint=whole.joint[elements],
        thickness=whole.thickness[elements],
    )
    return Period(network, whole, own, origin, shift, arms)


def _arms(network: Endless, case: Case, rows: Iterable[Ints]) -> Arms:
    """The ends of all walls; a copy of a wall has the same ends as the original."""
    if case.solver.joints == "points":
        return point_joints(len(network.walls))
    own = network.origin[network.walls[: network.own]]
    arms = find_arms(network, own, rows, own[:0])
    of = network.original
    return Arms(arms.length[of], arms.compliance[of], arms.sheared[of])


def images_of(numbering: Repeated, leader: Ints, sizes: tuple[int, int], free: Floats) -> Ints:
    """The constraints of images: position = position of the original + shift x period.

    (k, 4) as in `kernels.linear.condensed.periodic_images`, for coordinates that are neither held
    nor tied. sizes: coordinates of the width and the height of the period; free (2,): 0 for a size
    that does not change, else 1.
    """
    nodes = np.flatnonzero(~numbering.own)
    rows = []
    for axis, size in enumerate(sizes):
        image, own = 2 * nodes + axis, 2 * numbering.origin[nodes] + axis
        times = free[axis] * numbering.shift[nodes, axis]
        own, mean = np.where(leader[own] < 0, -1, own), np.full(len(nodes), size)
        follows = leader[image] == image
        rows.append(np.column_stack([image, own, mean, times])[follows])
    return np.concatenate(rows).astype(np.int64)


def parts_of(case: Case, period: Period, numbering: Repeated, leader: Ints, images: Ints) -> Parts:
    """The data of a period.

    leader (n,): the coordinate that each one follows; images (k, 4): from `images_of`.
    """
    mesh, whole, network = period.mesh, period.whole, period.network
    fold = build_fold(whole, case)
    inside = numbering.own[fold.nodes[:, 1]]
    walls = walls_of(mesh, numbering.rotation[mesh.edges])
    layout = _layout(solved_by(mesh, walls, numbering, leader, case), numbering, images)
    area = np.bincount(numbering.origin, mesh.node_area, numbering.n_nodes)  # images have no mass
    masses = masses_of(case, network, numbering, area.astype(np.float64))
    touch = contact_of(whole, numbering, case)
    return Parts(
        arms=period.arms,
        walls=walls,
        layout=layout,
        fold=fold._replace(
            nodes=fold.nodes[inside], limit=fold.limit[inside], stiffness=fold.stiffness[inside]
        ),
        contact=_contact_of_period(touch, numbering),
        project=projection_of(whole, numbering, layout, masses, case),
        mass=masses,
        load=load_of(numbering, case),
    )


def _layout(layout: analysis.Layout, numbering: Repeated, images: Ints) -> analysis.Layout:
    """The layout with images."""
    origin = np.append(numbering.origin, numbering.n_nodes)
    return layout._replace(images=images, origin=origin, wall_of=layout.wall_of[origin])


def _contact_of_period(touch: contact.Contact, numbering: Repeated) -> contact.Contact:
    """Contact of the nodes of the period: images have contact length 0, so that each pair counts
    once.
    """
    own, special = numbering.own, numbering.own[touch.special_node]
    return touch._replace(
        tributary=np.where(own, touch.tributary, 0.0),
        special_weight=np.where(special, touch.special_weight, 0.0),
        special_distance=np.where(special, touch.special_distance, 0.0),
        platen_nodes=touch.platen_nodes[own[touch.platen_nodes]],
    )
