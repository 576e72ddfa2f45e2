"""The data of bending: stiffness and sections of the elements; and of the fold barrier."""

import numpy as np

from kernels.terms import bend, fold
from sweep.array_types import Floats
from sweep.config.case import Case
from sweep.scene.beams import Beams, bends, contraction, plane_factors, rigidity_of
from sweep.scene.material import FIBRE, OUTER, law_of_hinge, law_of_section
from sweep.scene.mesh import Mesh

ALONG = {"cubic": np.sqrt(3.0), "classical": 1.0}  # s_1 over s_0, without shear


def build_bend(mesh: Mesh, beams: Beams, case: Case) -> bend.Bend:
    """The data of bending.

    Walls that do not bend turn freely: the measure "tangent" would stop them at its pole.
    """
    material = case.material
    limited = bends(case) and case.solver.bend_measure == "tangent"
    through = slice(None if material.through_fibres else 0)
    spread, volume, shear = (part[..., through] for part in _sections(mesh, beams, case))
    return bend.Bend(
        measure=bend.TANGENT if limited else bend.ANGLE,
        stiffness=beams.stiffness,
        side=np.where(mesh.edges < mesh.n_joints, 2.0, 1.0).T.copy(),
        section=law_of_section(material, plane_factors(material)[1], contraction(material)),
        hinge=law_of_hinge(material),
        spread=np.ascontiguousarray(spread),
        volume=volume,
        shear=shear,
    )


def _sections(mesh: Mesh, beams: Beams, case: Case) -> tuple[Floats, Floats, Floats]:
    """``spread`` (2, m), ``volume`` (m,) and ``shear`` (m,) of `kernels.terms.bend.Bend`.

    The moments of Timoshenko's element are the moments of its curvature less their part in shear:
    k_s = 3 P / (1 + P)^2 Y' I / l0. Solid joints bend linearly, and so do the stubs between them.
    """
    l0, by = mesh.rest_length, 1.0 / (1.0 + beams.shear)
    across = FIBRE * mesh.thickness / l0 * (1.0 if mesh.gyration is None else mesh.gyration)
    along = ALONG[case.solver.element] * across * by
    linear = beams.joint | mesh.stubs
    volume = np.where(linear, 0.0, 0.5 * OUTER * case.lattice.depth * mesh.thickness * l0)
    shear = 3.0 * beams.shear * by**2 * beams.rigidity / l0
    return np.stack([across, along]), volume, shear


def build_fold(mesh: Mesh, case: Case) -> fold.Fold:
    """Fold barrier between neighbouring elements of every node; K: half elements in series."""
    nodes, opened, ends = (a[: None if bends(case) else 0] for a in mesh.openings)
    limit = np.minimum(fold.LIMIT, 0.5 * opened)
    rigidity = rigidity_of(case, mesh.thickness, mesh.gyration)
    one, two = (2.0 * rigidity / mesh.rest_length)[ends].T
    return fold.Fold(nodes, limit, one * two / (one + two) * (0.5 * opened) ** 2)
