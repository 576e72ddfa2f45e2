"""Coulomb friction, smoothed at a small slip, with normal force and direction lagged.

    D_f = sum mu lambda f(delta),
    f = delta^2/eps - |delta|^3/(3 eps^2) + eps/3 for |delta| < eps, else |delta|

delta is the tangential slip since y (`solve.integrators`), lambda the normal force of a pair (Li et
al. 2020, eq. 16) at the point where it was last lagged: the start of the step or, in the second
minimisation of integrators of second order, the end that the first one has found. Walls have a
thickness, so that two walls that rotate together do not slip: with the tangent T, the distance d,
the moves dp of the node and dc of the closest point, and the rotation omega of the segment,

    delta = T . (dp - dc) - d omega,   linear in the moves of p, a, b, with the slopes of
                                       `LaggedContacts`.

Contributions that the contact sum subtracts at a vertex are taken from the other normal forces of
the same node: from those at this vertex, then from those of segments that end there, then from all,
in proportion, in whatever order pairs are listed. None becomes negative: a negative lambda would
have a concave potential, and give energy. So the normal forces of a node have the sum of those of
contact, unless that is negative.

f'' is a spike at delta = 0, over which Newton's method oscillates. A primal-dual method avoids
this: the dual w = f' is an unknown, and with f' = delta / psi(delta) the linearised equation is
psi(delta) w = delta. In the Hessian (1 - w psi') / psi replaces f'' and equals it where w = f'
(Chan, Golub & Mulet 1999, SIAM J. Sci. Comput. 20, 1964). When the slip of a contact changes its
sign, w still has the old sign, which makes the contact stick.
"""

from typing import NamedTuple

import numpy as np

from kernels.arrays import pair
from kernels.compile.jit import jit, jit_exact, jit_owning
from kernels.geometry import near_pairs
from kernels.geometry.distance import direction, normal
from kernels.linear.condensed.block_matrix import add_block
from kernels.terms.contact import Touching, detect, normal_force, platen_force
from kernels.terms.contact import no_contacts as none_touching

UNKNOWN = 2.0  # dual that is not set; a dual is within -1 .. 1
NO_CONTACT = -1
DUAL_TOLERANCE = 0.1  # largest |w - f'| at which the factor may be reused: its part in a contact
# then differs from f'' by at most a tenth of 1 / psi


class Friction(NamedTuple):
    """mu: coefficient, 0 without friction. slip: eps in a static step, m; eps / h in a dynamic
    one, m/s.
    """

    mu: float
    slip: float


@jit_owning
def no_contacts(pairs, contact, friction):
    """Return an empty `LaggedContacts`, with room for all pairs if there is friction."""
    if friction.mu == 0.0:
        return none()
    size = 3 * pairs.node.size + 2 * contact.platen_nodes.size
    return _room(size, pairs, contact.tributary.size)


@jit_owning
def none():
    """Return an empty `LaggedContacts` without room."""
    return _room(0, near_pairs.empty(), 0)


@jit_owning
def _room(size, pairs, n_nodes):
    """Return an empty `LaggedContacts` with room for ``size``."""
    return LaggedContacts(
        np.empty((size, 3), np.int64), np.empty((size, 3, 2)), np.empty(size), np.empty(size),
        np.zeros(1, np.int64), none_touching(pairs), np.empty(n_nodes, np.int64),
        np.empty(size, np.int64), np.empty(size),
    )  # fmt: skip


@jit_owning
def enlarged(lagged_contacts, larger):
    """Copy the contacts of ``lagged_contacts`` to ``larger``; return ``larger``."""
    larger.count[0] = min(lagged_contacts.count[0], larger.load.size)
    for n in range(larger.count[0]):
        larger.load[n], larger.dual[n] = lagged_contacts.load[n], lagged_contacts.dual[n]
        for k in range(3):
            larger.nodes[n, k] = lagged_contacts.nodes[n, k]
            larger.slopes[n, k, 0] = lagged_contacts.slopes[n, k, 0]
            larger.slopes[n, k, 1] = lagged_contacts.slopes[n, k, 1]
    return larger


@jit_exact
def _start(lagged_contacts, n, nodes, load):
    """Write contact ``n`` with zero slopes."""
    lagged_contacts.nodes[n, 0], lagged_contacts.nodes[n, 1], lagged_contacts.nodes[n, 2] = nodes
    lagged_contacts.load[n], lagged_contacts.dual[n] = load, UNKNOWN
    for v in range(3):
        lagged_contacts.slopes[n, v, 0], lagged_contacts.slopes[n, v, 1] = 0.0, 0.0


@jit_exact
def _lag_segment(x, lagged_contacts, n, nodes, tau, load):
    """Append the contact of node p with the point ``tau`` of segment a-b; return the new count."""
    p, a, b = nodes
    nx, ny, d = normal(x, p, a, b, tau)
    ux, uy, length = direction(x, a, b)
    rx, ry = -d * uy / length, d * ux / length
    _start(lagged_contacts, n, nodes, load)
    lagged_contacts.slopes[n, 0, 0], lagged_contacts.slopes[n, 0, 1] = -ny, nx
    lagged_contacts.slopes[n, 1, 0] = rx + (1.0 - tau) * ny
    lagged_contacts.slopes[n, 1, 1] = ry - (1.0 - tau) * nx
    lagged_contacts.slopes[n, 2, 0], lagged_contacts.slopes[n, 2, 1] = tau * ny - rx, -tau * nx - ry
    return n + 1


@jit_exact
def settle(load, claim, after, first):
    """Take claims from the loads of a node, and what is left of negative loads from all alike.

    first: a contact of the node; after (n,): the next one of each, `NO_CONTACT` after the last.
    """
    left, total, i = 0.0, 0.0, first
    while i != NO_CONTACT:
        taken = load[i] if load[i] < 0.0 else min(claim[i], load[i])
        load[i] = max(load[i] - taken, 0.0)
        left, total, i = left - taken, total + load[i], after[i]
    share = max(1.0 - left / total, 0.0) if left > 0.0 and total > 0.0 else 1.0
    i = first
    while i != NO_CONTACT:
        load[i], i = share * load[i], after[i]


@jit_exact
def _nearness(contact, pairs, touching, i, v):
    """Return 2 if contact ``i`` is at vertex ``v``, 1 if its segment ends there, else 0."""
    a, b = pair(contact.edges, pairs.edge[touching.pair[i]])
    if a != v and b != v:
        return 0
    return 2 if touching.tau[i] == (0.0 if a == v else 1.0) else 1


@jit_exact
def _claim(lagged_contacts, contact, pairs, first, v, nearness, wanted):
    """Claim ``wanted`` in N from the loads of a node that are so near to vertex ``v``, in
    proportion; return what they do not have.
    """
    touching, load = lagged_contacts.touching, lagged_contacts.load
    total, j = 0.0, first
    while j != NO_CONTACT:
        if load[j] > 0.0 and _nearness(contact, pairs, touching, j, v) == nearness:
            total += load[j]
        j = lagged_contacts.after[j]
    share = min(wanted / total, 1.0) if total > 0.0 else 0.0
    j = first
    while j != NO_CONTACT:
        if load[j] > 0.0 and _nearness(contact, pairs, touching, j, v) == nearness:
            lagged_contacts.claim[j] += share * load[j]
        j = lagged_contacts.after[j]
    return max(wanted - total, 0.0)


@jit_exact
def _fill_loads(lagged_contacts, contact, pairs):
    """Fill ``load`` with the normal force of every contact in ``touching``, N, none negative."""
    touching, load = lagged_contacts.touching, lagged_contacts.load
    first, after = lagged_contacts.first, lagged_contacts.after
    for p in range(first.size):
        first[p] = NO_CONTACT
    for i in range(touching.count[0]):
        load[i], p = normal_force(contact, pairs, touching, i), pairs.node[touching.pair[i]]
        lagged_contacts.claim[i], after[i], first[p] = 0.0, first[p], i
    for i in range(touching.count[0]):
        if load[i] < 0.0:
            k, wanted = touching.pair[i], -load[i]
            v = contact.edges[pairs.edge[k], touching.end[i]]
            for nearness in (2, 1):
                start = first[pairs.node[k]]
                wanted = _claim(lagged_contacts, contact, pairs, start, v, nearness, wanted)
    for p in range(first.size):
        settle(load, lagged_contacts.claim, after, first[p])


@jit_exact
def lag(lagged_contacts, x, contact, pairs, drift, friction):
    """Fill ``lagged_contacts`` with all contacts at ``x``. drift: as in `contact.detect`."""
    n, lagged_contacts.count[0], touching = 0, 0, lagged_contacts.touching
    if friction.mu == 0.0:
        return
    detect(x, contact, pairs, drift, touching)
    _fill_loads(lagged_contacts, contact, pairs)
    for i in range(touching.count[0]):
        k, load = touching.pair[i], friction.mu * lagged_contacts.load[i]
        if load > 0.0:  # n <= i: loads that are still to be read are not overwritten
            a, b = pair(contact.edges, pairs.edge[k])
            n = _lag_segment(x, lagged_contacts, n, (pairs.node[k], a, b), touching.tau[i], load)
    for p in contact.platen_nodes:
        for d in (x[2 * p + 1] - x[contact.low], x[contact.high] - x[2 * p + 1]):
            load = friction.mu * platen_force(contact, p, d)
            if load > 0.0:
                _start(lagged_contacts, n, (p, p, p), load)
                lagged_contacts.slopes[n, 0, 0] = 1.0
                n += 1
    lagged_contacts.count[0] = n


@jit
def smooth(delta, eps):
    """Return f, the smoothed |delta|, and f'."""
    size = abs(delta)
    if size >= eps:
        return size, 1.0 if delta > 0.0 else -1.0
    s = size / eps
    return eps * (s * s * (1.0 - s / 3.0) + 1.0 / 3.0), delta / eps * (2.0 - s)


@jit
def _psi(delta, eps):
    """Return psi(delta), defined by f' = delta / psi, and psi'."""
    s, sign = abs(delta) / eps, 1.0 if delta > 0.0 else -1.0
    if s >= 1.0:
        return abs(delta), sign
    return eps / (2.0 - s), sign / (2.0 - s) ** 2


@jit
def curvature(delta, w, eps):
    """Return (1 - w psi') / psi, which is f'' if the dual ``w`` is f' or `UNKNOWN`."""
    psi, slope = _psi(delta, eps)
    if w == UNKNOWN:
        w = delta / psi
    return (1.0 - w * slope) / psi


@jit
def _slip(u, lagged_contacts, k):
    """Return the slip of contact ``k`` in the move ``u`` (n,), m."""
    total = 0.0
    for v in range(3):
        i = 2 * lagged_contacts.nodes[k, v]
        total += lagged_contacts.slopes[k, v, 0] * u[i] + lagged_contacts.slopes[k, v, 1] * u[i + 1]
    return total


@jit
def evaluate(lagged_contacts, u, eps, g):
    """Return D_f in J for a move ``u`` (n,) from y, shifted to 0 at u = 0; add dD_f/dx to ``g``."""
    total = 0.0
    for k in range(lagged_contacts.count[0]):
        value, slope = smooth(_slip(u, lagged_contacts, k), eps)
        total += lagged_contacts.load[k] * (value - eps / 3.0)
        for v in range(3):
            i = 2 * lagged_contacts.nodes[k, v]
            g[i] += lagged_contacts.load[k] * slope * lagged_contacts.slopes[k, v, 0]
            g[i + 1] += lagged_contacts.load[k] * slope * lagged_contacts.slopes[k, v, 1]
    return total


@jit
def follow(lagged_contacts, u, dx, share, eps):
    """Update the duals in a Newton step ``dx`` (n,), a ``share`` of which has led to ``u``.

    Return whether they agree with f' there, so that `hessian` is the second derivative.
    """
    agree = True
    for k in range(lagged_contacts.count[0]):
        move, at = _slip(dx, lagged_contacts, k), _slip(u, lagged_contacts, k)
        before = at - share * move
        w = before / _psi(before, eps)[0] + curvature(before, lagged_contacts.dual[k], eps) * move
        lagged_contacts.dual[k] = min(max(w, -1.0), 1.0)
        agree = agree and abs(lagged_contacts.dual[k] - at / _psi(at, eps)[0]) < DUAL_TOLERANCE
    return agree


@jit
def forget(lagged_contacts):
    """Reset all duals: `hessian` is then the second derivative."""
    for k in range(lagged_contacts.count[0]):
        lagged_contacts.dual[k] = UNKNOWN


class LaggedContacts(NamedTuple):
    """Lagged contacts, the first ``count`` (1,) entries; verbs as in `kernels.shared.lagging`.

    nodes (n, 3): p, a, b. slopes (n, 3, 2): derivatives of the slip in their moves. load (n,): mu
    lambda, N. dual (n,): w; `UNKNOWN` stands for f'. A rigid platen does not move sideways: a = b =
    p with slope zero. touching, first (nodes,), after, claim (n,): scratch for the contacts, for
    those of each node, the first and the one after each, and for what is taken from each, N.
    """

    nodes: np.ndarray
    slopes: np.ndarray
    load: np.ndarray
    dual: np.ndarray
    count: np.ndarray
    touching: Touching
    first: np.ndarray
    after: np.ndarray
    claim: np.ndarray

    lag = lag
    evaluate = evaluate
    follow = follow
    forget = forget


@jit
def hessian(u, lagged_contacts, eps, matrix):
    """Add the primal-dual d2D_f/dx2, which is positive semi-definite."""
    for k in range(lagged_contacts.count[0]):
        weight = lagged_contacts.load[k] * curvature(
            _slip(u, lagged_contacts, k), lagged_contacts.dual[k], eps
        )
        if weight == 0.0:
            continue
        last = 3 if lagged_contacts.nodes[k, 1] != lagged_contacts.nodes[k, 0] else 1
        for a in range(last):
            ax, ay = (
                weight * lagged_contacts.slopes[k, a, 0],
                weight * lagged_contacts.slopes[k, a, 1],
            )
            for b in range(a + 1):
                bx, by = lagged_contacts.slopes[k, b, 0], lagged_contacts.slopes[k, b, 1]
                i, j = 2 * lagged_contacts.nodes[k, a], 2 * lagged_contacts.nodes[k, b]
                add_block(matrix, i, j, ax * bx, ax * by, ay * bx, ay * by)
