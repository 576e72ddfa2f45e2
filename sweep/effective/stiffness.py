"""Effective stiffness of a periodic frame: the energy of a mean strain, its nodes at rest.

With u = U + e X at a node that is moved by X (whole periods) from a node of the period, the energy
per volume of a mean strain e is minimised over the displacements and rotations U of the period:

    C = (K_ee - K_eu K_uu^-1 K_ue) / (area x depth).

Out of the plane each wall is sheared along its length, like a resistor with the conductance G t / l
for each element, w = W + g . X for the mean shears g of planes x and y against the depth.
"""

import numpy as np
from scipy.linalg import cho_factor, cho_solve

from sweep.array_types import Floats
from sweep.config.faults import MisfitError
from sweep.effective.cell import Frame

SLACK = "walls without stiffness against some strain, a mechanism; needed: joints that hold it"


def element_stiffness(frame: Frame) -> Floats:
    """Stiffness of each element in x, y and rotation of both ends, (m, 6, 6)."""
    b = deformations(frame)
    d = np.zeros((len(b), 3, 3))
    d[:, 0, 0] = frame.axial
    d[:, 1, 1], d[:, 1, 2], d[:, 2, 2] = frame.bending
    d[:, 2, 1] = d[:, 1, 2]
    return np.einsum("mai,mab,mbj->mij", b, d, b)


def deformations(frame: Frame) -> Floats:
    """Derivatives (m, 3, 6) of change of length and turns of both ends by the coordinates of an
    element.
    """
    t, n = frame.along, np.stack([-frame.along[:, 1], frame.along[:, 0]], axis=1)
    b = np.zeros((len(t), 3, 6))
    b[:, 0, 0:2], b[:, 0, 3:5] = -t, t
    for end in (1, 2):
        b[:, end, 0:2], b[:, end, 3:5] = -n / frame.length[:, None], n / frame.length[:, None]
        b[:, end, 3 * end - 1] = -1.0
    return b


def coordinates(frame: Frame) -> np.ndarray:
    """The coordinates of each element, (m, 6), with 3 for each node of the period."""
    return (3 * frame.ends[:, :, None] + np.arange(3)).reshape(-1, 6)


def carried(frame: Frame) -> Floats:
    """Coordinates of both ends of an element due to mean strains xx, yy, xy, (m, 6, 3)."""
    x, y = np.moveaxis(frame.shift * frame.period, -1, 0)
    moved = np.zeros((len(x), 2, 3, 3))
    moved[:, :, 0, 0], moved[:, :, 1, 1] = x, y
    moved[:, :, 0, 2], moved[:, :, 1, 2] = 0.5 * y, 0.5 * x
    return moved.reshape(-1, 6, 3)


def response(frame: Frame) -> tuple[Floats, Floats]:
    """Effective stiffness (3, 3) x depth, N/m, and the coordinates (n, 3) under unit mean
    strains.
    """
    own, at, carry = element_stiffness(frame), coordinates(frame), carried(frame)
    size = 3 * frame.nodes
    inner, mixed = np.zeros((size, size)), np.zeros((size, 3))
    np.add.at(inner, (at[:, :, None], at[:, None, :]), own)
    np.add.at(mixed, at, own @ carry)
    free = np.arange(2, size)  # the first node holds the frame
    moved = np.zeros((size, 3))
    moved[free] = -_solved(inner[np.ix_(free, free)], mixed[free])
    mean = np.einsum("mia,mij,mjb->ab", carry, own, carry)
    return (mean + mixed.T @ moved) / frame.area, moved


def sheared(frame: Frame, rigidity: float) -> Floats:
    """Effective stiffness (2, 2) against shears xz and yz, Pa; rigidity: G of the walls, Pa."""
    one, other = frame.ends.T
    own = rigidity * frame.thickness / frame.length
    jump = (frame.shift[:, 1] - frame.shift[:, 0]) * frame.period
    size = frame.nodes
    inner, mixed = np.zeros((size, size)), np.zeros((size, 2))
    for i, j, sign in (
        (one, one, 1.0),
        (other, other, 1.0),
        (one, other, -1.0),
        (other, one, -1.0),
    ):
        np.add.at(inner, (i, j), sign * own)
    np.add.at(mixed, other, own[:, None] * jump)
    np.add.at(mixed, one, -own[:, None] * jump)
    moved = np.zeros((size, 2))
    moved[1:] = -_solved(inner[1:, 1:], mixed[1:])
    return np.asarray((jump.T @ (own[:, None] * jump) + mixed.T @ moved) / frame.area)


def _solved(matrix: Floats, sides: Floats) -> Floats:
    """Solution of a system, which is scaled to a unit diagonal; refused if it is singular."""
    diagonal = np.diag(matrix)
    scale = 1.0 / np.sqrt(np.where(diagonal > 0.0, diagonal, 1.0))
    try:
        factor = cho_factor(matrix * scale[:, None] * scale)
    except np.linalg.LinAlgError as error:
        raise MisfitError(SLACK) from error
    return np.asarray(scale[:, None] * cho_solve(factor, scale[:, None] * sides))
