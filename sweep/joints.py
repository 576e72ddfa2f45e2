"""Bending of a mesh: hinges inside walls, arms at joints, couplings, and the folds between them."""

import numpy as np

from kernels import bend, fold
from sweep.layout import Layout
from sweep.mesh import Floats, Ints, Mesh, openings
from sweep.params import Case

FOLD_LIMIT = np.radians(20.0)


def _directions(mesh: Mesh, start: Ints, end: Ints) -> Floats:
    arm = mesh.points[end] - mesh.points[start]
    return arm / np.linalg.norm(arm, axis=1)[:, None]


def _hinge_weights(pieces: Ints, hinges: str) -> tuple[Floats, Floats]:
    """Factors of Y I / h inside a wall and at its ends (DESIGN of the exact beam; trapezoid)."""
    n = pieces.astype(float)
    if hinges == "classical":
        return np.ones_like(n), np.full_like(n, 2.0)
    return 1.0 - 1.0 / n**2, 2.0 * (1.0 + 1.0 / n)


def build_bend(mesh: Mesh, layout: Layout, rigidity: Floats, case: Case) -> bend.Bend:
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


def build_fold(mesh: Mesh, bending: bend.Bend) -> fold.Fold:
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
