"""The arrays of an endless lattice: a period of it, images of its nodes, and its mean strain.

The width of the period is an unknown, the last but one coordinate; its height, the last, is led.
"""

from dataclasses import dataclass, replace

import numpy as np

from kernels.terms import contact
from kernels.planar.potential import Terms
from sweep.design.period import Endless
from sweep.scene.bending import bends, build_bend, build_fold
from sweep.design.network import build_network, mass
from sweep.scene.coordinates import Layout
from sweep.scene.material import law_in_stretch
from sweep.scene.mesh import Floats, Ints, Mesh, split_walls
from sweep.config.case import Case, Lattice
from sweep.scene.terms import (
    NO_SPRINGS,
    Scene,
    damp_of,
    force_scale,
    friction_of,
    plane_factors,
    solved_by,
    stretch_of,
    unknowns_of,
    walls_of,
)
from sweep.scene.contact import contact_of, projection_of


@dataclass(frozen=True)
class Repeated(Layout):
    """Layout of a period with images. origin (n,): a node, or of which it is an image; shift (n,
    2): how many periods away. anchor: a node that is held, as the lattice is nowhere else.
    """

    origin: Ints
    shift: Ints
    anchor: int

    @property
    def rotation(self) -> Ints:
        """Coordinates of the joints' rotations, (n_joints,); images turn as what they follow."""
        return 2 * self.n_nodes + self.origin[: self.n_joints]

    @property
    def own(self) -> np.ndarray:
        """Which nodes are no images, (n,)."""
        return np.all(self.shift == 0, axis=1)


def build_periodic(case: Case) -> Scene:
    """Build the arrays of an endless lattice."""
    lattice, material, depth = case.lattice, case.material, case.lattice.depth
    network = build_network(lattice)
    assert isinstance(network, Endless)
    whole, layout = _repeated(network, lattice)
    elements = slice(network.own * (lattice.nodes_per_wall + 1))
    mesh = replace(
        whole,
        edges=whole.edges[elements],
        wall=whole.wall[elements],
        pieces=whole.pieces[elements],
        thickness=whole.thickness[elements],
    )
    in_stretch, in_bend = plane_factors(material)
    rigidity = in_bend * material.modulus * depth * whole.thickness**3 / 12
    bending, around = build_bend(mesh, rigidity[elements], case), build_bend(whole, rigidity, case)
    fold = build_fold(whole, around, case)
    inside = layout.own[fold.nodes[:, 1]]
    leader = _leaders(layout, case)
    follows = solved_by(mesh, layout, leader, case)._replace(
        images=_images(layout, leader), origin=layout.origin, wall_of=_wall_of(mesh, layout)
    )
    touching = in_stretch * material.modulus * depth * (case.contact.stiffness or 0.0)
    masses = _masses(mesh, layout, mass(network, depth, material.density))
    terms = Terms(
        law=law_in_stretch(material, in_stretch),
        walls=walls_of(mesh, layout),
        stretch=stretch_of(mesh, case),
        bend=bending,
        fold=fold._replace(
            nodes=fold.nodes[inside], limit=fold.limit[inside], stiffness=fold.stiffness[inside]
        ),
        spring=NO_SPRINGS,
        contact=_seen(contact_of(whole, layout, touching, case, by_force=True), layout),
        friction=friction_of(case),
        damp=damp_of(case),
        mass=masses,
        load=np.zeros(layout.size),
        layout=follows,
        project=projection_of(whole, layout, follows, masses, case),
    )
    return Scene(
        mesh, network, terms, unknowns_of(mesh, layout, follows, case),
        np.concatenate([whole.points.ravel(), np.zeros(layout.n_joints), network.period]),
        bottom=np.empty(0, np.int64),
        top=np.array([layout.high]),
        base=np.array([2 * layout.anchor + 1]),
        force_scale=force_scale(network, rigidity),
        velocity=np.zeros(layout.size),
        around=whole.edges[elements.stop :],
    )  # fmt: skip


def _repeated(network: Endless, lattice: Lattice) -> tuple[Mesh, Repeated]:
    """Mesh of all walls, those of the period first, and its layout.

    The stress-free shift in x is ``imperfection`` x wall thickness x cos(2 pi y / height).
    """
    mesh = split_walls(network, lattice.nodes_per_wall + 1, 0.0)
    inside = lattice.nodes_per_wall
    number = np.arange(inside)
    inner = len(network.points) + inside * network.original[:, None] + number
    copied = network.shift[network.walls[:, 0]]
    origin = np.concatenate([network.origin, inner.ravel()])
    shift = np.concatenate([network.shift, np.repeat(copied, inside, axis=0)])
    points = mesh.points[origin]
    points[:, 0] += imperfection(lattice, points[:, 1])
    rows, anchor = np.empty(0, np.int64), int(network.bottom[0])
    layout = Repeated(len(points), mesh.n_joints, rows, rows, origin, shift, anchor)
    return replace(mesh, points=points + shift * network.period), layout


def imperfection(lattice: Lattice, y: Floats) -> Floats:
    """Stress-free shift in x at heights ``y``, all in m."""
    wave = np.cos(2.0 * np.pi * y / lattice.height)
    return np.asarray(lattice.imperfection * lattice.wall_thickness * wave)


def _leaders(layout: Repeated, case: Case) -> Ints:
    """What each coordinate follows: itself, or -1 where held."""
    leader = np.arange(layout.size)
    leader[[2 * layout.anchor, 2 * layout.anchor + 1]] = -1
    joints = np.arange(layout.n_joints)
    leader[2 * layout.n_nodes + joints[~layout.own[joints] | (not bends(case))]] = -1
    return leader


def _images(layout: Repeated, leader: Ints) -> Ints:
    """What images of nodes follow: each its node and, as many times as it is away, the period.

    (k, 4) as in `kernels.image`.
    """
    nodes = np.flatnonzero(~layout.own)
    rows = []
    for axis, size in enumerate((layout.low, layout.high)):
        of = 2 * layout.origin[nodes] + axis
        of, mean = np.where(leader[of] < 0, -1, of), np.full(len(nodes), size)
        rows.append(np.column_stack([2 * nodes + axis, of, mean, layout.shift[nodes, axis]]))
    return np.concatenate(rows)


def _wall_of(mesh: Mesh, layout: Repeated) -> Ints:
    """Wall of every node inside one, or of its image, (n,); -1 for joints."""
    wall_of = np.full(layout.n_nodes, -1)
    before, node, _ = mesh.inner.T
    wall_of[node] = mesh.wall[before]
    return wall_of[layout.origin]


def _masses(mesh: Mesh, layout: Repeated, total: float) -> Floats:
    """Lumped mass of each coordinate, kg: images have none."""
    share = np.bincount(layout.origin, mesh.node_area, layout.n_nodes)
    masses = np.zeros(layout.size)
    masses[: 2 * layout.n_nodes] = np.repeat(total * share / share.sum(), 2)
    return masses


def _seen(touch: contact.Contact, layout: Repeated) -> contact.Contact:
    """Contact as the nodes of the period see it: images have no length, each pair counts once."""
    return touch._replace(
        tributary=np.where(layout.own, touch.tributary, 0.0),
        special_weight=np.where(layout.own[touch.special_node], touch.special_weight, 0.0),
    )
