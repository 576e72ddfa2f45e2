"""The data of contact between plates, and between plates and platens."""

import numpy as np

from kernels.plates.contacts import contact
from kernels.plates.contacts.mirror import NO_MIRROR, Mirror
from kernels.plates.layout import PER_NODE
from sweep.config.case import Case
from sweep.scene.plates.coordinates import BONDED, Numbering, heights
from sweep.scene.plates.shell_mesh import ShellMesh

MOST_MOVE = 1.0  # longest move that neighbour lists cover, in typical widths of walls


def mirror_of(mesh: ShellMesh, case: Case) -> Mirror:
    """Contact of walls with their images beyond mirror planes, unless the model is "none"."""
    if mesh.copies == 1 or case.contact.model == "none":
        return NO_MIRROR
    nodes = [np.flatnonzero(~mesh.on[:, axis]) for axis in (0, 1)]
    places = [mesh.planes[axis] - mesh.rest[nodes[axis], axis] for axis in (0, 1)]
    return Mirror(
        coordinate=np.concatenate([PER_NODE * nodes[axis] + axis for axis in (0, 1)]),
        node=np.concatenate(nodes),
        place=np.repeat(mesh.planes, [len(each) for each in nodes]),
        rest=np.concatenate(places),
    )


def contact_of(mesh: ShellMesh, numbering: Numbering, case: Case) -> contact.Contact:
    """Contact of all walls over their thickness, and of nodes that no platen holds with platens.

    With the contact model "none", only loose platens touch nodes.
    """
    platen, walls = case.loading.platen, case.contact.model != "none"
    low, high = heights(mesh, platen)
    triangles = mesh.triangles[: None if walls else 0]
    height, every = mesh.rest[:, 2], mesh.own if walls or platen == "contact" else mesh.own[:0]
    loose_low = np.setdiff1d(every, mesh.bottom) if platen in BONDED else every
    loose_high = np.setdiff1d(every, mesh.top) if platen in BONDED else every
    return contact.build(
        case.material.modulus * 4.0 / 3.0 * case.contact.stiffness,
        MOST_MOVE * mesh.cell,
        triangles, mesh.area, mesh.node_thickness, mesh.rest,
        (loose_low, height[loose_low] - low, numbering.low),
        (loose_high, high - height[loose_high], numbering.high),
        mesh.original,
    )  # fmt: skip
