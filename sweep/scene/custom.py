"""The arrays of a custom structure: walls, supports, loads, prescribed moves, springs, floor.

All prescribed moves follow one coordinate, the driver. It goes from 0 to the largest prescribed
move as the load factor goes from 0 to 1; every other move is proportional to it.
"""

from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np

from kernels.linear.condensed import analysis
from kernels.terms import contact, spring
from sweep.array_types import Floats, Ints
from sweep.config.case import Case
from sweep.config.kinds.custom_structure import CustomStructure
from sweep.config.structures.structure import Structure
from sweep.constants import MM
from sweep.design.network import Network
from sweep.scene.beams import bends
from sweep.scene.bending import build_fold
from sweep.scene.contact import contact_of, projection_of
from sweep.scene.coordinates import Numbering
from sweep.scene.joints import Arms, find_arms, point_joints
from sweep.scene.mesh import Mesh, split_walls
from sweep.scene.scene import (
    Parts,
    Scene,
    assemble,
    force_scale,
    masses_of,
    solved_by,
    walls_of,
)

SUDDEN = 5e-3  # share of t^2 / size; a slender column buckles after it shortens by 0.8 t^2 / L
FAR = 1e3  # height of the ceiling that contact requires / size of a structure
DIRECTIONS = ("x", "y", "rotation")


@dataclass(frozen=True)
class Ground(Numbering):
    """Numbering with a floor, a ceiling out of reach, and the driver as the last coordinate.

    pinned: number of wall ends at pins. Each has a rotation and a point of its own, numbered after
    the nodes and the platens.
    """

    pinned: int

    @property
    def free_ends(self) -> Ints:
        """Coordinates of the rotations of wall ends at pins, (pinned,)."""
        return 3 * self.n_nodes + np.arange(self.pinned)

    @property
    def point(self) -> Ints:
        """Point of each coordinate, (size,)."""
        nodes, n = np.arange(self.n_nodes), self.n_nodes
        return np.r_[nodes.repeat(2), nodes, n + 1 + np.arange(self.pinned), n, n, n]

    @property
    def slot(self) -> Ints:
        """Place of each coordinate in the block of its point, (size,)."""
        turning = np.full(self.n_nodes + self.pinned, 2)
        return np.r_[np.tile([0, 1], self.n_nodes), turning, 0, 0, 0]

    @property
    def low(self) -> int:
        """Coordinate of the floor."""
        return 3 * self.n_nodes + self.pinned

    @property
    def ceiling(self) -> int:
        """Coordinate of the ceiling, which nothing reaches."""
        return self.low + 1

    @property
    def high(self) -> int:
        """Coordinate of the driver."""
        return self.low + 2

    def coordinate(self, node: int, direction: str) -> int:
        """Coordinate of a node, numbered as in the structure file, in a direction."""
        return (2 * node, 2 * node + 1, 2 * self.n_nodes + node)[DIRECTIONS.index(direction)]


def build_structure(case: Case) -> Scene:
    """Build the arrays of a ``case`` with a custom structure."""
    assert isinstance(case.lattice, CustomStructure)
    structure = case.lattice.structure
    network = case.lattice.network
    arms = _arms(network, structure, case)
    mesh = split_walls(network, np.array(structure.pieces), 0.0, arms.length)
    none = np.empty(0, np.int64)
    at_pin = np.isin(mesh.edges, structure.pins)
    numbering = Ground(len(mesh.points), none, none, int(at_pin.sum()))
    rotation = numbering.rotation[mesh.edges]
    rotation[at_pin] = numbering.free_ends
    walls = walls_of(mesh, rotation)
    travel = _travel(structure, mesh)
    driver = numbering.high if travel else -1
    leader = _leaders(structure, numbering, driver)
    if not bends(case):
        leader[rotation] = -1
    layout = solved_by(mesh, walls, numbering, leader, case)
    layout = layout._replace(ratio=_ratio(structure, numbering, travel), driven=driver)
    touch = contact_of(mesh, numbering, case)
    masses = _masses(structure, masses_of(case, network, numbering, mesh.node_area))
    parts = Parts(
        arms=arms,
        walls=walls,
        layout=layout,
        fold=build_fold(mesh, case),
        contact=_on_floor(touch, structure, numbering),
        project=projection_of(mesh, numbering, layout, masses, case),
        mass=masses,
        load=_load(structure, numbering, masses),
        spring=_springs(structure),
    )
    terms = assemble(case, mesh, numbering, parts)
    size = np.hypot(*np.ptp(network.points, axis=0))
    span = max(MM * _distances(structure, structure.walls).max(), 0.25 * size)
    close = min(terms.coordinates.close, SUDDEN * mesh.thickness.min() ** 2 / size)
    coordinates = terms.coordinates._replace(cap=0.25 * span, close=close)
    return Scene(
        mesh, network, terms._replace(coordinates=coordinates), _rest(structure, mesh, numbering),
        bottom=np.array([numbering.low]),
        top=none,
        base=2 * np.arange(numbering.n_nodes) + 1,
        force_scale=force_scale(case, network),
        velocity=_velocity(structure, mesh, layout),
        probes=_probed(structure, numbering),
        travel=travel,
        solid_joint_share=float(arms.sheared.mean()),
    )  # fmt: skip


def _arms(network: Network, structure: Structure, case: Case) -> Arms:
    """The ends of the walls; a wall is a beam where it ends at a support or a pin."""
    if case.solver.joints == "points":
        return point_joints(len(network.walls))
    supported = [node for node, _ in structure.restraints] + [
        part.node for part in structure.prescribed
    ]
    plain = np.array([*supported, *structure.pins], np.int64)
    return find_arms(network, network.walls, (), plain)


def _distances(structure: Structure, pairs: Iterable[tuple[int, int]]) -> Floats:
    """Distances of pairs of nodes, mm."""
    ends = np.array(structure.nodes_mm)[np.array(list(pairs), np.int64).reshape(-1, 2)]
    return np.asarray(np.linalg.norm(ends[:, 1] - ends[:, 0], axis=1))


def _travel(structure: Structure, mesh: Mesh) -> float:
    """The largest prescribed move, m; rotations count by the mean length of elements."""
    levers = {"rotation": float(mesh.rest_length.mean())}
    moves = (abs(part.move) * levers.get(part.direction, 1.0) for part in structure.prescribed)
    return max(moves, default=0.0)


def _leaders(structure: Structure, numbering: Ground, driver: int) -> Ints:
    """The coordinate that each one follows: itself, the ``driver``, or -1.

    -1: held, or the unused rotation of a pin; also the driver, if all prescribed moves are zero.
    """
    leader = np.arange(numbering.size)
    leader[[numbering.low, numbering.ceiling]] = -1
    leader[numbering.high] = driver
    for node, direction in structure.restraints:
        leader[numbering.coordinate(node, direction)] = -1
    for node in structure.pins:
        leader[numbering.coordinate(node, "rotation")] = -1
    for part in structure.prescribed:
        leader[numbering.coordinate(part.node, part.direction)] = driver
    return leader


def _ratio(structure: Structure, numbering: Ground, travel: float) -> Floats:
    """Motion of each coordinate / motion of the driver."""
    ratio = np.ones(numbering.size)
    for part in structure.prescribed if travel else ():
        ratio[numbering.coordinate(part.node, part.direction)] = part.move / travel
    return ratio


def _springs(structure: Structure) -> spring.Spring:
    nodes = [part.nodes for part in structure.springs]
    rest = zip(structure.springs, _distances(structure, nodes), strict=True)
    return spring.Spring(
        np.array(nodes, np.int64).reshape(-1, 2),
        np.array([part.stiffness_N_mm / MM for part in structure.springs]),
        np.array([MM * float(part.rest_length_mm or apart) for part, apart in rest]),
    )


def _on_floor(touch: contact.Contact, structure: Structure, numbering: Ground) -> contact.Contact:
    """Contact of all nodes with the floor, where there is one."""
    nodes = np.arange(numbering.n_nodes if structure.floor_y_mm is not None else 0)
    return touch._replace(platen_nodes=nodes, low=numbering.low, high=numbering.ceiling)


def _masses(structure: Structure, masses: Floats) -> Floats:
    """Masses of the coordinates, including the point masses of the file, kg."""
    for part in structure.masses:
        masses[[2 * part.node, 2 * part.node + 1]] += MM * part.mass_g
    return masses


def _load(structure: Structure, numbering: Ground, masses: Floats) -> Floats:
    """Weight, forces (N) and moments (N m) by coordinate."""
    load = np.zeros(numbering.size)
    for axis, gravity in enumerate(structure.gravity_mm_s2):
        nodes = slice(axis, 2 * numbering.n_nodes, 2)
        load[nodes] = MM * gravity * masses[nodes]
    for part in structure.loads:
        load[[2 * part.node, 2 * part.node + 1]] += part.force_N
        load[numbering.coordinate(part.node, "rotation")] += MM * part.moment_Nmm
    return load


def _rest(structure: Structure, mesh: Mesh, numbering: Ground) -> Floats:
    floor = MM * (structure.floor_y_mm or 0.0)
    far = mesh.points[:, 1].max() + FAR * np.ptp(mesh.points)
    return np.concatenate(
        [mesh.points.ravel(), np.zeros(numbering.low - mesh.points.size), [floor, far, 0.0]]
    )


def _probed(structure: Structure, numbering: Ground) -> Ints:
    """Coordinates of the probes, three per node."""
    probed = [numbering.coordinate(node, way) for node in structure.probes for way in DIRECTIONS]
    return np.array(probed, np.int64)


def _velocity(structure: Structure, mesh: Mesh, layout: analysis.Layout) -> Floats:
    """Initial velocity of each coordinate, linear along walls; zero if held or prescribed."""
    moving, walls = MM * np.array(structure.velocity_mm_s), np.array(structure.walls)
    inner, wall = mesh.inner[:, 1], mesh.wall[mesh.inner[:, 0]]
    start, end = mesh.points[walls[wall]].swapaxes(0, 1)
    share = np.linalg.norm(mesh.points[inner] - start, axis=1) / np.linalg.norm(end - start, axis=1)
    first, last = moving[walls[wall]].swapaxes(0, 1)
    between = first + share[:, None] * (last - first)
    moving = np.concatenate([moving, between]).ravel()
    velocity = np.zeros(layout.leader.size)
    free = layout.leader[: moving.size] == np.arange(moving.size)
    velocity[: moving.size] = np.where(free, moving, 0.0)
    return velocity
