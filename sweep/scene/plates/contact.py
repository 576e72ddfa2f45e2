"""The data of contact between plates, and between plates and platens."""

import numpy as np

from kernels.plates.contact import Contact
from sweep.config.case import Case
from sweep.scene.plates.coordinates import Numbering
from sweep.scene.plates.mesh import PlateMesh


def contact_of(mesh: PlateMesh, numbering: Numbering, case: Case) -> Contact:
    return Contact(
        1e-4,
        1e-2,
        mesh.triangles[:0],
        mesh.edges[:0],
        mesh.area,
        np.empty(0, np.int64),
        numbering.low,
        numbering.high,
    )
