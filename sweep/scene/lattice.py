"""The arrays of a lattice between platens: supports, platens, loads, and data of all terms."""

import numpy as np

from kernels.terms.contact import Contact
from sweep.array_types import Floats, Ints
from sweep.config.case import Case
from sweep.config.kinds.dead_load import DeadLoad
from sweep.config.kinds.loading import Loading
from sweep.config.kinds.specimen import WallLattice
from sweep.design.lattice import build_network
from sweep.scene.beams import bends
from sweep.scene.bending import build_fold
from sweep.scene.contact import contact_of, projection_of
from sweep.scene.coordinates import BASE, BONDED, NONE, Numbering
from sweep.scene.mesh import Mesh, build_mesh, row_nodes
from sweep.scene.profiles import anchor, gripped, standing, with_profiles
from sweep.scene.scene import (
    Parts,
    Scene,
    assemble,
    force_scale,
    masses_of,
    solved_by,
    striker_of,
    target_of,
    walls_of,
)


def initial_velocity(numbering: Numbering, leader: Ints, loading: Loading) -> Floats:
    """Initial velocity of each coordinate, m/s: the speed of the striker for it and the row glued
    to it.
    """
    return np.where(leader == numbering.high, -striker_of(loading).speed, 0.0)


def load_of(numbering: Numbering, case: Case) -> Floats:
    """Dead load of each coordinate, N: on the upper platen, or in equal parts on the top nodes.

    The weight of a striker is included, the weight of the lattice is not.
    """
    load = np.zeros(numbering.size)
    load[numbering.high] = -striker_of(case.loading).weight
    match case.loading:
        case DeadLoad(platen="none", force=force):
            load[2 * numbering.top + 1] = -force / len(numbering.top)
        case DeadLoad(force=force):
            load[numbering.high] = -force
    return load


def build_scene(case: Case) -> Scene:
    """Build the arrays of ``case``."""
    lattice, platen = case.lattice, gripped(case.loading)
    assert isinstance(lattice, WallLattice)
    network, solid = build_network(lattice.geometry), case.solver.joints == "solid"
    mesh, arms = build_mesh(lattice, solid, platen)
    numbering = Numbering(
        len(mesh.points),
        row_nodes(network, mesh, network.bottom),
        row_nodes(network, mesh, network.top),
    )
    leader = leaders(numbering, case, anchor(mesh, numbering, case))
    walls = walls_of(mesh, numbering.rotation[mesh.edges])
    layout = solved_by(mesh, walls, numbering, leader, case)
    masses = masses_of(case, network, numbering, mesh.node_area)
    touch = contact_of(mesh, numbering, case)
    touch = with_profiles(touch, mesh, network, numbering, case)
    parts = Parts(
        arms=arms,
        walls=walls,
        layout=layout,
        fold=build_fold(mesh, case),
        contact=touch,
        project=projection_of(mesh, numbering, layout, masses, case),
        mass=masses,
        load=load_of(numbering, case),
    )
    return Scene(
        mesh, network, assemble(case, mesh, numbering, parts),
        standing(rest_of(mesh, numbering, parts.contact.node_thickness), touch),
        *reported(numbering, case.loading),
        force_scale=force_scale(case, network),
        velocity=initial_velocity(numbering, layout.leader, case.loading),
        standing=_on_base(mesh, numbering, touch, platen),
        solid_joint_share=float(arms.sheared.mean()),
    )  # fmt: skip


def leaders(numbering: Numbering, case: Case, fixed: Ints) -> Ints:
    """The coordinate that each one follows, (size,): itself, a platen, or -1 if it never moves.

    fixed: coordinates that never move, besides those that platens and a base hold.
    """
    platen, bottom, top = gripped(case.loading), numbering.bottom, numbering.top
    base = numbering.low if target_of(case.loading) is not None else -1
    leader = np.arange(numbering.size)
    leader[numbering.low] = base
    if platen == "none":
        leader[numbering.high] = -1
    if platen != "contact":
        leader[2 * bottom] = leader[numbering.rotation[bottom]] = -1
        leader[2 * bottom + 1] = base
    if platen in BONDED:
        leader[2 * top + 1] = numbering.high
        leader[numbering.rotation[top]] = -1
    if platen == "glued":
        leader[2 * top] = -1
    if not bends(case):
        leader[numbering.rotation] = -1
    leader[fixed] = -1
    return leader


def _on_base(mesh: Mesh, numbering: Numbering, touch: Contact, platen: str) -> Ints:
    """Nodes that may press on a flat base, by x at rest: nodes of a held row, and loose ones."""
    if touch.low_away > 0.0:
        return NONE
    row = NONE if platen == "contact" else numbering.bottom
    nodes = np.union1d(row, touch.platen_nodes)
    return nodes[np.argsort(mesh.points[nodes, 0], kind="stable")]


def rest_of(mesh: Mesh, numbering: Numbering, thickness: Floats) -> Floats:
    """Coordinates at rest, with platens on the outermost walls. thickness (n,): of nodes, m."""
    y, half = mesh.points[:, 1], 0.5 * thickness.round(15)
    platens = [(y - half).min(), (y + half).max()]
    return np.concatenate([mesh.points.ravel(), np.zeros(numbering.n_nodes), platens])


def reported(numbering: Numbering, loading: Loading) -> tuple[Ints, Ints, Ints]:
    """Coordinates of the lower reaction force, and of the top and the base that define the strain.

    The strain is the travel of a driven platen, a striker or the loaded row. Under a loose platen
    with a dead load it is the change of the lattice's own extent, since the platen may lift off
    after the release.
    """
    bottom = 2 * numbering.bottom + 1
    low, high = np.array([numbering.low]), np.array([numbering.high])
    bonded = dict.fromkeys((*BONDED, BASE), np.append(bottom, low))
    reaction = ({"contact": low} | bonded).get(gripped(loading), bottom)
    if not isinstance(loading, DeadLoad) or loading.is_shaped:
        return reaction, high, low
    if loading.platen == "contact":
        return reaction, np.empty(0, np.int64), 2 * np.arange(numbering.n_nodes) + 1
    return reaction, 2 * numbering.top + 1, bottom
