"""Contact by position: after a step that knew nothing of contact, what is too near is moved apart.

    x_i -= w_i c grad_i d / sum_j w_j (grad_j d)^2,   c = d - t_c < 0,   w_i = 1 / m_i

for one pair after the other (Gauss-Seidel) until none is closer than the thickness. That keeps the
momentum but not the energy, and a node that has passed through a wall comes out on the wrong side.
"""

from typing import NamedTuple

import numpy as np

from kernels.arrays import pair
from kernels.compile.jit import jit_exact
from kernels.geometry.distance import closest, normal

SWEEPS = 100
APART = 1e-6  # of the distance of contact: a pair that much closer counts as apart


class Projection(NamedTuple):
    """What is moved apart. contact: what may touch, absent where another model sees to it.

    ease (n,): 1 / mass by coordinate, 1/kg; 0 where it is held, led or tied to a platen.
    """

    contact: object
    ease: np.ndarray


@jit_exact
def is_absent(projection):
    """Return whether nothing is ever moved apart."""
    return projection.contact.edges.shape[0] + projection.contact.plate_nodes.size == 0


@jit_exact
def _part(x, ease, p, a, b, d_contact):
    """Move node ``p`` and segment a-b to ``d_contact``; return whether they were closer."""
    tau, _ = closest(x, p, a, b)
    nx, ny, d = normal(x, p, a, b, tau)
    if d == 0.0 or d >= (1.0 - APART) * d_contact:
        return False
    near, far = 1.0 - tau, tau
    give = nx * nx * (ease[2 * p] + near * near * ease[2 * a] + far * far * ease[2 * b])
    give += (
        ny * ny * (ease[2 * p + 1] + near * near * ease[2 * a + 1] + far * far * ease[2 * b + 1])
    )
    if give == 0.0:
        return False
    push = (d_contact - d) / give
    for i, share in ((2 * p, 1.0), (2 * a, -near), (2 * b, -far)):
        x[i] += push * share * nx * ease[i]
        x[i + 1] += push * share * ny * ease[i + 1]
    return True


@jit_exact
def _off_platens(x, contact, ease):
    """Move nodes out of the platens, which give way to nothing; return whether any was inside."""
    moved = False
    for p in contact.plate_nodes:
        i, d_contact = 2 * p + 1, 0.5 * contact.node_thickness[p]
        for plate, side in ((contact.low, 1.0), (contact.high, -1.0)):
            if ease[i] > 0.0 and side * (x[i] - x[plate]) < (1.0 - APART) * d_contact:
                x[i] = x[plate] + side * d_contact
                moved = True
    return moved


@jit_exact
def move_apart(x, projection, pairs):
    """Move the nodes of ``x`` (n,) until all are apart, `SWEEPS` times at most.

    Return whether any has moved.
    """
    contact, ease, moved = projection.contact, projection.ease, False
    for _ in range(SWEEPS):
        close = _off_platens(x, contact, ease)
        for k in range(pairs.node.size):
            if pairs.d_contact[k] > 0.0:
                a, b = pair(contact.edges, pairs.edge[k])
                if _part(x, ease, pairs.node[k], a, b, pairs.d_contact[k]):
                    close = True
        if not close:
            break
        moved = True
    return moved
