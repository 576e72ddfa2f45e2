"""The constants of the elements: areas, arcs, stiffness against bending and shear.

With shear, of stiffness S = 5/6 G A in a section, an element is Timoshenko's beam: with
P = 12 Y' I / (S l0^2) and p = P / (2 (1 + P)),

    k_11 = k_22 = (4 + P) Y' I / (l0 (1 + P)),   k_12 = (2 - P) Y' I / (l0 (1 + P)),

and the slopes of its axis against the chord, which make the arc longer, are b_i = a_i - p (a_1 +
a_2). The axial force does no work on shear (Haringx): the strain is measured along the normal of
the section, which is turned from the axis by g = p (a_1 + a_2),

    e = l / l0 - 1 + (2 b_1^2 - b_1 b_2 + 2 b_2^2) / 30 - g^2 / 2.

A wall whose layers have unequal thicknesses (`Network.gyration`, i) has the mean area, of a
thickness t, the mean second moment I = i^2 t^3 / 12, and fibres i times as far from its centre
line; its joints are stiffer in bending by i^2.

A solid joint is an element with a stiffness of its own (`joints`); along its chord it yields like a
wall of another area.
"""

from typing import NamedTuple

import numpy as np

from sweep.array_types import Floats
from sweep.config.case import Case
from sweep.config.kinds.material import Material
from sweep.scene.joints import Arms, joint_elements
from sweep.scene.mesh import Mesh

SHEAR_COEFFICIENT = 5.0 / 6.0


class Beams(NamedTuple):
    """Constants of the elements, as in `kernels.terms.stretch` and `kernels.terms.bend`.

    area (m,) m^2. arc (2, m). rigidity (m,): Y' I, N m^2. stiffness (3, m): N m. shear (m,): P.
    joint (m,): True for solid joints.
    """

    area: Floats
    arc: Floats
    rigidity: Floats
    stiffness: Floats
    shear: Floats
    joint: np.ndarray


def bends(case: Case) -> bool:
    """Whether walls have bending stiffness; without it they are chains of axial springs with free
    hinges.
    """
    return case.material.bend != "none"


def plane_factors(material: Material) -> tuple[float, float]:
    """Y'/Y in stretching and contact, and in bending."""
    strain = 1.0 / (1.0 - material.poisson**2)
    return {"strain": (strain, strain), "stress": (1.0, 1.0), "strain_bending": (1.0, strain)}[
        material.plane
    ]


def contraction(material: Material) -> float:
    """The contraction nu' of bending: contraction across a fibre over its strain."""
    nu = material.poisson
    return nu if material.plane == "stress" else nu / (1.0 - nu)


def rigidity_of(case: Case, thickness: Floats, gyration: Floats | None) -> Floats:
    """Y' I of walls, (k,) N m^2. thickness (k,) m; gyration (k,): as in `Network`."""
    modulus = plane_factors(case.material)[1] * case.material.modulus
    rigidity = modulus * case.lattice.depth * thickness**3 / 12.0
    return rigidity if gyration is None else rigidity * gyration**2


def build_beams(mesh: Mesh, arms: Arms, case: Case) -> Beams:
    """The constants of the elements of a ``mesh`` whose walls end in ``arms``."""
    material, depth, t, l0 = case.material, case.lattice.depth, mesh.thickness, mesh.rest_length
    modulus = plane_factors(material)[1] * material.modulus
    area, rigidity = depth * t, rigidity_of(case, t, mesh.gyration)
    rigid_in_shear = SHEAR_COEFFICIENT * material.modulus / (2.0 * (1.0 + material.poisson)) * area
    shear = np.where(arms.sheared[mesh.wall], 12.0 * rigidity / (rigid_in_shear * l0**2), 0.0)
    if case.solver.element == "classical":
        arc, factors = np.zeros((2, len(t))), np.multiply.outer([2.0, 0.0, 2.0], np.ones(len(t)))
    else:
        arc, factors = (
            _arc(shear),
            np.stack([4.0 + shear, 2.0 - shear, 4.0 + shear]) / (1.0 + shear),
        )
    stiffness = factors * rigidity / l0
    joint = mesh.joint >= 0
    ends = mesh.joint[joint]
    compliance = arms.compliance.reshape(-1, 4, 3)[ends]
    along, across = joint_elements(ends % 2, (l0 / t)[joint], compliance, contraction(material))
    area[joint] = depth * l0[joint] * along
    stiffness[:, joint] = modulus * depth * t[joint] ** 2 * across
    if mesh.gyration is not None:
        stiffness[:, joint] *= mesh.gyration[joint] ** 2
    arc[:, joint] = 0.0
    if not bends(case):
        arc, stiffness = np.zeros_like(arc), np.zeros_like(stiffness)
    return Beams(area, arc, rigidity, stiffness, shear, joint)


def _arc(shear: Floats) -> Floats:
    """c_s and c_m of the arc, (2, m)."""
    p = 0.5 * shear / (1.0 + shear)
    less = 0.1 * p * (1.0 + 4.0 * p)
    return np.stack([1.0 / 15.0 - less, -1.0 / 30.0 - 2.0 * less])
