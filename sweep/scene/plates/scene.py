"""The arrays of a lattice that is pressed along its cells: constraints, shells, platens."""

from dataclasses import dataclass, field

import numpy as np

from kernels.plates.layout import PER_NODE, Layout
from kernels.plates.problem import PlateScene, at_rest
from kernels.solve import march
from kernels.solve.history import State
from kernels.solve.problem import Coordinates
from sweep.array_types import Floats, Ints
from sweep.config.case import Case
from sweep.config.kinds.sheet import Surface
from sweep.design.network import Network, mass
from sweep.scene.plates import coordinates
from sweep.scene.plates.contact import contact_of, mirror_of
from sweep.scene.plates.coordinates import Numbering
from sweep.scene.plates.law import law_of_sheet, shear_moduli
from sweep.scene.plates.mesh import build_mesh
from sweep.scene.plates.sheet import mesh_of_sheet, solid_of
from sweep.scene.plates.shell_mesh import ShellMesh
from sweep.scene.scene import driven_by, friction_of, heavy, roles, striker_of

NONE = np.empty(0, np.int64)


@dataclass(frozen=True)
class Scene:
    """A case as arrays, like `scene.scene.Scene`, with plates.

    Forces and energies belong to the walls in ``mesh``, one of `ShellMesh.copies` equal parts.
    """

    mesh: ShellMesh
    network: Network | None
    terms: PlateScene
    x_rest: Floats
    bottom: Ints
    top: Ints
    base: Ints
    force_scale: float
    velocity: Floats
    standing: Ints = field(default_factory=lambda: NONE)
    probes: Ints = field(default_factory=lambda: NONE)
    travel: float = 0.0
    solid_joint_share: float = np.nan

    @property
    def size(self) -> float:
        """Extent of the nodes, m."""
        return float(np.ptp(self.mesh.rest, axis=0).max())

    def largest_force(self, stage: march.Stage) -> float:
        """Force (N) whose round-off enters the residual of a step."""
        quads, modulus = self.mesh.size, 3.0 * self.terms.law.shear_modulus
        slender = (quads / quads[:, ::-1]).max()
        force = modulus * float(self.mesh.thickness.max()) * self.size * slender
        if stage.dynamic:
            force += self.terms.coordinates.mass.max() * self.size / stage.duration**2
        return float(force)

    def at_rest(self) -> State:
        """The state at the start, without velocities."""
        return at_rest(self.terms, self.mesh.frames, self.x_rest)

    def strained(self) -> float:
        """Energy at the start, J: none."""
        return 0.0


def build_scene(case: Case) -> Scene:
    """Build the arrays of ``case``."""
    lattice = case.lattice
    if isinstance(lattice, Surface):
        sheet = mesh_of_sheet(lattice)
        return scene_of(case, sheet, None, case.material.density * solid_of(lattice, sheet))
    mesh, network = build_mesh(lattice), lattice.network
    printed = mass(network, lattice.depth, case.material.density)
    return scene_of(case, mesh, network, printed)


def scene_of(case: Case, mesh: ShellMesh, network: Network | None, whole: float) -> Scene:
    """Build the arrays of a case from its mesh; whole: mass of the lattice, kg."""
    loading, striker = case.loading, striker_of(case.loading)
    numbering, platen = Numbering(mesh.n_nodes), loading.platen
    leader = coordinates.leaders(mesh, platen)
    copies = mesh.copies
    printed = whole / copies
    masses = coordinates.masses(mesh, printed, striker.mass / copies)
    x_rest = coordinates.at_rest(mesh, platen)
    layout = _layout(mesh, numbering, leader, case)
    load = np.zeros(numbering.size)
    load[numbering.high] = -striker.weight / copies
    terms = PlateScene(
        coordinates=_coordinates(mesh, numbering, layout, masses, load),
        law=law_of_sheet(case.material),
        shell=mesh.shells(x_rest, shear_moduli(case.material)),
        contact=contact_of(mesh, numbering, case),
        mirror=mirror_of(mesh, case),
        # The loop for the forces at the end does not converge where folds snap against each other.
        friction=friction_of(case),
        layout=layout,
    )
    loose = platen == "contact"
    low, high = np.array([numbering.low]), np.array([numbering.high])
    bottom = np.flatnonzero(np.isin(mesh.original, mesh.bottom))  # and images, which bear too
    bottom = low if loose else np.append(numbering.position(bottom, 2), low)
    return Scene(
        mesh, network, terms, x_rest, bottom, high, low,
        force_scale=case.material.modulus * mesh.force,
        velocity=np.where(leader == numbering.high, -striker.speed, 0.0),
    )  # fmt: skip


def _coordinates(
    mesh: ShellMesh, numbering: Numbering, layout: Layout, masses: Floats, load: Floats
) -> Coordinates:
    """The data of the coordinates that the solver needs; a rotation w turns by 4 w."""
    scale = np.where(_is_rotation(numbering), 4.0 * mesh.size.mean(), 1.0)
    thickness = float(mesh.thickness.min())
    return Coordinates(
        role=roles(layout),
        scale=scale,
        lever=1.0 / scale,
        mass=masses,
        heavy=heavy(layout, masses),
        load=load,
        driven=layout.driven,
        cap=0.25 * mesh.cell,
        leap=0.01 * thickness,
        close=1e-3 * thickness,
    )


def _is_rotation(numbering: Numbering) -> np.ndarray:
    """Which coordinates are rotations, (6 n + 2,)."""
    place = np.arange(numbering.size) % PER_NODE
    return np.asarray((place >= 3) & (np.arange(numbering.size) < numbering.low))


def _layout(mesh: ShellMesh, numbering: Numbering, leader: Ints, case: Case) -> Layout:
    """Constraints, and the places of the unknowns: node by node, then the upper platen."""
    driven = driven_by(case.loading, numbering)
    own, low = np.arange(leader.size), numbering.low
    free = (leader == own) & (own != driven)
    follows = (leader >= 0) & (leader != own)
    free_of_node, follows_of_node = (each[:low].reshape(-1, PER_NODE) for each in (free, follows))
    count = free_of_node.sum(axis=1)
    slots = [(free_of_node.cumsum(axis=1) - 1).ravel(), np.zeros(leader.size - low, np.int64)]
    image = numbering.of_nodes(mesh.original)  # itself, or its original
    slot = np.where(free, np.concatenate(slots), -1)[image]
    number = np.where(free, np.cumsum(free) - 1, -1)
    unknown = np.where(leader >= 0, number[leader], -1)
    block = np.where(count > 0, np.cumsum(count > 0) - 1, -1)
    platen = int(free[numbering.high])
    top = np.array([[*mesh.rest[:, :2].mean(axis=0), mesh.height]])
    stretching, bending = _stiffness(mesh, case)
    turns = _is_rotation(numbering)[free]
    lengths = mesh.size.mean()
    return Layout(
        leader=leader,
        ratio=np.ones(leader.size),
        driven=driven,
        unknown=unknown,
        slot=slot,
        follows=follows_of_node.any(axis=1)[mesh.original],
        block=block[mesh.original],
        size=np.append(count[count > 0], np.ones(platen, np.int64)),
        point=np.concatenate([mesh.rest[count > 0], top[:platen]]),
        scale=np.where(turns, bending, stretching),
        weight=np.where(turns, (4.0 * lengths) ** 2, 1.0),
        is_length=~turns,
    )


def _stiffness(mesh: ShellMesh, case: Case) -> tuple[float, float]:
    """Stiffness of a node in stretching (N/m) and in bending by w (N m), of the thickest wall."""
    thickness = float(mesh.thickness.max())
    return case.material.modulus * thickness, case.material.modulus * thickness**3 * 4.0 / 3.0
