"""Contact of plates with their own images beyond mirror planes, of a lattice cut at these planes.

A node at the distance d from a plane is 2 d from its image. Half of the energy of such a pair of
walls belongs to either side,

    1/2 a phi_t(2 d) = a phi_(t/2)(d),    phi_t(d) = C Y' t b(d / t),

so that a mirror plane acts as a rigid platen (`contact`). A node and its image move alike along the
plane, so that there is no friction.
"""

from typing import NamedTuple

import numpy as np

from kernels.compile.jit import jit, jit_exact
from kernels.laws.barrier import barrier
from kernels.shared.moves import ADVANCE


class Mirror(NamedTuple):
    """Nodes that may meet their images, on the side of lesser coordinates of their plane.

    coordinate (k,): of a node, normal to its plane. node (k,). place (k,): of the plane, m. rest
    (k,): distance at rest, m.
    """

    coordinate: np.ndarray
    node: np.ndarray
    place: np.ndarray
    rest: np.ndarray


NO_MIRROR = Mirror(np.empty(0, np.int64), np.empty(0, np.int64), np.empty(0), np.empty(0))


@jit
def against(x, contact, mirror, i):
    """Return energy (J), slope (N) and curvature (N/m) of node ``i``, in its distance."""
    p = mirror.node[i]
    d = mirror.place[i] - x[mirror.coordinate[i]]
    starts = min(0.5 * contact.thickness[p], mirror.rest[i])
    if d >= starts:
        return 0.0, 0.0, 0.0
    value, slope, curvature = barrier(d / starts)
    scale = contact.area[p] * contact.stiffness
    return scale * starts * value, scale * slope, scale / starts * curvature


@jit_exact
def evaluate(x, contact, mirror, g):
    """Return the energy in J; add its gradient to ``g`` (n,)."""
    total = 0.0
    for i in range(mirror.node.size):
        value, slope, _ = against(x, contact, mirror, i)
        total += value
        g[mirror.coordinate[i]] -= slope
    return total


@jit_exact
def step_limit(x, dx, mirror, most):
    """Return the admissible share of ``dx``, at most ``most``: no node reaches its plane."""
    for i in range(mirror.node.size):
        c = mirror.coordinate[i]
        if dx[c] > 0.0:
            most = min(most, ADVANCE * (mirror.place[i] - x[c]) / dx[c])
    return most


@jit_exact
def least_gap(x, mirror, least):
    """Return the least of ``least`` (m) and of the distances of nodes from their planes."""
    for i in range(mirror.node.size):
        least = min(least, mirror.place[i] - x[mirror.coordinate[i]])
    return least
