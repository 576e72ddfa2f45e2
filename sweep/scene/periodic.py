"""The arrays of an endless lattice: one period, images of its nodes, and the mean strain.

The last two coordinates are the width and the height of the period. The width is an unknown; the
height is prescribed.
"""

from dataclasses import dataclass, replace

import numpy as np

from kernels.terms import contact
from sweep.config.case import Case
from sweep.config.kinds.cells import Cells
from sweep.design.lattice import build_network
from sweep.design.network import mass
from sweep.design.period import Endless
from sweep.scene.beams import bends, build_beams
from sweep.scene.bending import build_bend, build_fold
from sweep.scene.contact import contact_of, projection_of
from sweep.scene.coordinates import Numbering
from sweep.scene.joints import Arms, find_arms, point_joints
from sweep.scene.mesh import Floats, Ints, Mesh, elements_of, split_walls
from sweep.scene.terms import (
    Parts,
    Scene,
    assemble,
    contact_stiffness,
    force_scale,
    solved_by,
    walls_of,
)


@dataclass(frozen=True)
class Repeated(Numbering):
    """Numbering of a period with images of nodes.

    origin (n,): the node of the period that each node is or copies; shift (n, 2): by how many
    periods it is moved. anchor: the node that is held, to prevent rigid motions.
    """

    origin: Ints
    shift: Ints
    anchor: int

    @property
    def rotation(self) -> Ints:
        """Coordinates of the rotations, (n_nodes,); an image has that of its original."""
        return 2 * self.n_nodes + self.origin

    @property
    def own(self) -> np.ndarray:
        """True for nodes of the period, False for images, (n,)."""
        return np.all(self.shift == 0, axis=1)


def build_periodic(case: Case) -> Scene:
    """Build the arrays of an endless lattice."""
    lattice = case.lattice
    assert isinstance(lattice, Cells)
    network = build_network(lattice.geometry)
    assert isinstance(network, Endless)
    arms = _arms(network, case)
    whole, numbering = _repeated(network, lattice, arms)
    elements = slice(int(np.searchsorted(whole.wall, network.own)))
    mesh = replace(
        whole,
        edges=whole.edges[elements],
        wall=whole.wall[elements],
        joint=whole.joint[elements],
        thickness=whole.thickness[elements],
    )
    beams = build_beams(mesh, arms, case)
    rigidity = build_beams(whole, arms, case).rigidity
    fold = build_fold(whole, rigidity, case)
    inside = numbering.own[fold.nodes[:, 1]]
    leader = _leaders(numbering, case)
    walls = walls_of(mesh, numbering.rotation[mesh.edges])
    layout = solved_by(mesh, walls, numbering, leader, case)
    origin = np.append(numbering.origin, numbering.n_nodes)
    layout = layout._replace(
        images=_images(numbering, leader), origin=origin, wall_of=layout.wall_of[origin]
    )
    touch = contact_of(whole, numbering, contact_stiffness(case), case, by_force=True)
    masses = _masses(mesh, numbering, mass(network, lattice.depth, case.material.density))
    parts = Parts(
        walls=walls,
        beams=beams,
        layout=layout,
        bend=build_bend(mesh, beams, case),
        fold=fold._replace(
            nodes=fold.nodes[inside], limit=fold.limit[inside], stiffness=fold.stiffness[inside]
        ),
        contact=_seen(touch, numbering),
        project=projection_of(whole, numbering, layout, masses, case),
        mass=masses,
        load=np.zeros(numbering.size),
    )
    return Scene(
        mesh, network, assemble(case, mesh, numbering, parts),
        np.concatenate([whole.points.ravel(), np.zeros(numbering.n_nodes), network.period]),
        bottom=np.empty(0, np.int64),
        top=np.array([numbering.high]),
        base=np.array([2 * numbering.anchor + 1]),
        force_scale=force_scale(network, rigidity),
        velocity=np.zeros(numbering.size),
        around=whole.edges[elements.stop :],
        solid_joint_share=float(arms.sheared.mean()),
    )  # fmt: skip


def _arms(network: Endless, case: Case) -> Arms:
    """The ends of all walls: those of a copy are those of the wall that it copies."""
    if case.solver.joints == "points":
        return point_joints(len(network.walls))
    own = network.origin[network.walls[: network.own]]
    arms = find_arms(network, own, (), own[:0])
    of = network.original
    return Arms(arms.length[of], arms.compliance[of], arms.sheared[of])


def _repeated(network: Endless, lattice: Cells, arms: Arms) -> tuple[Mesh, Repeated]:
    """Mesh of all walls, those of the period first, and its numbering."""
    pieces = elements_of(network, lattice.nodes_per_wall + 1, arms)
    mesh = split_walls(network, pieces, 0.0, arms.length)
    inside = np.diff(mesh.start) - 1
    first = len(network.points) + np.cumsum(inside) - inside
    wall = np.repeat(np.arange(len(inside)), inside)
    number = len(network.points) + np.arange(len(wall)) - first[wall]
    inner = first[network.original[wall]] + number
    copied = network.shift[network.walls[:, 0]]
    origin = np.concatenate([network.origin, inner])
    shift = np.concatenate([network.shift, copied[wall]])
    points = mesh.points[origin]
    points[:, 0] += imperfection(lattice, points[:, 1])
    rows, anchor = np.empty(0, np.int64), int(network.bottom[0])
    numbering = Repeated(len(points), rows, rows, origin, shift, anchor)
    return replace(mesh, points=points + shift * network.period), numbering


def imperfection(lattice: Cells, y: Floats) -> Floats:
    """Stress-free shift in x at heights ``y``, both in m.

    It is `lattice.imperfection` x wall thickness x cos(2 pi y / height).
    """
    wave = np.cos(2.0 * np.pi * y / lattice.height)
    return np.asarray(lattice.imperfection * lattice.wall_thickness * wave)


def _leaders(numbering: Repeated, case: Case) -> Ints:
    """The coordinate that each one follows: itself, or -1 if held."""
    leader = np.arange(numbering.size)
    leader[[2 * numbering.anchor, 2 * numbering.anchor + 1]] = -1
    nodes = np.arange(numbering.n_nodes)
    leader[2 * numbering.n_nodes + nodes[~numbering.own | (not bends(case))]] = -1
    return leader


def _images(numbering: Repeated, leader: Ints) -> Ints:
    """The constraints of images: position = that of the original + shift x period.

    (k, 4) as in `kernels.linear.condensed.periodic_images`.
    """
    nodes = np.flatnonzero(~numbering.own)
    rows = []
    for axis, size in enumerate((numbering.low, numbering.high)):
        own = 2 * numbering.origin[nodes] + axis
        own, mean = np.where(leader[own] < 0, -1, own), np.full(len(nodes), size)
        rows.append(np.column_stack([2 * nodes + axis, own, mean, numbering.shift[nodes, axis]]))
    return np.concatenate(rows)


def _masses(mesh: Mesh, numbering: Repeated, total: float) -> Floats:
    """Lumped mass of each coordinate, kg: images have none."""
    share = np.bincount(numbering.origin, mesh.node_area, numbering.n_nodes)
    masses = np.zeros(numbering.size)
    masses[: 2 * numbering.n_nodes] = np.repeat(total * share / share.sum(), 2)
    return masses


def _seen(touch: contact.Contact, numbering: Repeated) -> contact.Contact:
    """Contact of the nodes of the period: images have length 0, so that each pair counts once."""
    own = numbering.own[touch.special_node]
    return touch._replace(
        tributary=np.where(numbering.own, touch.tributary, 0.0),
        special_weight=np.where(own, touch.special_weight, 0.0),
        special_distance=np.where(own, touch.special_distance, 0.0),
    )
