"""Position-based contact: after a step without contact, pairs that are too close are moved apart.

    x_i -= w_i c grad_i d / sum_j w_j (grad_j d)^2,   c = d - t_c < 0,   w_i = 1 / m_i

for one pair after the other (Gauss-Seidel) until none is closer than the thickness. The projection
conserves momentum but not energy, and a node that has passed through a wall leaves it on the wrong
side.
"""

from typing import NamedTuple

import numpy as np

from kernels.arrays import pair
from kernels.compile.jit import jit_exact
from kernels.geometry.distance import closest, normal
from kernels.terms.contact import Contact

SWEEPS = 100  # greatest number
TOLERANCE = 1e-6  # share of the contact distance by which a pair may be too close


class Projection(NamedTuple):
    """Data of the projection. contact: pairs that may touch; absent with other contact models.

    inverse_mass (n,): w = 1 / mass by coordinate, 1/kg; 0 for coordinates that are held, driven or
    tied to a platen.
    """

    contact: Contact
    inverse_mass: np.ndarray


@jit_exact
def is_absent(projection):
    """Return whether the scene has no projection."""
    return projection.contact.edges.shape[0] + projection.contact.platen_nodes.size == 0


@jit_exact
def _separate(x, inverse_mass, p, a, b, d_contact):
    """Move node ``p`` and segment a-b apart to ``d_contact``; return whether they were closer."""
    tau, _ = closest(x, p, a, b)
    nx, ny, d = normal(x, p, a, b, tau)
    if d == 0.0 or d >= (1.0 - TOLERANCE) * d_contact:
        return False
    near, far = 1.0 - tau, tau
    i, j, k = 2 * p, 2 * a, 2 * b
    m = inverse_mass
    weight = nx * nx * (m[i] + near * near * m[j] + far * far * m[k])
    weight += ny * ny * (m[i + 1] + near * near * m[j + 1] + far * far * m[k + 1])
    if weight == 0.0:
        return False
    push = (d_contact - d) / weight
    for c, share in ((i, 1.0), (j, -near), (k, -far)):
        x[c] += push * share * nx * m[c]
        x[c + 1] += push * share * ny * m[c + 1]
    return True


@jit_exact
def _leave_platens(x, contact, inverse_mass):
    """Move nodes out of the platens, which do not move; return whether any was inside."""
    moved = False
    for p in contact.platen_nodes:
        i, d_contact = 2 * p + 1, 0.5 * contact.node_thickness[p]
        for platen, side in ((contact.low, 1.0), (contact.high, -1.0)):
            if inverse_mass[i] > 0.0 and side * (x[i] - x[platen]) < (1.0 - TOLERANCE) * d_contact:
                x[i] = x[platen] + side * d_contact
                moved = True
    return moved


@jit_exact
def move_apart(x, projection, pairs):
    """Move the nodes of ``x`` (n,) until all pairs are apart, in at most `SWEEPS` sweeps.

    Return whether any has moved.
    """
    contact, inverse_mass, moved = projection.contact, projection.inverse_mass, False
    for _ in range(SWEEPS):
        moving = _leave_platens(x, contact, inverse_mass)
        for k in range(pairs.node.size):
            if pairs.d_contact[k] > 0.0:
                a, b = pair(contact.edges, pairs.edge[k])
                if _separate(x, inverse_mass, pairs.node[k], a, b, pairs.d_contact[k]):
                    moving = True
        if not moving:
            break
        moved = True
    return moved
