"""The data of bending: hinges inside walls, arms at joints, couplings; and of the fold barrier."""

import numpy as np

from kernels.terms import bend, fold
from sweep.config.case import Case
from sweep.scene.material import law_in_bending
from sweep.scene.mesh import Floats, Ints, Mesh


def _directions(mesh: Mesh) -> Floats:
    along = mesh.points[mesh.edges[:, 1]] - mesh.points[mesh.edges[:, 0]]
    return along / mesh.rest_length[:, None]


def _hinge_weights(pieces: Ints, hinges: str) -> tuple[Floats, Floats]:
    """Factors of Y I / h of the hinges inside a wall and at its ends, (m,) each.

    "exact_beam": 1 - 1/n^2 and 2 (1 + 1/n) for n elements in the wall; "classical": 1 and 2.
    """
    n = pieces.astype(float)
    if hinges == "classical":
        return np.ones_like(n), np.full_like(n, 2.0)
    return 1.0 - 1.0 / n**2, 2.0 * (1.0 + 1.0 / n)


def bends(case: Case) -> bool:
    """False if walls have no bending stiffness: chains of axial springs with free hinges."""
    return case.material.bend != "none"


def build_bend(mesh: Mesh, rigidity: Floats, case: Case) -> bend.Bend:
    """The data of bending. ``rigidity`` (m,): Y' I of every element, N m^2."""
    length, material = mesh.rest_length, case.material
    rigidity = rigidity * bends(case)
    inside, at_end = _hinge_weights(mesh.pieces, case.solver.hinges)
    before, _, after = np.ascontiguousarray(mesh.inner[: None if bends(case) else 0].T)
    on = _directions(mesh)
    cosine = np.sum(on[before] * on[after], axis=1)
    sine = on[before, 0] * on[after, 1] - on[before, 1] * on[after, 0]
    end = mesh.arm_element
    between = 0.5 * (length[before] + length[after])
    through = slice(None if material.bend == "section" else 0)
    single = (mesh.pieces[end[::2]] == 1) & (case.solver.hinges == "exact_beam")
    return bend.Bend(
        measure=bend.TANGENT if case.solver.bend_measure == "tangent" else bend.ANGLE,
        hinges=before,
        hinge_angle=np.arctan2(sine, cosine),
        hinge_stiffness=(inside * rigidity)[before] / between,
        arm_rest=on[end],
        arm_stiffness=(at_end * rigidity / length)[end],
        coupling=np.where(single, 2.0 * (rigidity / length)[end[::2]], 0.0),
        section=law_in_bending(material),
        hinge_surface=(0.5 * mesh.thickness[before] / between)[through],
        arm_surface=(mesh.thickness / length)[end][through],
    )


def build_fold(mesh: Mesh, bending: bend.Bend, case: Case) -> fold.Fold:
    """Fold barrier between neighbouring arms of every joint; K: both arms in series."""
    nodes, opened, arms = (a[: None if bends(case) else 0] for a in mesh.openings)
    limit = np.minimum(bend.FOLD_LIMIT, 0.5 * opened)
    one, two = bending.arm_stiffness[arms].T
    return fold.Fold(nodes, limit, one * two / (one + two) * (0.5 * opened) ** 2)
