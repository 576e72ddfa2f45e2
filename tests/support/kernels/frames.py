"""Small frames of straight walls for tests of kernels: geometry, and the terms that belong to it.

Lengths in mm, pressures in MPa, forces in N and so energies in mJ, unless ``scaled`` to others.
"""

from dataclasses import dataclass, replace
from itertools import pairwise

import numpy as np

from kernels.compile.reference import by_reference
from kernels.geometry import near_pairs
from kernels.laws import elastic
from kernels.laws.fibre import Fibre
from kernels.linear.condensed import analysis, periodic_images
from kernels.planar import position_based
from kernels.planar.problem import PlanarScene
from kernels.solve.problem import FREE, Coordinates
from kernels.terms import (
    bend,
    contact,
    contact_near_joints,
    damping,
    elements,
    fold,
    friction,
    section,
    spring,
    stretch,
)
from sweep.scene.bending import FIBRE, OUTER
from sweep.scene.material import bent_section
from sweep.scene.profiles import NO_PROFILES
from tests.support.materials.memory import relaxing

MODULUS, DEPTH = 12.0, 10.0
NO_SPRINGS = spring.Spring(np.empty((0, 2), np.int64), np.empty(0), np.empty(0))


@dataclass(frozen=True)
class Frame:
    """Nodes and elements; the joints come first among the nodes, single walls are one element.

    points (n, 2). edges (m, 2). pieces (m,): elements in the wall of an element. thickness (m,).
    """

    points: np.ndarray
    edges: np.ndarray
    pieces: np.ndarray
    thickness: np.ndarray
    joints: int
    modulus: float = MODULUS
    depth: float = DEPTH
    millimetre: float = 1.0

    @property
    def l0(self) -> np.ndarray:
        """Rest length of every element, (m,)."""
        return np.linalg.norm(self.points[self.edges[:, 1]] - self.points[self.edges[:, 0]], axis=1)

    @property
    def rigidity(self) -> np.ndarray:
        """Y I of every element, (m,)."""
        return self.modulus * self.depth * self.thickness**3 / 12

    @property
    def start(self) -> np.ndarray:
        """First element of every wall and the end of the last, (w + 1,)."""
        return np.append(np.flatnonzero(self.edges[:, 0] < self.joints), len(self.edges))

    @property
    def rest(self) -> np.ndarray:
        """Coordinates: nodes, their rotations, lower and upper platen far away."""
        far = 100.0 * self.millimetre
        return np.concatenate([self.points.ravel(), np.zeros(len(self.points)), [-far, far]])

    @property
    def direction(self) -> np.ndarray:
        """Direction of every element at rest, (m, 2)."""
        along = self.points[self.edges[:, 1]] - self.points[self.edges[:, 0]]
        return along / self.l0[:, None]

    @property
    def unit(self) -> np.ndarray:
        """Size of a coordinate: 1 mm, or 1 rad."""
        unit = np.full(self.rest.size, self.millimetre)
        unit[2 * len(self.points) : -2] = 1.0
        return unit


def frame(joints, walls, pieces, thickness=0.8) -> Frame:
    """Frame of ``walls`` (pairs of joints), each split into its number of ``pieces``."""
    joints = np.array(joints, dtype=float)
    pieces = np.broadcast_to(pieces, len(walls))
    points, edges = list(joints), []
    for (a, b), n in zip(walls, pieces, strict=True):
        inside = list(range(len(points), len(points) + n - 1))
        points += [joints[a] + s * (joints[b] - joints[a]) for s in np.arange(1, n) / n]
        chain = [a, *inside, b]
        edges += pairwise(chain)
    return Frame(
        points=np.array(points),
        edges=np.array(edges),
        pieces=np.repeat(pieces, pieces),
        thickness=np.repeat(np.broadcast_to(thickness, len(walls)), pieces).astype(float),
        joints=len(joints),
    )


def grid(cells: int, size: float, pieces: int, thickness=0.8) -> Frame:
    """Square grid of ``cells`` x ``cells`` cells, ``size`` over centre lines."""
    n = cells + 1
    joints = [(size * i / cells, size * j / cells) for j in range(n) for i in range(n)]
    along = [(n * j + i, n * j + i + 1) for j in range(n) for i in range(cells)]
    up = [(n * j + i, n * j + i + n) for j in range(cells) for i in range(n)]
    return frame(joints, along + up, pieces, thickness)


def joint_of_four() -> Frame:
    """Four walls at one joint: two in line, one across, one in three pieces at an angle."""
    joints = [(0, 0), (3, 0), (-2.5, 0), (0.3, 2.2), (-2.0, -1.4)]
    return frame(joints, [(0, 1), (2, 0), (0, 3), (0, 4)], [2, 1, 1, 3], [0.8, 0.8, 0.5, 0.6])


def scaled(of: Frame, length: float) -> Frame:
    """The same frame in a unit of length, ``length`` of which make a millimetre (forces in N)."""
    return replace(
        of,
        points=of.points * length,
        thickness=of.thickness * length,
        modulus=of.modulus / length**2,
        depth=of.depth * length,
        millimetre=of.millimetre * length,
    )


def shaken(of: Frame, seed: int, amount: float = 0.2) -> np.ndarray:
    """Rest state with all but the platens moved at random, by ``amount`` of a coordinate's unit."""
    move = amount * of.unit * np.random.default_rng(seed).uniform(-1, 1, of.unit.size)
    move[-2:] = 0.0
    return of.rest + move


def carried(of: Frame, x: np.ndarray, angle: float, shift=(0.7, -0.4)) -> np.ndarray:
    """State ``x`` after a rigid motion of all nodes."""
    n = 2 * len(of.points)
    turn = np.array([[np.cos(angle), -np.sin(angle)], [np.sin(angle), np.cos(angle)]])
    nodes = x[:n].reshape(-1, 2) @ turn.T + of.millimetre * np.array(shift)
    return np.concatenate([nodes.ravel(), x[n:-2] + angle, x[-2:]])


def linear_law(modulus: float) -> elastic.ElasticCurve:
    """Stress = modulus x strain."""
    knots, slopes = np.array([-1.0, 1.0]), np.array([[-modulus, modulus, 0.0, 0.0]])
    return elastic.ElasticCurve(knots, slopes, np.full(2, 0.5 * modulus), modulus)


def curve_law(modulus: float) -> elastic.ElasticCurve:
    """Curve with a rise, a plateau that falls a little, and a branch in compression; C1."""
    knots = np.array([-0.5, 0.0, 0.1, 0.4, 1.0])
    stress = modulus * np.array([-0.8, 0.0, 0.07, 0.065, 0.3])
    slope = modulus * np.array([2.2, 1.0, 0.3, -0.1, 0.8])
    width = np.diff(knots)
    secant = np.diff(stress) / width
    square = (3 * secant - 2 * slope[:-1] - slope[1:]) / width
    cube = (slope[:-1] + slope[1:] - 2 * secant) / width**2
    pieces = np.column_stack([stress[:-1], slope[:-1], square, cube])
    gained = np.sum(pieces * width[:, None] ** np.arange(1, 5) / np.arange(1, 5), axis=1)
    energy = np.concatenate([[0.0], np.cumsum(gained)])
    return elastic.ElasticCurve(knots, pieces, energy - energy[1], modulus)


def point_of(curve: elastic.ElasticCurve | elastic.FibreCurve) -> Fibre:
    """The law of a material point without a memory."""
    return relaxing(curve)


def fibre_of(curve: elastic.ElasticCurve) -> Fibre:
    """The law of a fibre without a memory."""
    return point_of(elastic.FibreCurve(*curve))


def section_of(fibre: Fibre, m: float = 1.0, radial: float = 0.0) -> section.BentSection:
    """A section of three fibres."""
    return bent_section(fibre, (np.array([1.0, -1.0]), np.ones(2)), m, (radial, 5.0 / 3.0), 0.0)


def walls_of(of: Frame) -> elements.Walls:
    x, turn = 2 * of.edges, 2 * len(of.points) + of.edges
    dofs = np.stack([x, x + 1, turn], axis=-1).reshape(-1, 6)
    return elements.Walls(of.edges, of.start, of.direction, dofs)


def stretch_of(of: Frame, arc: tuple[float, float] = (1 / 15, -1 / 30)) -> stretch.Stretch:
    m = len(of.edges)
    return stretch.Stretch(of.l0, of.depth * of.thickness, np.tile(np.array(arc)[:, None], m), True)


def bend_of(of: Frame, measure: int = bend.ANGLE, cubic: bool = True) -> bend.Bend:
    """Linear bending of ``cubic`` or classical elements."""
    factors = (4.0, 2.0, 4.0) if cubic else (2.0, 0.0, 2.0)
    return bend.Bend(
        measure=measure,
        stiffness=np.outer(factors, of.rigidity / of.l0),
        side=np.where(of.edges < of.joints, 2.0, 1.0).T.copy(),
        section=section_of(fibre_of(linear_law(1.0))),
        hinge=fibre_of(linear_law(1.0)),
        spread=np.empty((2, 0)),
        volume=np.empty(0),
        shear=np.empty(0),
    )


def sections_of(of: Frame, law: section.BentSection, cubic: bool = True) -> bend.Bend:
    """Bending of elements without shear through the ``law`` of their section."""
    across = FIBRE * of.thickness / of.l0
    along = across * (np.sqrt(3.0) if cubic else 1.0)
    volume = OUTER / 2 * of.depth * of.thickness * of.l0
    return bend_of(of, cubic=cubic)._replace(
        section=law, spread=np.stack([across, along]), volume=volume, shear=np.zeros(len(of.l0))
    )


def contact_of(of: Frame, stiffness: float = 1.0) -> contact.Contact:
    """Contact of all walls with one another and of all nodes with two platens; c: ``stiffness``."""
    n = len(of.points)
    half = np.repeat(0.5 * of.l0, 2)
    tributary = np.bincount(of.edges.ravel(), half, n)
    node_thickness = np.bincount(of.edges.ravel(), half * np.repeat(of.thickness, 2), n) / tributary
    mesh = of.points.ravel(), of.edges, of.l0, node_thickness, of.thickness, tributary
    return contact.Contact(
        stiffness * of.modulus * of.depth, of.thickness.max(), np.inf, of.edges, tributary,
        node_thickness, of.thickness, contact_near_joints.owners(n, of.edges),
        *contact_near_joints.special_pairs(*mesh),
        np.arange(n), of.rest.size - 2, of.rest.size - 1, NO_PROFILES, 0.0, 0.0,
    )  # fmt: skip


def layout_of(of: Frame, held=(), tied=(), driven: bool = False) -> analysis.Layout:
    """``held`` coordinates and the lower platen do not move, ``tied`` ones follow the upper one."""
    n, size, nodes = len(of.points), of.rest.size, np.arange(len(of.points))
    point = np.concatenate([nodes.repeat(2), nodes, [n, n]])
    slot = np.concatenate([np.tile([0, 1], n), np.full(n, 2), [0, 0]])
    leader = np.arange(size)
    leader[list(tied)] = size - 1
    leader[[*held, size - 2]] = -1
    wall_of = np.full(n + 1, -1)
    inside = np.flatnonzero(of.edges[:, 1] >= of.joints)
    wall_of[of.edges[inside, 1]] = np.searchsorted(of.start, inside, "right") - 1
    dofs = walls_of(of).dofs
    outer = np.hstack([dofs[of.start[:-1], :3], dofs[of.start[1:] - 1, 3:]])
    inner, axial = dofs[inside, 3:].ravel(), of.modulus * of.depth * of.thickness / of.l0
    scale = axial.max() * np.array([1.0, 1.0, of.thickness.max() ** 2 / 3.0])
    return analysis.Layout(
        leader, np.ones(size), periodic_images.NONE, size - 1 if driven else -1, point, slot,
        n, 2 * nodes, np.arange(n + 1), inner, wall_of, outer, tuple(scale),
    )  # fmt: skip


def terms_of(of: Frame, law: Fibre, measure: int, damped: damping.Damp) -> PlanarScene:
    """The data that damping reads: law, walls, stretch, bend, damp and mass; no folds and no
    contact.
    """
    share = np.bincount(of.edges.ravel(), np.repeat(of.l0 * of.thickness, 2), len(of.points))
    n = of.rest.size
    mass, one, none = np.zeros(n), np.ones(n), np.empty(0)
    mass[: 2 * len(of.points)] = np.repeat(share, 2)
    role, load = np.full(n, FREE), np.zeros(n)
    scene = PlanarScene(
        Coordinates(role, one, one, mass, one, load, -1, 1.0, 1.0, 1.0), law, walls_of(of),
        stretch_of(of), bend_of(of, measure), fold.Fold(np.empty((0, 3), np.int64), none, none),
        NO_SPRINGS, contact_of(of), friction.Friction(0.0, 1.0), damped, layout_of(of),
        position_based.Projection(contact_of(of), none),
    )  # fmt: skip
    return by_reference(scene)


def two_walls(gap: float, pieces=(3, 3), length=4.0, slope=0.0, shift=0.0) -> Frame:
    """Two walls along x, the upper one ``gap`` above the lower; joints 0, 1 and 2, 3."""
    joints = [(0, 0), (length, 0), (shift, gap), (length + shift, gap + slope * length)]
    return frame(joints, [(0, 1), (2, 3)], pieces)


def touching(of: Frame, apart: float = 50.0) -> contact.Contact:
    """Contact of two walls that are not near each other at rest, so that no rule reduces it."""
    moved = of.points.copy()
    upper = np.unique(of.edges[of.pieces[0] :])
    moved[upper, 1] += apart * of.millimetre
    return contact_of(replace(of, points=moved))


def only(listed: near_pairs.Pairs, node: int) -> near_pairs.Pairs:
    """The pairs of one node."""
    return near_pairs.Pairs(*(column[listed.node == node] for column in listed))
