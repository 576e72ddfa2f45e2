"""The arrays of one case: every term of the energy, the unknowns and how they are driven.

A term that the scene lacks is an empty array: it costs nothing.
"""

from dataclasses import dataclass, field

import numpy as np

from kernels.solve import residual as balance
from kernels.terms import elements as chain, damping as damp, friction, spring, stretch
from kernels.linear import periodic_images as image, analysis as pattern
from kernels.planar.potential import Terms
from sweep.scene.bending import bends, build_bend, build_fold
from sweep.design.network import Network, build_network, mass
from sweep.scene.coordinates import BONDED, Layout, held, leaders
from sweep.scene.material import law_in_stretch
from sweep.scene.mesh import Floats, Ints, Mesh, build_mesh, row_nodes
from sweep.config.case import Case, Loading, Material, given
from sweep.scene.contact import contact_of, projection_of

STATIC_SLIP = 1e-3  # of the wall thickness
NO_SPRINGS = spring.Spring(np.empty((0, 2), np.int64), np.empty(0), np.empty(0))


@dataclass(frozen=True)
class Scene:
    """A case as arrays. x_rest (n,): m and rad; bottom, top, base, probes: as in `trace.Output`.

    velocity (n,) at the start. travel: of the driven coordinate where the case does not say, m.
    around (k, 2): elements of the copies round a period.
    """

    mesh: Mesh
    network: Network
    terms: Terms
    unknowns: balance.Unknowns
    x_rest: Floats
    bottom: Ints
    top: Ints
    base: Ints
    force_scale: float
    velocity: Floats
    probes: Ints = field(default_factory=lambda: np.empty(0, np.int64))
    travel: float = 0.0
    around: Ints = field(default_factory=lambda: np.empty((0, 2), np.int64))


def plane_factors(material: Material) -> tuple[float, float]:
    """Y'/Y in stretching and contact, and in bending."""
    strain = 1.0 / (1.0 - material.poisson**2)
    return {"strain": (strain, strain), "stress": (1.0, 1.0), "strain_bending": (1.0, strain)}[
        material.plane
    ]


def stretch_of(mesh: Mesh, case: Case) -> stretch.Stretch:
    """Rest lengths and cross-sections."""
    area = case.lattice.depth * mesh.thickness
    return stretch.Stretch(mesh.rest_length, area, case.solver.hessian == "exact")


def walls_of(mesh: Mesh, layout: Layout) -> chain.Walls:
    """Which elements and rotations make which wall."""
    rotation = layout.rotation[mesh.arm_joint]
    return chain.Walls(mesh.edges, mesh.start, mesh.arm_element, rotation)


def solved_by(mesh: Mesh, layout: Layout, leader: Ints, case: Case) -> pattern.Layout:
    """What the linear solver knows of the scene."""
    joints = mesh.arm_joint.reshape(-1, 2)
    outer = np.stack([2 * joints, 2 * joints + 1, layout.rotation[joints]], axis=-1)
    wall_of = np.full(layout.n_nodes, -1)
    before, node, _ = mesh.inner.T
    wall_of[node] = mesh.wall[before]
    axial = case.material.modulus * case.lattice.depth * mesh.thickness / mesh.rest_length
    return pattern.Layout(
        leader=leader,
        ratio=np.ones(layout.size),
        images=image.NONE,
        driven=layout.high if case.loading.mode == "displacement" else -1,
        n_nodes=layout.n_nodes,
        n_joints=layout.n_joints,
        origin=np.arange(layout.n_nodes),
        inner=mesh.edges[mesh.start[:-1], 1],
        wall_of=wall_of,
        outer=outer.reshape(-1, 6),
        scale=float(axial.max()),
    )


def masses_of(mesh: Mesh, layout: Layout, total: float, loading: Loading) -> Floats:
    """Lumped mass of each coordinate, kg; in each direction nodes sum to ``total``."""
    share = mesh.node_area
    masses = np.zeros(layout.size)
    masses[: 2 * layout.n_nodes] = np.repeat(total * share / share.sum(), 2)
    masses[layout.high] = loading.striker_mass or 0.0
    return masses


def _velocity(layout: Layout, leader: Ints, loading: Loading) -> Floats:
    """Velocity of each coordinate at the start: a striker flies with what is glued to it, m/s."""
    return np.where(leader == layout.high, -(loading.striker_speed or 0.0), 0.0)


def _load(layout: Layout, case: Case) -> Floats:
    """Total force downwards: on the upper platen, or spread equally over the top nodes."""
    load = np.zeros(layout.size)
    if case.loading.mode == "force":
        if case.loading.platen == "none":
            load[2 * layout.top + 1] = -given(case.loading.force) / len(layout.top)
        else:
            load[layout.high] = -given(case.loading.force)
    return load


def friction_of(case: Case) -> friction.Friction:
    """Slip speed, or a share of the wall thickness where there is no time."""
    slip = STATIC_SLIP * case.lattice.wall_thickness
    if case.contact.slip_speed is not None:
        slip = case.contact.slip_speed
    return friction.Friction(case.contact.friction or 0.0, slip)


def time_step(case: Case) -> float:
    """Duration of one step in s (of its pace, where the integrator is static)."""
    if case.loading.mode == "displacement":
        speed = case.loading.speed or case.lattice.height
        return given(case.loading.stroke) / speed / given(case.solver.load_steps)
    if case.solver.load_steps is not None:
        return given(case.loading.duration) / case.solver.load_steps
    return given(case.solver.time_step)


def damp_of(case: Case) -> damp.Damp:
    """Damping of the model that is chosen; none without time."""
    chosen = "none" if case.solver.integrator == "static" else case.damping.model
    if chosen == "rayleigh":
        return damp.Damp(given(case.damping.mass), given(case.damping.stiffness), 0.0)
    if chosen == "kelvin_voigt":
        return damp.Damp(0.0, 0.0, given(case.damping.relaxation_time))
    return damp.Damp(0.0, 0.0, 0.0)


def build_scene(case: Case) -> Scene:
    """Build the arrays of ``case``."""
    lattice, platen = case.lattice, case.loading.platen
    network, mesh = build_network(lattice), build_mesh(lattice)
    layout = Layout(
        len(mesh.points),
        mesh.n_joints,
        row_nodes(network, mesh, network.bottom),
        row_nodes(network, mesh, network.top),
    )
    in_stretch, in_bend = plane_factors(case.material)
    second_moment = lattice.depth * mesh.thickness**3 / 12
    rigidity = in_bend * case.material.modulus * second_moment
    bending = build_bend(mesh, rigidity, case)
    touching = in_stretch * case.material.modulus * lattice.depth * (case.contact.stiffness or 0.0)
    printed = mass(network, lattice.depth, case.material.density)
    fixed = held(layout, platen)
    if not bends(case):
        fixed = np.union1d(fixed, layout.rotation)
    tied = 2 * layout.top + 1 if platen in BONDED else np.empty(0, np.int64)
    follows = solved_by(mesh, layout, leaders(layout, fixed, tied), case)
    masses = masses_of(mesh, layout, printed, case.loading)
    terms = Terms(
        law=law_in_stretch(case.material, in_stretch),
        walls=walls_of(mesh, layout),
        stretch=stretch_of(mesh, case),
        bend=bending,
        fold=build_fold(mesh, bending, case),
        spring=NO_SPRINGS,
        contact=contact_of(mesh, layout, touching, case, by_force=True),
        friction=friction_of(case),
        damp=damp_of(case),
        mass=masses,
        load=_load(layout, case),
        layout=follows,
        project=projection_of(mesh, layout, follows, masses, case),
    )
    return Scene(
        mesh, network, terms, unknowns_of(mesh, layout, follows, case),
        _rest(mesh, layout, terms.contact.node_thickness), *_reported(layout, case.loading),
        force_scale=force_scale(network, rigidity),
        velocity=_velocity(layout, follows.leader, case.loading),
    )  # fmt: skip


def force_scale(network: Network, rigidity: Floats) -> float:
    """A force (N) that bends the longest wall. rigidity (m,): Y' I of every element, N m^2."""
    ends = network.points[network.walls]
    return float(np.min(rigidity) / np.max(np.linalg.norm(ends[:, 1] - ends[:, 0], axis=1)) ** 2)


def _rest(mesh: Mesh, layout: Layout, thickness: Floats) -> Floats:
    """Coordinates at rest; platens touch the outermost walls. thickness (n,): of nodes, m."""
    y, half = mesh.points[:, 1], 0.5 * thickness.round(15)
    platens = [(y - half).min(), (y + half).max()]
    return np.concatenate([mesh.points.ravel(), np.zeros(layout.n_joints), platens])


def _reported(layout: Layout, loading: Loading) -> tuple[Ints, Ints, Ints]:
    """Coordinates of the lower reaction, of the top and of the base.

    Strain is the travel of a driven platen or a striker, or of the loaded row. Under a loose loaded
    platen it is taken from the extent of the lattice itself, which jumps off when it is released.
    """
    bottom = 2 * layout.bottom + 1
    low, high = np.array([layout.low]), np.array([layout.high])
    bonded = dict.fromkeys(BONDED, np.append(bottom, low))
    reaction = ({"contact": low} | bonded).get(loading.platen or "", bottom)
    if loading.mode != "force":
        return reaction, high, low
    if loading.platen == "contact":
        return reaction, np.empty(0, np.int64), 2 * np.arange(layout.n_nodes) + 1
    return reaction, 2 * layout.top + 1, bottom


def unknowns_of(mesh: Mesh, layout: Layout, solved: pattern.Layout, case: Case) -> balance.Unknowns:
    """What moves, and how far at once."""
    lattice = case.lattice
    scale = np.ones(layout.size)
    scale[layout.rotation] = mesh.rest_length.mean()
    return balance.Unknowns(
        leader=solved.leader,
        ratio=solved.ratio,
        images=solved.images,
        scale=scale,
        lever=1.0 / scale,
        driven=solved.driven,
        cap=0.25 * min(lattice.width, lattice.height) / max(lattice.cells_x, lattice.cells_y),
        leap=0.1 * lattice.wall_thickness,
        close=1e-3 * lattice.wall_thickness,
    )
