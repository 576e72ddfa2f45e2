"""The data of every term of the energy, for scenes of all kinds.

A term that a scene does not have consists of empty arrays and costs nothing.
"""

from dataclasses import dataclass, field
from typing import NamedTuple

import numpy as np

from kernels.linear.condensed import analysis, periodic_images
from kernels.planar.position_based import Projection
from kernels.planar.problem import PlanarScene, at_rest
from kernels.plates.layout import Layout as LayoutOfPlates
from kernels.solve import march
from kernels.solve.history import State
from kernels.solve.problem import FREE, HELD, LED, TIED, Coordinates
from kernels.terms import damping, elements, friction, spring, stretch
from kernels.terms.contact import Contact
from kernels.terms.fold import Fold
from kernels.terms.spring import Spring
from sweep.array_types import Floats, Ints
from sweep.config.case import Case
from sweep.config.kinds.crush import Crush
from sweep.config.kinds.damping import KelvinVoigt, Rayleigh
from sweep.config.kinds.impact import Impact
from sweep.config.kinds.loading import Loading
from sweep.config.kinds.solver import InTime, Static
from sweep.config.kinds.steps import rows_in_load_step
from sweep.design.network import Network, mass
from sweep.scene.beams import build_beams, plane_factors, rigidity_of
from sweep.scene.bending import build_bend
from sweep.scene.coordinates import BetweenPlatens, Numbering
from sweep.scene.joints import Arms
from sweep.scene.material import law_in_stretch
from sweep.scene.mesh import Mesh

STATIC_SLIP = 0.2  # share of the wall thickness, in all steps of a loading together
NO_SPRINGS = Spring(np.empty((0, 2), np.int64), np.empty(0), np.empty(0))


@dataclass(frozen=True)
class Scene:
    """A case as arrays.

    x_rest (n,): coordinates at rest, m and rad. bottom, top, base, standing, probes: as in
    `rows.Output`. force_scale: a typical force, N. velocity (n,): at the start, m/s and rad/s.
    travel: of the driven coordinate of a custom structure, m. around (k, 2): elements of the copies
    round a period. solid_joint_share: share of the walls that are between solid joints.
    """

    mesh: Mesh
    network: Network
    terms: PlanarScene
    x_rest: Floats
    bottom: Ints
    top: Ints
    base: Ints
    force_scale: float
    velocity: Floats
    standing: Ints = field(default_factory=lambda: np.empty(0, np.int64))
    probes: Ints = field(default_factory=lambda: np.empty(0, np.int64))
    travel: float = 0.0
    around: Ints = field(default_factory=lambda: np.empty((0, 2), np.int64))
    solid_joint_share: float = 0.0

    @property
    def size(self) -> float:
        """Extent of the nodes, m."""
        return float(np.ptp(self.mesh.points))

    def largest_force(self, stage: march.Stage) -> float:
        """Force (N) whose round-off enters the residual of a step."""
        terms, coordinates, size = self.terms, self.terms.coordinates, np.ptp(self.mesh.points)
        force = terms.law.modulus * terms.stretch.area.max() * size / terms.stretch.l0.min()
        if stage.dynamic:
            dt = stage.duration
            force *= 1.0 + (terms.damp.beta_k + terms.damp.relaxation) / dt
            force += coordinates.mass.max() * size / dt * (1.0 / dt + terms.damp.alpha_m)
        return float(force)

    def at_rest(self) -> State:
        """The state at the start, without velocities."""
        return at_rest(self.terms, self.x_rest)

    def strained(self) -> float:
        """Energy, J, of springs that are drawn at another length than their rest length."""
        return float(spring.evaluate(self.x_rest, self.terms.spring, np.zeros_like(self.x_rest)))


class Parts(NamedTuple):
    """The data that depend on the kind of scene.

    arms: ends of the walls. walls: topology. layout: constraints and structure of the linear
    system. mass (n,) in kg and load (n,) in N or N m of each coordinate. The others are terms of
    the energy.
    """

    arms: Arms
    walls: elements.Walls
    layout: analysis.Layout
    fold: Fold
    contact: Contact
    project: Projection
    mass: Floats
    load: Floats
    spring: Spring = NO_SPRINGS


def assemble(case: Case, mesh: Mesh, numbering: Numbering, parts: Parts) -> PlanarScene:
    """The data of all terms of a scene."""
    in_stretch, _ = plane_factors(case.material)
    beams = build_beams(mesh, parts.arms, case)
    return PlanarScene(
        coordinates=coordinates_of(case, mesh, numbering, parts),
        law=law_in_stretch(case.material, in_stretch),
        walls=parts.walls,
        stretch=stretch.Stretch(
            mesh.rest_length, beams.area, beams.arc, case.solver.hessian == "exact"
        ),
        bend=build_bend(mesh, beams, case),
        fold=parts.fold,
        spring=parts.spring,
        contact=parts.contact,
        friction=friction_of(case),
        damp=damp_of(case),
        layout=parts.layout,
        project=parts.project,
    )


def coordinates_of(case: Case, mesh: Mesh, numbering: Numbering, parts: Parts) -> Coordinates:
    """The data of the coordinates that the solver needs."""
    lattice, layout = case.lattice, parts.layout
    scale = np.ones(numbering.size)
    scale[numbering.rotation] = mesh.rest_length.mean()
    moving, images = heavy(layout, parts.mass), layout.images[layout.images[:, 1] >= 0]
    moving[images[:, 0]] = moving[images[:, 1]]
    return Coordinates(
        role=roles(layout),
        scale=scale,
        lever=1.0 / scale,
        mass=parts.mass,
        heavy=moving,
        load=parts.load,
        driven=layout.driven,
        cap=0.25 * min(lattice.width / lattice.cells_x, lattice.height / lattice.cells_y),
        leap=0.1 * lattice.wall_thickness,
        close=1e-3 * lattice.wall_thickness,
    )


def roles(layout: analysis.Layout | LayoutOfPlates) -> Ints:
    """Role of each coordinate, (n,): `FREE`, `TIED` to another one, `LED` or `HELD`."""
    leader = layout.leader
    role = np.where(leader == np.arange(leader.size), FREE, TIED)
    if layout.driven >= 0:
        role[leader == layout.driven] = LED
    role[leader < 0] = HELD
    return role


def heavy(layout: analysis.Layout | LayoutOfPlates, mass: Floats) -> Floats:
    """1 for a moving coordinate with mass, its own or of a coordinate tied with it; else 0.

    (n,); 0 for coordinates that follow the driven one.
    """
    moving = np.flatnonzero(layout.leader >= 0)
    leader = layout.leader[moving]
    moved = np.bincount(leader, layout.ratio[moving] * mass[moving], mass.size)
    flags = np.zeros(mass.size)
    flags[moving] = (moved[leader] > 0.0) & (leader != layout.driven)
    return flags


def walls_of(mesh: Mesh, rotation: Ints) -> elements.Walls:
    """The elements of every wall. rotation (m, 2): coordinates of rotations at their ends."""
    dofs = np.stack([2 * mesh.edges, 2 * mesh.edges + 1, rotation], axis=-1).reshape(-1, 6)
    return elements.Walls(mesh.edges, mesh.start, mesh.direction, dofs)


def solved_by(
    mesh: Mesh, walls: elements.Walls, numbering: Numbering, leader: Ints, case: Case
) -> analysis.Layout:
    """The layout of the linear system. leader (n,): the coordinate that each one follows."""
    first, last, points = mesh.start[:-1], mesh.start[1:] - 1, 1 + numbering.point.max()
    wall_of = np.full(points, -1)
    before, node, _ = mesh.inner.T
    wall_of[node] = mesh.wall[before]
    axial = case.material.modulus * case.lattice.depth * mesh.thickness / mesh.rest_length
    stiffest = float(axial.max())
    return analysis.Layout(
        leader=leader,
        ratio=np.ones(numbering.size),
        images=periodic_images.NONE,
        driven=driven_by(case.loading, numbering),
        point=numbering.point,
        slot=numbering.slot,
        n_nodes=numbering.n_nodes,
        first=2 * np.arange(numbering.n_nodes),
        origin=np.arange(points),
        inner=walls.dofs[before, 3:].ravel(),
        wall_of=wall_of,
        outer=np.hstack([walls.dofs[first, :3], walls.dofs[last, 3:]]),
        scale=(stiffest, stiffest, float((axial * mesh.thickness**2).max()) / 3.0),
    )


def driven_by(loading: Loading, numbering: BetweenPlatens) -> int:
    """The coordinate whose motion a loading prescribes; -1 if there is none."""
    return numbering.high if isinstance(loading, Crush) else -1


class Striker(NamedTuple):
    """Mass (kg), speed (m/s) and weight (N) of the striker; the weight is 0 without gravity."""

    mass: float = 0.0
    speed: float = 0.0
    weight: float = 0.0


def striker_of(loading: Loading) -> Striker:
    """The striker of a loading; without one, all 0."""
    if isinstance(loading, Impact):
        return Striker(loading.striker_mass, loading.striker_speed, loading.weight)
    return Striker()


def target_of(loading: Loading) -> float | None:
    """Mass of a base that moves freely, kg; None for a fixed base."""
    return loading.target_mass if isinstance(loading, Impact) else None


def masses_of(case: Case, network: Network, numbering: Numbering, area: Floats) -> Floats:
    """Lumped mass of each coordinate, kg: of striker and free base, and, in x and in y, of the
    nodes, which share the printed mass by the ``area`` (n,) of their walls, m^2.
    """
    printed = mass(network, case.lattice.depth, case.material.density)
    masses = np.zeros(numbering.size)
    masses[: 2 * numbering.n_nodes] = np.repeat(printed * area / area.sum(), 2)
    masses[numbering.high] = striker_of(case.loading).mass
    masses[numbering.low] = target_of(case.loading) or 0.0
    return masses


def friction_of(case: Case) -> friction.Friction:
    """Friction coefficient and smoothing: a slip speed in m/s, or a slip length in m in statics."""
    slip = case.contact.slip_speed
    if slip is None:
        rows = (case.solver.load_steps or 1) * rows_in_load_step(case.solver, case.material)
        slip = STATIC_SLIP * case.lattice.wall_thickness / rows
    return friction.Friction(case.contact.friction, slip)


def time_step(case: Case) -> float:
    """Duration of one step in s; in statics a nominal one."""
    loading, solver = case.loading, case.solver
    if isinstance(loading, Crush):
        return loading.stroke / (loading.speed or case.height) / (solver.load_steps or 1)
    return solver.time_step if isinstance(solver, InTime) else loading.duration / solver.load_steps


def damp_of(case: Case) -> damping.Damp:
    """The data of the chosen damping model; no damping in statics."""
    match case.damping:
        case Rayleigh(mass=alpha, stiffness=beta) if not isinstance(case.solver, Static):
            return damping.Damp(alpha, beta, 0.0)
        case KelvinVoigt(relaxation_time=time) if not isinstance(case.solver, Static):
            return damping.Damp(0.0, 0.0, time)
    return damping.Damp(0.0, 0.0, 0.0)


def force_scale(case: Case, network: Network) -> float:
    """Typical force, N: least Y' I / (longest wall)^2."""
    rigidity = rigidity_of(case, network.wall_thickness, network.gyration)
    return float(rigidity.min() / network.length.max() ** 2)
