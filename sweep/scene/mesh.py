"""From a network of walls to nodes, elements and folds: indices and geometry at rest."""

from dataclasses import dataclass
from functools import cached_property, lru_cache

import numpy as np
from numpy.typing import NDArray

from sweep.array_types import Floats, Ints
from sweep.config.kinds.specimen import WallLattice
from sweep.design.lattice import build_network
from sweep.design.network import Network
from sweep.design.silhouette import next_arm
from sweep.scene.joints import Arms, point_joints, solid_joints

SHORTEST = 0.5  # length of an element over its thickness, between solid joints
ROUND_OFF = 1e-9  # relative, of the lengths of equal walls


@dataclass(frozen=True)
class Mesh:
    """Walls split into equal elements, between short ones for solid joints at their ends.

    The first nodes are the joints of the network. points (n, 2): nodes at rest, m. edges (m, 2):
    nodes of an element, in the direction of its wall. wall (m,): wall of an element. joint (m,): 2
    w or 2 w + 1 for the solid joint at either end of a wall w, else -1. thickness (m,) of an
    element, m. n_joints: number of joints. gyration (m,): as in `Network`, of each element.
    """

    points: Floats
    edges: Ints
    wall: Ints
    joint: Ints
    thickness: Floats
    n_joints: int
    gyration: Floats | None = None

    @cached_property
    def rest_length(self) -> Floats:
        """Length of every element, (m,) m."""
        return np.linalg.norm(self.points[self.edges[:, 1]] - self.points[self.edges[:, 0]], axis=1)

    @cached_property
    def inner(self) -> Ints:
        """Nodes inside walls, (h, 3): the previous element, the node, the next element."""
        at_end = np.flatnonzero(self.wall[1:] == self.wall[:-1])
        return np.column_stack([at_end, self.edges[at_end, 1], at_end + 1])

    @cached_property
    def stubs(self) -> NDArray[np.bool_]:
        """True for elements too short for a beam: the rest of a wall between solid joints, (m,).

        Their fibres would be bent far beyond a radius of half the thickness.
        """
        jointed = np.isin(self.wall, self.wall[self.joint >= 0])
        return jointed & (self.joint < 0) & (self.rest_length < SHORTEST * self.thickness)

    @cached_property
    def direction(self) -> Floats:
        """Direction of every element, (m, 2)."""
        along = self.points[self.edges[:, 1]] - self.points[self.edges[:, 0]]
        return np.asarray(along / self.rest_length[:, None])

    @cached_property
    def start(self) -> Ints:
        """First element of every wall, and the number of elements, (w + 1,)."""
        changes = 1 + np.flatnonzero(self.wall[1:] != self.wall[:-1])
        return np.concatenate([[0], changes, [len(self.wall)]])

    @cached_property
    def openings(self) -> tuple[Ints, Floats, Ints]:
        """Openings between neighbouring elements of every node.

        Nodes (f, 3): the opening is at the one in the middle, the angle anticlockwise from the
        first node to the last. Opening at rest (f,), rad. Its two elements (f, 2).
        """
        node, other = self.edges.ravel(), self.edges[:, ::-1].ravel()
        along = self.points[other] - self.points[node]
        bearing = np.arctan2(along[:, 1], along[:, 0])
        order = np.lexsort([bearing, node])
        node, other, bearing = node[order], other[order], bearing[order]
        following = next_arm(node)
        opened = np.mod(bearing[following] - bearing, 2 * np.pi)
        kept, element = following != np.arange(len(node)), order // 2
        nodes = np.column_stack([other, node, other[following]])
        return nodes[kept], opened[kept], np.column_stack([element, element[following]])[kept]

    @cached_property
    def node_length(self) -> Floats:
        """Sum of half the lengths of the elements at a node, (n,) m."""
        return self._halves(self.rest_length)

    @cached_property
    def node_area(self) -> Floats:
        """Sum of half the areas of the elements at a node, (n,) m^2."""
        return self._halves(self.rest_length * self.thickness)

    def _halves(self, values: Floats) -> Floats:
        """Sum over the elements at a node of half their ``values`` (m,): (n,)."""
        half = 0.5 * values
        shared = np.bincount(self.edges.ravel(), np.repeat(half, 2), minlength=len(self.points))
        return shared.astype(np.float64)


@lru_cache(maxsize=16)
def build_mesh(lattice: WallLattice, solid: bool, platen: str | None) -> tuple[Mesh, Arms]:
    """The mesh of a lattice between platens, and the ends of its walls.

    solid: joints are solid, not points. The mesh is cached, since consecutive cases often share it.
    """
    network, shift = build_network(lattice.geometry), lattice.imperfection * lattice.wall_thickness
    arms = solid_joints(network, platen) if solid else point_joints(len(network.walls))
    pieces = elements_of(network, lattice.nodes_per_wall + 1, arms)
    return split_walls(network, pieces, shift, arms.length), arms


def elements_of(network: Network, most: int, arms: Arms) -> Ints:
    """Number of equal elements of each wall, (w,): `pieces`, or fewer between solid joints.

    Between solid joints, and in a drawing, no element is shorter than `SHORTEST` thicknesses, below
    which a wall is no beam; in a sliced lattice none is shorter than a thickness, as the infill
    cuts the perimeters into pieces of any length.
    """
    free = network.length - arms.length.sum(axis=1)
    sliced = network.gyration is not None
    least = (1.0 if sliced else SHORTEST) * network.wall_thickness
    fit = np.floor(free / least * (1.0 + ROUND_OFF)).astype(np.int64)
    limited = (arms.length > 0.0).any(axis=1) | sliced | (network.part is not None)
    pieces = network.pieces(most)
    return np.where(limited, np.clip(fit, 1, pieces), pieces)


def split_walls(
    network: Network, pieces: int | Ints, imperfection: float, joint_length: Floats | None = None
) -> Mesh:
    """Split every wall into equal elements and shift all points sideways.

    pieces: number of equal elements, one for all walls or (w,). imperfection (m): amplitude of the
    stress-free shift in x, a `bow`. joint_length (w, 2): length of the elements for solid joints,
    m; 0: none.
    """
    walls = len(network.walls)
    if joint_length is None:
        joint_length = np.zeros((walls, 2))
    pieces, solid = np.broadcast_to(np.asarray(pieces), walls), joint_length > 0.0
    count = pieces + solid.sum(axis=1)
    inside = count - 1
    of_wall = np.repeat(np.arange(walls), inside)
    number = np.arange(len(of_wall)) - np.repeat(np.cumsum(inside) - inside, inside) + 1
    start, end = network.points[network.walls].swapaxes(0, 1)
    length = network.length
    equal = (length - joint_length.sum(axis=1)) / pieces
    place = joint_length[of_wall, 0] + (number - solid[of_wall, 0]) * equal[of_wall]
    share = (place / length[of_wall])[:, None]
    points = np.concatenate([network.points, start[of_wall] + share * (end - start)[of_wall]])
    if imperfection > 0.0:
        height, y = np.ptp(network.points[:, 1]), points[:, 1]
        points[:, 0] += bow(y - y.min(), imperfection, height)
    wall = np.repeat(np.arange(walls), count)
    last = np.cumsum(count) - 1
    first = last - inside
    node = len(network.points) + np.arange(len(wall)) - wall  # inner node at an element's end
    before, after = node - 1, node
    before[first], after[last] = network.walls.T
    joint = np.full(len(wall), -1)
    for side, at in enumerate((first, last)):
        joint[at[solid[:, side]]] = 2 * np.flatnonzero(solid[:, side]) + side
    return Mesh(
        points=points,
        edges=np.column_stack([before, after]),
        wall=wall,
        joint=joint,
        thickness=np.repeat(network.wall_thickness, count),
        n_joints=len(network.points),
        gyration=None if network.gyration is None else np.repeat(network.gyration, count),
    )


def bow(y: Floats, amplitude: float, height: float) -> Floats:
    """Shift in x at heights ``y`` above the base, amplitude x sin(pi y / height); all in m."""
    return np.asarray(amplitude * np.sin(np.pi * y / height))


def row_nodes(network: Network, mesh: Mesh, joints: Ints) -> Ints:
    """Nodes of an outer row: its ``joints``, and the nodes inside the walls between them."""
    on = np.zeros(len(mesh.points), np.bool_)
    on[joints] = True
    start, end = on[network.walls].T
    on[mesh.edges[(start & end)[mesh.wall]]] = True
    return np.flatnonzero(on)
