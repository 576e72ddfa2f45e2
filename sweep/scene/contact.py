"""What of a case may touch: walls by force or by position, and nodes with platens."""

import numpy as np

from kernels.terms import contact, position_based as project, contact_near_joints as vicinity
from kernels.linear import analysis as pattern
from sweep.scene.coordinates import BONDED, Layout
from sweep.scene.mesh import Floats, Ints, Mesh
from sweep.config.case import Case


def _no_special_pairs() -> tuple[Ints, Ints, Floats, Floats, Floats]:
    """What `vicinity.special_pairs` returns where walls never touch."""
    start, node = np.zeros(1, np.int64), np.empty(0, np.int64)
    return start, node, np.empty(0), np.empty(0), np.empty((0, 2))


def contact_of(
    mesh: Mesh, layout: Layout, stiffness: float, case: Case, by_force: bool
) -> contact.Contact:
    """Contact of walls unless the model is none, and of nodes with loose platens.

    Of the two kinds, ``by_force`` and by position, the one that the case has not is absent.
    """
    acts = by_force == (case.contact.model != "position_based")
    tributary, node_thickness = mesh.node_length, mesh.node_area / mesh.node_length
    walls = acts and case.contact.model != "none"
    edges, thickness = mesh.edges[: None if walls else 0], mesh.thickness[: None if walls else 0]
    special = _no_special_pairs()
    if walls:
        special = vicinity.special_pairs(
            mesh.points.ravel(), edges, mesh.rest_length, node_thickness, thickness, tributary
        )
    return contact.Contact(
        stiffness=stiffness,
        reach=thickness.max(initial=0.0),
        edges=edges,
        tributary=tributary,
        node_thickness=node_thickness,
        edge_thickness=thickness,
        subtract=vicinity.owners(layout.n_nodes, edges),
        special_start=special[0],
        special_node=special[1],
        special_weight=special[2],
        special_distance=special[3],
        special_subtract=special[4],
        plate_nodes=_loose(layout, case) if acts else np.empty(0, np.int64),
        low=layout.low,
        high=layout.high,
    )


def _loose(layout: Layout, case: Case) -> Ints:
    """Nodes that a platen can meet: all of them; those that are not glued to it, if walls touch."""
    bonded = case.loading.platen in BONDED
    loose = np.full(layout.n_nodes, bonded and case.contact.model != "none")
    loose[layout.bottom] = loose[layout.top] = False
    return np.flatnonzero(loose | (case.loading.platen == "contact"))


def projection_of(
    mesh: Mesh, layout: Layout, solved: pattern.Layout, masses: Floats, case: Case
) -> project.Projection:
    """Contact by position: what moves on its own gives way, by its mass."""
    own = (solved.leader == np.arange(layout.size)) & (masses > 0.0)
    ease = np.divide(1.0, masses, out=np.zeros_like(masses), where=own)
    return project.Projection(contact_of(mesh, layout, 0.0, case, by_force=False), ease)
