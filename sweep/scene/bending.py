"""The data of bending: stiffness and sections of the elements; and of the fold barrier."""

import numpy as np

from kernels.terms import bend, fold
from sweep.config.case import Case
from sweep.scene.material import law_in_bending
from sweep.scene.mesh import Floats, Mesh

ARC = (1.0 / 15.0, -1.0 / 30.0)  # of a cubic, see `kernels.terms.stretch`
GAUSS = np.sqrt(3.0)
SECTIONS = {  # points of a section: b of `kernels.terms.bend`, both of weight 1/2
    "cubic": np.array([[1.0 + GAUSS, GAUSS - 1.0], [1.0 - GAUSS, -1.0 - GAUSS]]),
    "classical": np.array([[2.0, 0.0], [0.0, 2.0]]),
}


def bends(case: Case) -> bool:
    """False if walls have no bending stiffness: chains of axial springs with free hinges."""
    return case.material.bend != "none"


def arc_of(mesh: Mesh, case: Case) -> Floats:
    """The data of the arc of every element, (2, m): zero where the strain is that of the chord."""
    cubic = bends(case) and case.solver.element == "cubic"
    return np.tile(np.array(ARC)[:, None] * cubic, len(mesh.edges))


def build_bend(mesh: Mesh, rigidity: Floats, case: Case) -> bend.Bend:
    """The data of bending. ``rigidity`` (m,): Y' I of every element, N m^2."""
    length, material, element = mesh.rest_length, case.material, case.solver.element
    per_length = rigidity * bends(case) / length
    factors = {"cubic": (4.0, 2.0, 4.0), "classical": (2.0, 0.0, 2.0)}[element]
    surface = 0.5 * mesh.thickness / length
    through = slice(None if material.bend == "section" else 0)
    return bend.Bend(
        measure=bend.TANGENT if case.solver.bend_measure == "tangent" else bend.ANGLE,
        stiffness=np.outer(factors, per_length),
        side=np.where(mesh.edges < mesh.n_joints, 2.0, 1.0).T.copy(),
        section=law_in_bending(material),
        points=SECTIONS[element],
        surface=surface[through],
        weight=np.tile((0.5 * per_length / surface**2)[through], (2, 1)),
    )


def build_fold(mesh: Mesh, rigidity: Floats, case: Case) -> fold.Fold:
    """Fold barrier between neighbouring elements of every node; K: halves of both in series."""
    nodes, opened, ends = (a[: None if bends(case) else 0] for a in mesh.openings)
    limit = np.minimum(fold.LIMIT, 0.5 * opened)
    one, two = (2.0 * rigidity / mesh.rest_length)[ends].T
    return fold.Fold(nodes, limit, one * two / (one + two) * (0.5 * opened) ** 2)
