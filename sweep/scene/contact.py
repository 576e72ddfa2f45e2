"""The data of contact: between walls, by force or by position, and of nodes with platens."""

import numpy as np

from kernels.linear.condensed import analysis
from kernels.planar import position_based
from kernels.shared.moves import MOVE_MARGIN
from kernels.terms import contact, contact_near_joints
from sweep.array_types import Floats, Ints
from sweep.config.case import Case
from sweep.scene.beams import plane_factors
from sweep.scene.coordinates import BASE, BONDED, Numbering
from sweep.scene.mesh import Mesh
from sweep.scene.profiles import NO_PROFILES, gripped

PAIRS = 200  # average number per node in the widest list of neighbours at rest


def _most_move(mesh: Mesh, edges: Ints, reach: float) -> float:
    """The longest move in m that a list of neighbours covers, which limits the memory of the list.

    Such a list has `PAIRS` segments about each node, if they are spread evenly in a square whose
    side is half the sum of the width and the height of the structure.
    """
    if edges.shape[0] == 0:
        return np.inf
    area = (0.5 * np.ptp(mesh.points, axis=0).sum()) ** 2
    radius = np.sqrt(PAIRS * area / (np.pi * edges.shape[0]))
    return max(radius - reach, reach) / MOVE_MARGIN


def contact_of(
    mesh: Mesh, numbering: Numbering, case: Case, by_force: bool = True
) -> contact.Contact:
    """Contact of walls, unless the contact model is "none", and of nodes with platens.

    by_force: True for the barrier, of stiffness c Y' depth, False for contact by position. The kind
    that the case does not use is returned without pairs and nodes.
    """
    material, (in_stretch, _) = case.material, plane_factors(case.material)
    stiffness = in_stretch * material.modulus * case.lattice.depth * case.contact.stiffness
    acts = by_force == (case.contact.model != "position_based")
    tributary, node_thickness = mesh.node_length, mesh.node_area / mesh.node_length
    walls = acts and case.contact.model != "none"
    edges, thickness = mesh.edges[: None if walls else 0], mesh.thickness[: None if walls else 0]
    reach = thickness.max(initial=0.0)
    special = contact_near_joints.special_pairs(
        mesh.points.ravel(), edges, mesh.rest_length, node_thickness, thickness, tributary
    )
    return contact.Contact(
        stiffness=stiffness if by_force else 0.0,
        reach=reach,
        most_move=_most_move(mesh, edges, reach),
        edges=edges,
        tributary=tributary,
        node_thickness=node_thickness,
        edge_thickness=thickness,
        subtract=contact_near_joints.owners(numbering.n_nodes, edges),
        special_start=special.start,
        special_node=special.node,
        special_weight=special.weight,
        special_distance=np.where(by_force | (special.weight > 0.0), special.distance, 0.0),
        special_subtract=special.subtract,
        platen_nodes=_loose(numbering, case) if acts else np.empty(0, np.int64),
        low=numbering.low,
        high=numbering.high,
        profiles=NO_PROFILES,
        low_away=0.0,
        high_away=0.0,
    )


def _loose(numbering: Numbering, case: Case) -> Ints:
    """Nodes that can touch a platen.

    These are all nodes for loose platens. For bonded ones they are the nodes outside the bonded
    rows, if the case has contact of walls.
    """
    bonded = gripped(case.loading) in (*BONDED, BASE)
    loose = np.full(numbering.n_nodes, bonded and case.contact.model != "none")
    loose[numbering.bottom] = False
    loose[numbering.top] &= gripped(case.loading) == BASE
    return np.flatnonzero(loose | (case.loading.platen == "contact"))


def projection_of(
    mesh: Mesh, numbering: Numbering, layout: analysis.Layout, masses: Floats, case: Case
) -> position_based.Projection:
    """Contact by position: free coordinates with mass move apart in proportion to 1 / mass."""
    own = (layout.leader == np.arange(numbering.size)) & (masses > 0.0)
    ease = np.divide(1.0, masses, out=np.zeros_like(masses), where=own)
    return position_based.Projection(contact_of(mesh, numbering, case, by_force=False), ease)
