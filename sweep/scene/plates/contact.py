"""The data of contact between plates, and between plates and platens."""

import numpy as np

from kernels.geometry.space import surface
from kernels.plates.contact import Contact
from sweep.config.case import Case, given
from sweep.scene.plates.coordinates import BONDED, Numbering, heights
from sweep.scene.plates.mesh import PlateMesh

MOST_MOVE = 1.0  # longest move that neighbour lists cover, in mean widths of walls


def contact_of(mesh: PlateMesh, numbering: Numbering, case: Case) -> Contact:
    """Contact of all walls over their thickness, and of nodes that no platen holds with platens."""
    platen = given(case.loading.platen)
    low, high = heights(mesh, platen)
    thickness = mesh.node_thickness
    edges, sides = surface.edges_of(mesh.triangles, mesh.n_nodes)
    height, every = mesh.rest[:, 2], np.arange(mesh.n_nodes)
    loose_low = np.setdiff1d(every, mesh.bottom) if platen in BONDED else every
    loose_high = np.setdiff1d(every, mesh.top) if platen in BONDED else every
    return Contact(
        stiffness=case.material.modulus * 4.0 / 3.0 * (case.contact.stiffness or 0.0),
        reach=float(thickness.max()),
        most_move=MOST_MOVE * float(mesh.plan.span.mean()),
        triangles=mesh.triangles,
        sides=sides,
        edges=edges,
        widths=surface.widths(mesh.rest, mesh.triangles, edges, sides),
        area=mesh.area,
        thickness=thickness.copy(),
        rest_thickness=thickness,
        rest=mesh.rest,
        low_nodes=loose_low,
        low_rest=height[loose_low] - low,
        high_nodes=loose_high,
        high_rest=high - height[loose_high],
        low=numbering.low,
        high=numbering.high,
    )
