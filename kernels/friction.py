"""Coulomb friction, smoothed at a small slip, with normal force and direction lagged.

    D_f = sum mu lambda f(u),   f(u) = |u|^2/eps - |u|^3/(3 eps^2) + eps/3 for |u| < eps, else |u|

u is the tangential slip within the step, lambda the normal force of a pair at the last iterate of a
fixed-point loop (Li et al. 2020, eq. 16). A share that the contact sum counts twice is taken off
here with a negative force, so that friction sees the same normal force as contact.
"""

from typing import NamedTuple

import numpy as np

from kernels.barrier import barrier
from kernels.distance import closest, normal
from kernels.jit import jit, jit_exact, jit_owning
from kernels.rows import pair
from kernels.sparse import add_block


class Friction(NamedTuple):
    """mu and the slip eps (m) below which friction is smoothed; mu = 0: no friction."""

    mu: float
    slip: float


class Grips(NamedTuple):
    """Lagged contacts. nodes (n, 3): p, a, b (a = -1: platen); tau (n,), tangent (n, 2), load (n,).

    load is mu * lambda in N; a rigid platen does not move sideways.
    """

    nodes: np.ndarray
    tau: np.ndarray
    tangent: np.ndarray
    load: np.ndarray


@jit_owning
def empty():
    """Return no grips."""
    return Grips(np.empty((0, 3), np.int64), np.empty(0), np.empty((0, 2)), np.empty(0))


@jit_exact
def _put(grips, n, nodes, tau, tangent, load):
    grips.nodes[n, 0], grips.nodes[n, 1], grips.nodes[n, 2] = nodes
    grips.tau[n] = tau
    grips.tangent[n, 0], grips.tangent[n, 1] = tangent
    grips.load[n] = load
    return n + 1


@jit_exact
def _normal_force(contact, weight, dc, d):
    return -weight * contact.stiffness * barrier(d / dc)[1] if d < dc else 0.0


@jit_owning
def lag(x, contact, pairs, friction):
    """Return the `Grips` of all pairs in contact at ``x``."""
    most = 3 * pairs.node.size + 2 * contact.plate_nodes.size
    grips = Grips(
        np.empty((most, 3), np.int64), np.empty(most), np.empty((most, 2)), np.empty(most)
    )
    n = 0
    for k in range(pairs.node.size):
        p, dc, weight = pairs.node[k], pairs.d_contact[k], 0.5 * friction.mu * pairs.weight[k]
        a, b = pair(contact.edges, pairs.edge[k])
        tau, _ = closest(x, p, a, b)
        nx, ny, d = normal(x, p, a, b, tau)
        if weight == 0.0 or d >= dc:
            continue
        n = _put(grips, n, (p, a, b), tau, (-ny, nx), _normal_force(contact, weight, dc, d))
        for side, end in ((0, 0.0), (1, 1.0)):
            nx, ny, d = normal(x, p, a, b, end)
            if pairs.subtract[k, side] != 0.0 and d < dc:
                load = -_normal_force(contact, weight, dc, d)
                n = _put(grips, n, (p, a, b), end, (-ny, nx), load)
    for p in contact.plate_nodes:
        dc, weight = 0.5 * contact.node_thickness[p], friction.mu * contact.tributary[p]
        for d in (x[2 * p + 1] - x[contact.low], x[contact.high] - x[2 * p + 1]):
            if d < dc:
                load = _normal_force(contact, weight, dc, d)
                n = _put(grips, n, (p, -1, -1), 0.0, (1.0, 0.0), load)
    return Grips(grips.nodes[:n], grips.tau[:n], grips.tangent[:n], grips.load[:n])


@jit
def smooth(u, slip):
    """Return f, f' and f'' of the smoothed |u|."""
    size = abs(u)
    if size >= slip:
        return size, (1.0 if u > 0.0 else -1.0), 0.0
    s = size / slip
    return (
        slip * (s * s * (1.0 - s / 3.0) + 1.0 / 3.0),
        u / slip * (2.0 - s),
        (2.0 - 2.0 * s) / slip,
    )


@jit
def _slip(x, x0, grips, k):
    p, a, b = grips.nodes[k, 0], grips.nodes[k, 1], grips.nodes[k, 2]
    sx, sy = x[2 * p] - x0[2 * p], x[2 * p + 1] - x0[2 * p + 1]
    if a >= 0:
        wa, wb = 1.0 - grips.tau[k], grips.tau[k]
        sx -= wa * (x[2 * a] - x0[2 * a]) + wb * (x[2 * b] - x0[2 * b])
        sy -= wa * (x[2 * a + 1] - x0[2 * a + 1]) + wb * (x[2 * b + 1] - x0[2 * b + 1])
    return sx * grips.tangent[k, 0] + sy * grips.tangent[k, 1]


@jit
def energy(x, x0, grips, slip):
    """Return D_f in J, counted from zero at rest."""
    total = 0.0
    for k in range(grips.load.size):
        value, _, _ = smooth(_slip(x, x0, grips, k), slip)
        total += grips.load[k] * (value - slip / 3.0)
    return total


@jit
def gradient(x, x0, grips, slip, g):
    """Add dD_f/dx to ``g``."""
    for k in range(grips.load.size):
        _, slope, _ = smooth(_slip(x, x0, grips, k), slip)
        fx = grips.load[k] * slope * grips.tangent[k, 0]
        fy = grips.load[k] * slope * grips.tangent[k, 1]
        p, a, b = grips.nodes[k, 0], grips.nodes[k, 1], grips.nodes[k, 2]
        g[2 * p] += fx
        g[2 * p + 1] += fy
        if a >= 0:
            for v, share in ((a, 1.0 - grips.tau[k]), (b, grips.tau[k])):
                g[2 * v] -= share * fx
                g[2 * v + 1] -= share * fy


@jit
def hessian(x, x0, grips, slip, matrix, projected):
    """Add d2D_f/dx2; ``projected`` leaves out shares with a negative force."""
    for k in range(grips.load.size):
        _, _, curvature = smooth(_slip(x, x0, grips, k), slip)
        weight = grips.load[k] * curvature
        if weight == 0.0 or (projected and weight < 0.0):
            continue
        tx, ty = grips.tangent[k, 0], grips.tangent[k, 1]
        xx, xy, yy = weight * tx * tx, weight * tx * ty, weight * ty * ty
        p, a, b = grips.nodes[k, 0], grips.nodes[k, 1], grips.nodes[k, 2]
        add_block(matrix, 2 * p, 2 * p, xx, xy, xy, yy)
        if a < 0:
            continue
        wa, wb = 1.0 - grips.tau[k], grips.tau[k]
        add_block(matrix, 2 * a, 2 * a, wa * wa * xx, wa * wa * xy, wa * wa * xy, wa * wa * yy)
        add_block(matrix, 2 * b, 2 * b, wb * wb * xx, wb * wb * xy, wb * wb * xy, wb * wb * yy)
        add_block(matrix, 2 * p, 2 * a, -wa * xx, -wa * xy, -wa * xy, -wa * yy)
        add_block(matrix, 2 * p, 2 * b, -wb * xx, -wb * xy, -wb * xy, -wb * yy)
        add_block(matrix, 2 * a, 2 * b, wa * wb * xx, wa * wb * xy, wa * wb * xy, wa * wb * yy)
