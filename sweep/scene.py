"""The arrays of one case: every term of the energy, the unknowns and how they are driven.

Coordinates: x and y of every node, then the rotations of the joints, then the surfaces of the lower
and the upper platen. A term that the scene lacks is an empty array.
"""

from dataclasses import dataclass

import numpy as np
from scipy.sparse import coo_array
from scipy.sparse.csgraph import reverse_cuthill_mckee

from kernels import bend, contact, damp, fold, friction, law, newton, stretch, vicinity
from kernels.step import Terms
from sweep.lattice import Network, build_network, mass
from sweep.material import stress_law
from sweep.mesh import Floats, Ints, Mesh, openings, split_walls
from sweep.params import Case, Loading, Material

FOLD_LIMIT = np.radians(20.0)
STATIC_SLIP = 1e-3  # of the wall thickness


@dataclass(frozen=True)
class Scene:
    """A case as arrays. x_rest (n_coordinates,) m and rad; bottom, top, base: coordinates (see `Output`)."""

    mesh: Mesh
    network: Network
    terms: Terms
    unknowns: newton.Unknowns
    x_rest: Floats
    bottom: Ints
    top: Ints
    base: Ints
    force_scale: float


@dataclass(frozen=True)
class Layout:
    """Where the coordinates are. rotation (n_joints,): coordinate of each joint's rotation."""

    n_nodes: int
    n_joints: int

    @property
    def rotation(self) -> Ints:
        return 2 * self.n_nodes + np.arange(self.n_joints)

    @property
    def low(self) -> int:
        return 2 * self.n_nodes + self.n_joints

    @property
    def high(self) -> int:
        return self.low + 1

    @property
    def size(self) -> int:
        return self.high + 1


def plane_factors(material: Material) -> tuple[float, float]:
    """Y'/Y in stretching and contact, and in bending."""
    strain = 1.0 / (1.0 - material.poisson**2)
    return {"strain": (strain, strain), "stress": (1.0, 1.0), "strain_bending": (1.0, strain)}[
        material.plane
    ]


def _law(material: Material, factor: float) -> law.Law:
    curve = stress_law(material)
    coefficients = factor * np.ascontiguousarray(curve.coefficients)
    width = np.diff(curve.knots)[:, None] ** np.arange(1, 5)
    gained = np.sum(coefficients * width / np.arange(1, 5), axis=1)
    energy = np.concatenate([[0.0], np.cumsum(gained)])
    raw = law.Law(curve.knots, coefficients, energy, factor * material.modulus)
    return raw._replace(energy=energy - law.uniaxial(raw, 0.0)[0])


def _stretch(mesh: Mesh, depth: float) -> stretch.Stretch:
    return stretch.Stretch(mesh.edges, mesh.rest_length, depth * mesh.thickness)


def _directions(mesh: Mesh, start: Ints, end: Ints) -> Floats:
    arm = mesh.points[end] - mesh.points[start]
    return arm / np.linalg.norm(arm, axis=1)[:, None]


def _hinge_weights(pieces: Ints, hinges: str) -> tuple[Floats, Floats]:
    """Factors of Y I / h inside a wall and at its ends (DESIGN of the exact beam; trapezoid)."""
    n = pieces.astype(float)
    if hinges == "classical":
        return np.ones_like(n), np.full_like(n, 2.0)
    return 1.0 - 1.0 / n**2, 2.0 * (1.0 + 1.0 / n)


def _bend(mesh: Mesh, layout: Layout, rigidity: Floats, case: Case) -> bend.Bend:
    """``rigidity`` (m,): Y' I of every element, N m^2."""
    length = mesh.rest_length
    inside, at_end = _hinge_weights(mesh.pieces, case.solver.hinges)
    before, node, after = mesh.inner.T
    back = _directions(mesh, node, mesh.edges[before, 0])
    on = _directions(mesh, node, mesh.edges[after, 1])
    cosine = np.sum(back * on, axis=1)
    sine = back[:, 0] * on[:, 1] - back[:, 1] * on[:, 0]
    element, joint, other = mesh.ends.T
    single = np.flatnonzero((mesh.pieces == 1) & (case.solver.hinges == "exact_beam"))
    first = np.searchsorted(element, single)
    return bend.Bend(
        measure=bend.TANGENT if case.solver.bend_measure == "tangent" else bend.ANGLE,
        hinges=np.column_stack([mesh.edges[before, 0], node, mesh.edges[after, 1]]),
        hinge_rest=np.column_stack([cosine, sine]),
        hinge_stiffness=(inside * rigidity)[before] / (0.5 * (length[before] + length[after])),
        arms=np.column_stack([joint, other, layout.rotation[joint]]),
        arm_rest=_directions(mesh, joint, other),
        arm_stiffness=(at_end * rigidity / length)[element],
        couplings=np.column_stack([first, first + 1]),
        coupling_stiffness=2.0 * (rigidity / length)[single],
    )


def _fold(mesh: Mesh, bending: bend.Bend) -> fold.Fold:
    """Fold barrier, K of a pair of arms in series and of a hinge its own."""
    nodes, opened, elements = openings(mesh)
    limit = np.minimum(FOLD_LIMIT, 0.5 * opened)
    of_arm = np.zeros((len(mesh.edges), 2))
    at_end = (mesh.edges[mesh.ends[:, 0], 1] == mesh.ends[:, 1]).astype(int)
    of_arm[mesh.ends[:, 0], at_end] = bending.arm_stiffness
    side = (mesh.edges[elements, 1] == nodes[:, 1:2]).astype(int)
    one, two = of_arm[elements[:, 0], side[:, 0]], of_arm[elements[:, 1], side[:, 1]]
    of_node = np.zeros(len(mesh.points))
    of_node[bending.hinges[:, 1]] = bending.hinge_stiffness
    at_joint = nodes[:, 1] < mesh.n_joints
    series = one * two / np.where(at_joint, one + two, 1.0)
    stiffness = np.where(at_joint, series, of_node[nodes[:, 1]])
    return fold.Fold(nodes, limit, stiffness * (0.5 * opened) ** 2)


def _contact(mesh: Mesh, layout: Layout, stiffness: float, case: Case) -> contact.Contact:
    plates = case.loading.platen == "contact"
    none = np.empty(0)
    if case.contact.model == "none":
        edges, tributary, node_thickness, thickness = np.empty((0, 2), np.int64), none, none, none
        special = np.zeros(1, np.int64), np.empty(0, np.int64), none, none, np.empty((0, 2))
        subtract, plate_nodes = np.empty((0, 2)), np.empty(0, np.int64)
    else:
        edges, thickness = mesh.edges, mesh.thickness
        tributary = mesh.tributary(np.ones(len(edges)))
        node_thickness = mesh.tributary(thickness) / tributary
        points = mesh.points.ravel()
        special = vicinity.special_pairs(
            points, edges, mesh.rest_length, node_thickness, thickness, tributary
        )
        subtract = vicinity.owners(layout.n_nodes, edges)
        plate_nodes = np.arange(layout.n_nodes if plates else 0)
    return contact.Contact(
        stiffness, thickness.max(initial=0.0), edges, tributary, node_thickness, thickness,
        subtract, *special, plate_nodes, layout.low, layout.high,
    )  # fmt: skip


def _held(network: Network, layout: Layout, platen: str) -> Ints:
    """Coordinates that never move: clamped rows, and the lower platen."""
    rows = {"none": [network.bottom], "glued": [network.bottom], "contact": []}[platen]
    held = [np.concatenate([2 * r, 2 * r + 1, layout.rotation[r]]) for r in rows]
    if platen == "glued":
        held += [2 * network.top, layout.rotation[network.top]]
    return np.concatenate([*held, [layout.low] + ([layout.high] if platen == "none" else [])])


def _coupled(terms: list[Ints], size: int) -> coo_array:
    """Graph of coordinates that share a term; ``terms``: arrays (k, c) of coordinates."""
    i = np.concatenate([np.repeat(t, t.shape[1], axis=1).ravel() for t in terms])
    j = np.concatenate([np.tile(t, t.shape[1]).ravel() for t in terms])
    return coo_array((np.ones(len(i), dtype=np.int8), (i, j)), shape=(size, size))


def _coordinates(mesh: Mesh, bending: bend.Bend, folds: Ints) -> list[Ints]:
    """Coordinates of each element, hinge, fold, arm and coupling: (k, 4), (k, 6) ... (k, 6)."""

    def of(nodes: Ints) -> Ints:
        return np.stack([2 * nodes, 2 * nodes + 1], axis=-1).reshape(len(nodes), 2 * nodes.shape[1])

    arms = np.column_stack([of(bending.arms[:, :2]), bending.arms[:, 2]])
    pairs = bending.couplings
    ends = np.column_stack([of(bending.arms[pairs[:, 0], :2]), bending.arms[pairs, 2]])
    return [of(mesh.edges), of(bending.hinges), of(folds), arms, ends]


def _rows(layout: Layout, held: Ints, tied: Ints, terms: list[Ints]) -> Ints:
    """Row of each coordinate in an order of small profile; the upper platen's comes last."""
    leader = np.arange(layout.size)
    leader[tied] = layout.high
    free = np.ones(layout.size, dtype=bool)
    free[held] = False
    free[tied] = False
    led = free.copy()
    led[layout.high] = False
    inner = np.flatnonzero(led)
    graph = _coupled(terms, layout.size).tocsr()[inner][:, inner]
    order = inner[reverse_cuthill_mckee(graph, symmetric_mode=True)]
    row = np.full(layout.size, -1)
    row[order] = np.arange(len(order))
    if free[layout.high]:
        row[layout.high] = len(order)
        row[tied] = len(order)
    return row


def _skyline(row: Ints, terms: list[Ints]) -> Ints:
    """First column of each row: the lowest row that shares a term with it."""
    first = np.arange(row.max() + 1)
    for coordinates in terms:
        rows = row[coordinates]
        lowest = np.where(rows < 0, row.size, rows).min(axis=1, initial=row.size)
        for column in rows.T:
            np.minimum.at(first, column[column >= 0], lowest[column >= 0])
    return first


def _masses(mesh: Mesh, layout: Layout, total: float) -> Floats:
    """Lumped mass of each coordinate, kg; what the nodes carry in each direction sums to ``total``."""
    share = mesh.tributary(mesh.thickness)
    masses = np.zeros(layout.size)
    masses[: 2 * layout.n_nodes] = np.repeat(total * share / share.sum(), 2)
    return masses


def _load(network: Network, layout: Layout, case: Case) -> Floats:
    """Total force downwards: on the upper platen, or spread equally over the top nodes."""
    load = np.zeros(layout.size)
    if case.loading.mode == "force":
        if case.loading.platen == "none":
            load[2 * network.top + 1] = -case.loading.force / len(network.top)
        else:
            load[layout.high] = -case.loading.force
    return load


def _friction(case: Case) -> friction.Friction:
    """Slip speed x time step, or a share of the wall thickness where there is no time."""
    if case.contact.model == "none":
        return friction.Friction(0.0, 1.0)
    static = case.solver.integrator == "static"
    slip = STATIC_SLIP * case.lattice.wall_thickness
    if not static:
        slip = case.contact.slip_speed * time_step(case)
    return friction.Friction(case.contact.friction, slip)


def time_step(case: Case) -> float:
    """Duration of one step in s (of its pace, where the integrator is static)."""
    if case.loading.mode == "displacement":
        speed = case.loading.speed or case.lattice.height
        return case.loading.stroke / speed / case.solver.load_steps
    return case.solver.time_step


def _damp(case: Case) -> damp.Damp:
    """Damping of the model that is chosen; none without time."""
    chosen = "none" if case.solver.integrator == "static" else case.damping.model
    if chosen == "rayleigh":
        return damp.Damp(case.damping.mass, case.damping.stiffness, 0.0)
    return damp.Damp(0.0, 0.0, case.damping.relaxation_time if chosen == "kelvin_voigt" else 0.0)


def build_scene(case: Case) -> Scene:
    """Build the arrays of ``case``."""
    lattice, platen = case.lattice, case.loading.platen
    network = build_network(lattice)
    mesh = split_walls(
        network, lattice.nodes_per_wall + 1, lattice.imperfection * lattice.wall_thickness
    )
    layout = Layout(len(mesh.points), mesh.n_joints)
    in_stretch, in_bend = plane_factors(case.material)
    second_moment = lattice.depth * mesh.thickness**3 / 12
    rigidity = in_bend * case.material.modulus * second_moment
    bending = _bend(mesh, layout, rigidity, case)
    touching = in_stretch * case.material.modulus * lattice.depth * (case.contact.stiffness or 0.0)
    held = _held(network, layout, platen)
    tied = 2 * network.top + 1 if platen == "glued" else np.empty(0, np.int64)
    folding = _fold(mesh, bending)
    groups = _coordinates(mesh, bending, folding.nodes)
    row = _rows(layout, held, tied, groups)
    terms = Terms(
        law=_law(case.material, in_stretch),
        stretch=_stretch(mesh, lattice.depth),
        bend=bending,
        fold=folding,
        contact=_contact(mesh, layout, touching, case),
        friction=_friction(case),
        damp=_damp(case),
        mass=_masses(mesh, layout, mass(network, lattice.depth, case.material.density)),
        load=_load(network, layout, case),
        row=row,
        first=_skyline(row, groups),
    )
    return Scene(
        mesh, network, terms, _unknowns(mesh, layout, row, case),
        _rest(mesh, network, layout), *_reported(network, layout, case.loading),
        force_scale=float(np.min(rigidity) / np.max(_wall_length(network)) ** 2),
    )  # fmt: skip


def _wall_length(network: Network) -> Floats:
    ends = network.points[network.walls]
    return np.linalg.norm(ends[:, 1] - ends[:, 0], axis=1)


def _rest(mesh: Mesh, network: Network, layout: Layout) -> Floats:
    """Coordinates at rest; platens touch the outer walls."""
    half = 0.5 * network.wall_thickness.max()
    bottom, top = network.points[:, 1].min() - half, network.points[:, 1].max() + half
    return np.concatenate([mesh.points.ravel(), np.zeros(layout.n_joints), [bottom, top]])


def _reported(network: Network, layout: Layout, loading: Loading) -> tuple[Ints, Ints, Ints]:
    """Coordinates of the lower reaction, of the top and of the base.

    Strain is the travel of a driven platen, or of the loaded row. Under a loose loaded platen it is
    taken from the extent of the lattice itself, which jumps off when it is released.
    """
    bottom = 2 * network.bottom + 1
    low, high = np.array([layout.low]), np.array([layout.high])
    reaction = low if loading.platen == "contact" else bottom
    if loading.mode == "displacement":
        return reaction, high, low
    if loading.platen == "contact":
        return reaction, np.empty(0, np.int64), 2 * np.arange(layout.n_nodes) + 1
    return reaction, 2 * network.top + 1, bottom


def _unknowns(mesh: Mesh, layout: Layout, row: Ints, case: Case) -> newton.Unknowns:
    driven = case.loading.mode == "displacement"
    n_rows = int(row.max()) + 1
    scale = np.ones(n_rows)
    rotation = row[layout.rotation]
    scale[rotation[rotation >= 0]] = mesh.rest_length.mean()
    return newton.Unknowns(
        row=row,
        scale=scale,
        free=n_rows - driven,
        driven=layout.high if driven else -1,
        cap=0.25 * min(case.lattice.width, case.lattice.height) / max(
            case.lattice.cells_x, case.lattice.cells_y
        ),
        leap=0.1 * case.lattice.wall_thickness,
    )
