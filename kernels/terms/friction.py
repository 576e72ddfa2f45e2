"""Coulomb friction, smoothed at a small slip, with normal force and direction lagged.

    D_f = sum mu lambda f(u),   f(u) = |u|^2/eps - |u|^3/(3 eps^2) + eps/3 for |u| < eps, else |u|

u is the tangential slip since y (`integrators`), lambda the normal force of a pair at the last
iterate of a fixed-point loop (Li et al. 2020, eq. 16). Walls have a thickness, so that two walls
which turn together do not slip: with T the tangent, d the distance and w the rotation of the
segment,

    u = T . (dp - dc) - d w,    linear in the moves of p, a, b; `LaggedContacts` keeps the slopes.

A share that the contact sum counts twice is taken off here with a negative force, so that friction
sees the same normal force as contact.

f'' is nothing but a spike at u = 0, which Newton's method leaps over, to and fro. So f' is an
unknown of its own, the dual w: with f' = u / psi(u), what is linearised is psi(u) w = u, and
(1 - w psi') / psi stands for f'', which it is as soon as w = f' (Chan, Golub & Mulet 1999, SIAM J.
Sci. Comput. 20, 1964). A contact whose slip changes its sign is held, as w knows the old one.
"""

from typing import NamedTuple

import numpy as np

from kernels.arrays import pair
from kernels.compile.jit import jit, jit_exact, jit_owning
from kernels.geometry import near_pairs
from kernels.geometry.distance import direction, normal
from kernels.linear.block_matrix import add_block
from kernels.terms.contact import Touching, meet, normal_force, plate_force
from kernels.terms.contact import no_contacts as none_touching

UNKNOWN = 2.0  # as a dual
FIT = 0.1  # of the load: a dual that is farther off is not what it should be


class Friction(NamedTuple):
    """mu, and the slip below which friction is smoothed: its speed in m/s, or eps in m of a static
    step. mu = 0: none.
    """

    mu: float
    slip: float


class LaggedContacts(NamedTuple):
    """Lagged contacts: nodes (n, 3) p, a, b; slopes (n, 3, 2) of the slip in them; load (n,).

    load is mu * lambda in N. A rigid platen does not move sideways: a = b = p with slope zero.
    dual (n,): w so far, or `UNKNOWN`, then f'. count (1,): how many there are, with room for more.
    touching: the contacts that they were taken from.
    """

    nodes: np.ndarray
    slopes: np.ndarray
    load: np.ndarray
    dual: np.ndarray
    count: np.ndarray
    touching: Touching


@jit_owning
def no_contacts(pairs, contact, friction):
    """Return no lagged contacts, with room for all pairs and platens in contact."""
    if friction.mu == 0.0:
        return none()
    most = 3 * pairs.node.size + 2 * contact.plate_nodes.size
    nodes, slopes = np.empty((most, 3), np.int64), np.empty((most, 3, 2))
    count = np.zeros(1, np.int64)
    return LaggedContacts(
        nodes, slopes, np.empty(most), np.empty(most), count, none_touching(pairs)
    )


@jit_owning
def none():
    """Return no lagged contacts, and room for none."""
    nodes, slopes = np.empty((0, 3), np.int64), np.empty((0, 3, 2))
    count = np.zeros(1, np.int64)
    return LaggedContacts(
        nodes, slopes, np.empty(0), np.empty(0), count, none_touching(near_pairs.empty())
    )


@jit_owning
def moved(lagged_contacts, larger):
    """Return ``larger`` with what is in ``lagged_contacts``."""
    larger.count[0] = min(lagged_contacts.count[0], larger.load.size)
    for n in range(larger.count[0]):
        larger.load[n], larger.dual[n] = lagged_contacts.load[n], lagged_contacts.dual[n]
        for k in range(3):
            larger.nodes[n, k] = lagged_contacts.nodes[n, k]
            larger.slopes[n, k, 0] = lagged_contacts.slopes[n, k, 0]
            larger.slopes[n, k, 1] = lagged_contacts.slopes[n, k, 1]
    return larger


@jit_exact
def _put(lagged_contacts, n, nodes, load):
    lagged_contacts.nodes[n, 0], lagged_contacts.nodes[n, 1], lagged_contacts.nodes[n, 2] = nodes
    lagged_contacts.load[n], lagged_contacts.dual[n] = load, UNKNOWN
    for v in range(3):
        lagged_contacts.slopes[n, v, 0], lagged_contacts.slopes[n, v, 1] = 0.0, 0.0
    return n + 1


@jit_exact
def _lag_segment(x, lagged_contacts, n, nodes, tau, load):
    """Add the contact of node p with the point ``tau`` of segment a-b; return the new count."""
    p, a, b = nodes
    nx, ny, d = normal(x, p, a, b, tau)
    ux, uy, length = direction(x, a, b)
    rx, ry = -d * uy / length, d * ux / length
    _put(lagged_contacts, n, nodes, load)
    lagged_contacts.slopes[n, 0, 0], lagged_contacts.slopes[n, 0, 1] = -ny, nx
    lagged_contacts.slopes[n, 1, 0] = rx + (1.0 - tau) * ny
    lagged_contacts.slopes[n, 1, 1] = ry - (1.0 - tau) * nx
    lagged_contacts.slopes[n, 2, 0], lagged_contacts.slopes[n, 2, 1] = tau * ny - rx, -tau * nx - ry
    return n + 1


@jit_exact
def lag(x, contact, pairs, drift, friction, lagged_contacts):
    """Fill ``lagged_contacts`` with all pairs in contact at ``x``. drift: as in `contact.meet`."""
    n, lagged_contacts.count[0], touching = 0, 0, lagged_contacts.touching
    if friction.mu == 0.0:
        return
    meet(x, contact, pairs, drift, touching)
    for i in range(touching.count[0]):
        k = touching.pair[i]
        a, b = pair(contact.edges, pairs.edge[k])
        load = friction.mu * normal_force(contact, pairs, touching, i)
        n = _lag_segment(x, lagged_contacts, n, (pairs.node[k], a, b), touching.tau[i], load)
    for p in contact.plate_nodes:
        for d in (x[2 * p + 1] - x[contact.low], x[contact.high] - x[2 * p + 1]):
            load = friction.mu * plate_force(contact, p, d)
            if load > 0.0:
                n = _put(lagged_contacts, n, (p, p, p), load)
                lagged_contacts.slopes[n - 1, 0, 0] = 1.0
    lagged_contacts.count[0] = n


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
def _slip(u, lagged_contacts, k):
    total = 0.0
    for v in range(3):
        i = 2 * lagged_contacts.nodes[k, v]
        total += lagged_contacts.slopes[k, v, 0] * u[i] + lagged_contacts.slopes[k, v, 1] * u[i + 1]
    return total


@jit
def evaluate(u, lagged_contacts, slip, g):
    """Return D_f in J for a move ``u`` (n,) from y, zero at rest; add dD_f/dx to ``g``."""
    total = 0.0
    for k in range(lagged_contacts.count[0]):
        value, slope = smooth(_slip(u, lagged_contacts, k), slip)
        total += lagged_contacts.load[k] * (value - slip / 3.0)
        for v in range(3):
            i = 2 * lagged_contacts.nodes[k, v]
            g[i] += lagged_contacts.load[k] * slope * lagged_contacts.slopes[k, v, 0]
            g[i + 1] += lagged_contacts.load[k] * slope * lagged_contacts.slopes[k, v, 1]
    return total


@jit
def follow(u, dx, share, lagged_contacts, slip):
    """Take the duals all along a Newton step ``dx`` (n,), ``share`` of which has led to ``u``.

    Return whether they are what they should be there, so that `hessian` is the second derivative.
    """
    fit = True
    for k in range(lagged_contacts.count[0]):
        move, at = _slip(dx, lagged_contacts, k), _slip(u, lagged_contacts, k)
        before = at - share * move
        w = (
            before / _stretched(before, slip)[0]
            + curvature(before, lagged_contacts.dual[k], slip) * move
        )
        lagged_contacts.dual[k] = min(max(w, -1.0), 1.0)
        fit = fit and abs(lagged_contacts.dual[k] - at / _stretched(at, slip)[0]) < FIT
    return fit


@jit
def forget(lagged_contacts):
    """Forget all duals: `hessian` is then the second derivative."""
    for k in range(lagged_contacts.count[0]):
        lagged_contacts.dual[k] = UNKNOWN


@jit
def hessian(u, lagged_contacts, slip, matrix, projected):
    """Add d2D_f/dx2, or what stands for it; ``projected``: without shares of negative force."""
    for k in range(lagged_contacts.count[0]):
        weight = lagged_contacts.load[k] * curvature(
            _slip(u, lagged_contacts, k), lagged_contacts.dual[k], slip
        )
        if weight == 0.0 or (projected and weight < 0.0):
            continue
        last = 3 if lagged_contacts.nodes[k, 1] != lagged_contacts.nodes[k, 0] else 1
        for v in range(last):
            vx, vy = (
                weight * lagged_contacts.slopes[k, v, 0],
                weight * lagged_contacts.slopes[k, v, 1],
            )
            for w in range(v + 1):
                wx, wy = lagged_contacts.slopes[k, w, 0], lagged_contacts.slopes[k, w, 1]
                i, j = 2 * lagged_contacts.nodes[k, v], 2 * lagged_contacts.nodes[k, w]
                add_block(matrix, i, j, vx * wx, vx * wy, vy * wx, vy * wy)
