"""Solid joints: compliance of the ends of walls beyond beams that meet at a point.

The complementary energy of a solid joint of arms of thickness t is the energy of Timoshenko beams
that reach its centre, plus r . C r / (2 Y' depth) for each arm, with r = (N, V, M / t) at the
centre: along the arm, to its left, turning left (tests/studies/continuum/arms.py finds C from
solids). An arm therefore ends in one short element, from the centre to x t, whose flexibility in r
is the sum of C and the flexibility of a beam:

    F = C + [[x, 0, 0], [0, 2.4 (1 + nu') x + 4 x^3, -6 x^2], [0, -6 x^2, 12 x]]

For arms of unequal thickness see `joint_kinds.unequal`. In short walls the sum of both C and the
beam holds until the joints meet (tests/studies/continuum/pixels.py). Joints that would take more
than `MOST` of a wall are replaced by the joints of a wall so much thinner that they just fit: x t,
MM and NN are multiplied by the ratio of the thicknesses, MV by its square and VV by its cube. This
is no result of elasticity, but F stays positive definite, and nothing jumps.

nu' is nu in plane stress and nu / (1 - nu) in plane strain. Between its joints the wall is a beam
with shear. Shear and C belong together, as C is an excess over beams with shear: a wall with an end
whose C is not known has neither, and its joints are points.
"""

from collections.abc import Iterable, Iterator
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from sweep.array_types import Floats, Ints
from sweep.design.network import Network
from sweep.scene.coordinates import BONDED
from sweep.scene.joint_kinds import find_joint, flexibility, unequal

STRAIGHT = 15.0  # degrees: two arms that meet at a smaller angle are one bent wall
MOST = 0.95  # largest share of the length of a wall that its joints can take
POWERS = np.array([1.0, 2.0, 3.0, 1.0])  # powers of a thickness in MM, MV, VV, NN of C


class Arms(NamedTuple):
    """Ends of walls at solid joints.

    length (w, 2): x t of both ends in m; 0: a point. compliance (w, 2, 4, 3): coefficients of
    1, nu', nu'^2 in MM, MV, VV, NN of C. sheared (w,): True for walls of known joints.
    """

    length: Floats
    compliance: Floats
    sheared: NDArray[np.bool_]


def point_joints(walls: int) -> Arms:
    """Joints that are points, and walls without shear."""
    return Arms(np.zeros((walls, 2)), np.zeros((walls, 2, 4, 3)), np.zeros(walls, np.bool_))


def solid_joints(network: Network, platen: str | None) -> Arms:
    """The ends of the walls of a lattice.

    Loose platens hold no row, and other platens both rows; without a platen, or on a base alone,
    the lower row is held. Walls meet the perimeters of a slicer as beams.
    """
    rows = [] if platen == "contact" else [network.bottom]
    if platen in BONDED:
        rows.append(network.top)
    return find_arms(network, network.walls, rows, network.perimeter)


def find_arms(network: Network, joints: Ints, rows: Iterable[Ints], plain: Ints) -> Arms:
    """The ends of the first walls of a network, with the number of the joint of each end.

    joints (w, 2). rows: joints of each row that is glued to a platen; a wall with both ends in the
    same row is part of it. plain: joints that walls reach as beams.
    """
    count = len(joints)
    start, end = network.points[network.walls[:count]].swapaxes(0, 1)
    thickness = network.wall_thickness[:count]
    bearing = np.degrees(np.arctan2(*(end - start).T[::-1]))
    bearings = np.column_stack([bearing, bearing + 180.0]) % 360.0
    in_row = np.zeros(count, np.bool_)
    for row in rows:
        in_row |= np.isin(joints, row).all(axis=1)
    arms = point_joints(count)
    length_of, compliance_of = arms.length.reshape(-1), arms.compliance.reshape(-1, 4, 3)
    has_joint = np.zeros(2 * count, np.bool_)
    for ends in _by_joint(joints.ravel(), bearings.ravel()):
        t = thickness[ends // 2]
        bearing = bearings.ravel()[ends]
        opened = np.diff(bearing, append=bearing[0] + 360.0)
        straight = len(ends) == 2 and abs(opened[0] - 180.0) < STRAIGHT
        if len(ends) == 1 or straight or joints.ravel()[ends[0]] in plain:
            has_joint[ends] = True
            continue
        joint = find_joint(opened, in_row[ends // 2])
        if joint is None:
            continue
        joint = unequal(joint, opened, t)
        has_joint[ends] = True
        standing = ~in_row[ends // 2]
        compliance_of[ends[standing]] = joint.compliance[standing]
        length_of[ends[standing]] = (joint.length * t)[standing]
    arms.sheared[:] = has_joint.reshape(-1, 2).all(axis=1)
    arms.length[~arms.sheared] = 0.0
    _fit(arms, network.length[:count])
    return arms


def _fit(arms: Arms, length: Floats) -> None:
    """Shrink joints that would take more than `MOST` of the length (w,) of their wall, in place."""
    share = np.maximum(1.0, arms.length.sum(axis=1) / (MOST * length))[:, None]
    arms.length[:] /= share
    arms.compliance[:] /= (share**POWERS)[:, None, :, None]


def _by_joint(joint: Ints, bearing: Floats) -> Iterator[Ints]:
    """Ends of walls at each joint, in the order of their bearings."""
    order = np.lexsort([bearing, joint])
    changes = np.flatnonzero(np.diff(joint[order])) + 1
    yield from np.split(order, changes)


def joint_elements(side: Ints, x: Floats, compliance: Floats, nu: float) -> tuple[Floats, Floats]:
    """The elements of solid joints: x (j,) and C (j, 4, 3). side (j,): the end 0 or 1 at the joint.

    Returns the stiffness along the chord, over Y' depth (j,), and k_11, k_12, k_22 of
    `kernels.terms.bend` over Y' depth t^2, (3, j).
    """
    balance = np.empty((len(side), 2, 2))
    balance[:, 0] = -1.0 / x[:, None]  # V and M / t under M_1 / t, M_2 / t
    balance[:, 1] = -1.0, 0.0
    k = np.linalg.inv(balance.swapaxes(1, 2) @ flexibility(compliance, x, nu) @ balance)
    k[side == 1] = k[side == 1, ::-1, ::-1]
    along = compliance[:, 3] @ nu ** np.arange(3) + x
    return 1.0 / along, np.stack([k[:, 0, 0], k[:, 0, 1], k[:, 1, 1]])
