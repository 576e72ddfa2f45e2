"""Coulomb friction, smoothed at a small slip, with normal force and direction lagged.

    D_f = sum mu lambda f(u),   f(u) = |u|^2/eps - |u|^3/(3 eps^2) + eps/3 for |u| < eps, else |u|

u is the tangential slip since y (`scheme`), lambda the normal force of a pair at the last iterate
of a fixed-point loop (Li et al. 2020, eq. 16). Walls have a thickness, so that two walls which turn
together do not slip: with T the tangent, d the distance and w the rotation of the segment,

    u = T . (dp - dc) - d w,    linear in the moves of p, a, b with the slopes kept in `Grips`.

A share that the contact sum counts twice is taken off here with a negative force, so that friction
sees the same normal force as contact.

f'' is nothing but a spike at u = 0, which Newton's method leaps over, to and fro. So f' is an
unknown of its own, the dual w: with f' = u / psi(u), what is linearised is psi(u) w = u, and
(1 - w psi') / psi stands for f'', which it is as soon as w = f' (Chan, Golub & Mulet 1999, SIAM J.
Sci. Comput. 20, 1964). A contact whose slip changes its sign is held, as w knows the old one.
"""

from typing import NamedTuple

import numpy as np

from kernels.terms.barrier import barrier
from kernels.terms.contact import cancelled
from kernels.geometry.distance import closest, direction, normal
from kernels.linear.block_matrix import add_block
from kernels.compile.jit import jit, jit_exact, jit_owning
from kernels.geometry.near_pairs import counted, within
from kernels.arrays import pair

UNKNOWN = 2.0  # as a dual
FIT = 0.1  # of the load: a dual that is farther off is not what it should be


class Friction(NamedTuple):
    """mu, and the slip below which friction is smoothed: its speed in m/s, or eps in m of a static
    step. mu = 0: none.
    """

    mu: float
    slip: float


class Grips(NamedTuple):
    """Lagged contacts: nodes (n, 3) p, a, b; slopes (n, 3, 2) of the slip in them; load (n,).

    load is mu * lambda in N. A rigid platen does not move sideways: a = b = p with slope zero.
    dual (n,): w so far, or `UNKNOWN`, then f'. count (1,): how many there are, with room for more.
    """

    nodes: np.ndarray
    slopes: np.ndarray
    load: np.ndarray
    dual: np.ndarray
    count: np.ndarray


@jit_owning
def room(pairs, contact, friction):
    """Return no grips, with room for all pairs and platens in contact."""
    most = 3 * pairs.node.size + 2 * contact.plate_nodes.size if friction.mu > 0.0 else 0
    count = np.zeros(1, np.int64)
    return Grips(
        np.empty((most, 3), np.int64), np.empty((most, 3, 2)), np.empty(most), np.empty(most), count
    )


@jit_owning
def none():
    """Return no grips."""
    count = np.zeros(1, np.int64)
    return Grips(np.empty((0, 3), np.int64), np.empty((0, 3, 2)), np.empty(0), np.empty(0), count)


@jit_owning
def moved(grips, larger):
    """Return ``larger`` with what is in ``grips``."""
    larger.count[0] = min(grips.count[0], larger.load.size)
    for n in range(larger.count[0]):
        larger.load[n], larger.dual[n] = grips.load[n], grips.dual[n]
        for k in range(3):
            larger.nodes[n, k] = grips.nodes[n, k]
            larger.slopes[n, k, 0] = grips.slopes[n, k, 0]
            larger.slopes[n, k, 1] = grips.slopes[n, k, 1]
    return larger


@jit_exact
def _put(grips, n, nodes, load):
    grips.nodes[n, 0], grips.nodes[n, 1], grips.nodes[n, 2] = nodes
    grips.load[n], grips.dual[n] = load, UNKNOWN
    for v in range(3):
        grips.slopes[n, v, 0], grips.slopes[n, v, 1] = 0.0, 0.0
    return n + 1


@jit_exact
def _grip_segment(x, grips, n, nodes, tau, load):
    """Add the contact of node p with the point ``tau`` of segment a-b; return the new count."""
    p, a, b = nodes
    nx, ny, d = normal(x, p, a, b, tau)
    ux, uy, length = direction(x, a, b)
    rx, ry = -d * uy / length, d * ux / length
    _put(grips, n, nodes, load)
    grips.slopes[n, 0, 0], grips.slopes[n, 0, 1] = -ny, nx
    grips.slopes[n, 1, 0] = rx + (1.0 - tau) * ny
    grips.slopes[n, 1, 1] = ry - (1.0 - tau) * nx
    grips.slopes[n, 2, 0], grips.slopes[n, 2, 1] = tau * ny - rx, -tau * nx - ry
    return n + 1


@jit_exact
def _normal_force(contact, weight, dc, d):
    return -weight * contact.stiffness * barrier(d / dc)[1] if d < dc else 0.0


@jit_exact
def lag(x, contact, pairs, drift, friction, grips):
    """Fill ``grips`` with all pairs in contact at ``x``. ``drift``: as in `contact.evaluate`."""
    n, grips.count[0] = 0, 0
    if friction.mu == 0.0:
        return
    for k in range(within(pairs, contact.reach + 2.0 * drift)):
        p, dc = pairs.node[k], pairs.d_contact[k]
        if dc == 0.0:
            continue
        a, b = pair(contact.edges, pairs.edge[k])
        tau, inside = closest(x, p, a, b)
        _, _, d = normal(x, p, a, b, tau)
        if d >= dc:
            continue
        length, first, second = counted(pairs, k, contact)
        weight, off = 0.5 * friction.mu * length, cancelled(tau, inside, first, second)
        if off < 0:
            load = _normal_force(contact, weight, dc, d)
            n = _grip_segment(x, grips, n, (p, a, b), tau, load)
        for side, end, elsewhere in ((0, 0.0, first), (1, 1.0, second)):
            _, _, d = normal(x, p, a, b, end)
            if elsewhere != 0.0 and d < dc and side != off:
                load = -_normal_force(contact, weight, dc, d)
                n = _grip_segment(x, grips, n, (p, a, b), end, load)
    for p in contact.plate_nodes:
        dc, weight = 0.5 * contact.node_thickness[p], friction.mu * contact.tributary[p]
        for d in (x[2 * p + 1] - x[contact.low], x[contact.high] - x[2 * p + 1]):
            if d < dc and weight > 0.0:
                n = _put(grips, n, (p, p, p), _normal_force(contact, weight, dc, d))
                grips.slopes[n - 1, 0, 0] = 1.0
    grips.count[0] = n


@jit
def smooth(u, slip):
    """Return f and f' of the smoothed |u|."""
    size = abs(u)
    if size >= slip:
        return size, 1.0 if u > 0.0 else -1.0
    s = size / slip
    return slip * (s * s * (1.0 - s / 3.0) + 1.0 / 3.0), u / slip * (2.0 - s)


@jit
def _stretched(u, slip):
    """Return psi with f' = u / psi, and psi'."""
    s, sign = abs(u) / slip, 1.0 if u > 0.0 else -1.0
    if s >= 1.0:
        return abs(u), sign
    return slip / (2.0 - s), sign / (2.0 - s) ** 2


@jit
def curvature(u, w, slip):
    """Return (1 - w psi') / psi: f'' where the dual ``w`` is f', or is not known."""
    psi, slope = _stretched(u, slip)
    if w == UNKNOWN:
        w = u / psi
    return (1.0 - w * slope) / psi


@jit
def _slip(u, grips, k):
    total = 0.0
    for v in range(3):
        i = 2 * grips.nodes[k, v]
        total += grips.slopes[k, v, 0] * u[i] + grips.slopes[k, v, 1] * u[i + 1]
    return total


@jit
def evaluate(u, grips, slip, g):
    """Return D_f in J for a move ``u`` (n,) from y, zero at rest; add dD_f/dx to ``g``."""
    total = 0.0
    for k in range(grips.count[0]):
        value, slope = smooth(_slip(u, grips, k), slip)
        total += grips.load[k] * (value - slip / 3.0)
        for v in range(3):
            i = 2 * grips.nodes[k, v]
            g[i] += grips.load[k] * slope * grips.slopes[k, v, 0]
            g[i + 1] += grips.load[k] * slope * grips.slopes[k, v, 1]
    return total


@jit
def follow(u, dx, share, grips, slip):
    """Take the duals all along a Newton step ``dx`` (n,), ``share`` of which has led to ``u``.

    Return whether they are what they should be there, so that `hessian` is the second derivative.
    """
    fit = True
    for k in range(grips.count[0]):
        move, at = _slip(dx, grips, k), _slip(u, grips, k)
        before = at - share * move
        w = before / _stretched(before, slip)[0] + curvature(before, grips.dual[k], slip) * move
        grips.dual[k] = min(max(w, -1.0), 1.0)
        fit = fit and abs(grips.dual[k] - at / _stretched(at, slip)[0]) < FIT
    return fit


@jit
def forget(grips):
    """Forget all duals: `hessian` is then the second derivative."""
    for k in range(grips.count[0]):
        grips.dual[k] = UNKNOWN


@jit
def hessian(u, grips, slip, matrix, projected):
    """Add d2D_f/dx2, or what stands for it; ``projected``: without shares of negative force."""
    for k in range(grips.count[0]):
        weight = grips.load[k] * curvature(_slip(u, grips, k), grips.dual[k], slip)
        if weight == 0.0 or (projected and weight < 0.0):
            continue
        last = 3 if grips.nodes[k, 1] != grips.nodes[k, 0] else 1
        for v in range(last):
            vx, vy = weight * grips.slopes[k, v, 0], weight * grips.slopes[k, v, 1]
            for w in range(v + 1):
                wx, wy = grips.slopes[k, w, 0], grips.slopes[k, w, 1]
                i, j = 2 * grips.nodes[k, v], 2 * grips.nodes[k, w]
                add_block(matrix, i, j, vx * wx, vx * wy, vy * wx, vy * wy)
