"""Coulomb friction, smoothed at a small slip, with normal force and direction lagged.

    D_f = sum mu lambda f(delta),
    f = delta^2/eps - |delta|^3/(3 eps^2) + eps/3 for |delta| < eps, else |delta|

delta is the tangential slip since y (`solve.integrators`), lambda the normal force of a pair (Li et
al. 2020, eq. 16) at the point where it was last lagged: the start of the step, in statics its
extrapolated end, or, in the second minimisation of integrators of second order, the end found by
the first one. Walls have a thickness, so that two walls that rotate together do not slip: with the
tangent T, the distance d, the moves dp of the node and dc of the closest point, and the rotation
omega of the segment,

    delta = T . (dp - dc) - d omega,   linear in the moves of p, a, b, with the slopes of
                                       `LaggedContacts`.

Contributions that the contact sum subtracts at a vertex are taken from the other normal forces of
the same node: from forces at this vertex, then from forces of segments that end there, then from
all forces, in proportion, in whatever order pairs are listed. None becomes negative: a negative
lambda would have a concave potential, and generate energy. So the normal forces of a node have the
same sum as its contact forces, unless this sum is negative.

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
from kernels.laws.barrier import phi
from kernels.linear.condensed.block_matrix import add_block
from kernels.terms import profile
from kernels.terms.contact import Touching, detect, normal_force, platen_force, platens_of
from kernels.terms.contact import no_contacts as none_touching

UNKNOWN = 2.0  # dual that is not set; a dual is within -1 .. 1
NO_CONTACT = -1
DUAL_TOLERANCE = 0.1  # largest |w - f'| at which the factor may be reused: its part in a contact
# then differs from f'' by at most a tenth of 1 / psi


class Friction(NamedTuple):
    """mu: coefficient, 0 without friction. slip: eps in a static step of one row, m; eps / h in a
    dynamic one, m/s.
    """

    mu: float
    slip: float


@jit_owning
def no_contacts(pairs, contact, friction):
    """Return an empty `LaggedContacts`, with room for all pairs if there is friction."""
    if friction.mu == 0.0:
        return none()
    size = 3 * pairs.node.size + 2 * contact.platen_nodes.size + profile.room(contact.profiles)
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
            larger.points[n, k] = lagged_contacts.points[n, k]
            larger.slopes[n, k, 0] = lagged_contacts.slopes[n, k, 0]
            larger.slopes[n, k, 1] = lagged_contacts.slopes[n, k, 1]
    return larger


@jit_exact
def _start(lagged_contacts, n, points, load):
    """Write contact ``n`` with zero slopes."""
    at = lagged_contacts.points
    at[n, 0], at[n, 1], at[n, 2] = points
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
    _start(lagged_contacts, n, (2 * p, 2 * a, 2 * b), load)
    lagged_contacts.slopes[n, 0, 0], lagged_contacts.slopes[n, 0, 1] = -ny, nx
    lagged_contacts.slopes[n, 1, 0] = rx + (1.0 - tau) * ny
    lagged_contacts.slopes[n, 1, 1] = ry - (1.0 - tau) * nx
    lagged_contacts.slopes[n, 2, 0], lagged_contacts.slopes[n, 2, 1] = tau * ny - rx, -tau * nx - ry
    return n + 1


@jit_exact
def settle(load, claim, after, first):
    """Subtract claims from the loads of a node, and the remaining negative loads from all in
    proportion.

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
    """Claim ``wanted`` in N, in proportion, from the loads of a node with this ``nearness`` to
    vertex ``v``; return the part that exceeds these loads.
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
        if load > 0.0:  # n <= i: no load is overwritten before it is read
            a, b = pair(contact.edges, pairs.edge[k])
            n = _lag_segment(x, lagged_contacts, n, (pairs.node[k], a, b), touching.tau[i], load)
    for p in contact.platen_nodes:
        for platen, side, away in platens_of(contact):
            d = side * (x[2 * p + 1] - x[platen]) + away
            load = friction.mu * platen_force(contact, p, d)
            if load > 0.0:
                _start(lagged_contacts, n, (2 * p, 2 * p, 2 * p), load)
                lagged_contacts.slopes[n, 0, 0] = 1.0
                n += 1
    lagged_contacts.count[0] = _lag_profiles(x, lagged_contacts, n, contact, friction.mu)


@jit_exact
def _lag_profiles(x, lagged_contacts, n, contact, mu):
    """Append the contacts with profiles; return the new count."""
    profiles = contact.profiles
    for k in range(profiles.radius.size):
        for p in profiles.nodes:
            starts = profiles.node_half[p]
            nx, ny, d, _ = profile.near_node(x, profiles, k, p, starts)
            if d < starts:
                _, slope, _ = phi(profiles.tributary[p], contact.stiffness, starts, d)
                carrier = profiles.carrier[k] - contact.low
                _lag_on(lagged_contacts, n, (p, p), 0.0, (nx, ny), contact.low, carrier)
                lagged_contacts.load[n] = -mu * slope
                n += 1
        for i in range(profiles.start[k], profiles.start[k + 1]):
            if profiles.weight[i] > 0.0:
                n = _lag_vertex(x, lagged_contacts, n, contact, k, i, mu)
    return n


@jit_exact
def _lag_on(lagged_contacts, n, nodes, tau, normal, low, carrier):
    """Write contact ``n`` of the point ``tau`` between two nodes with a profile.

    carrier: 0 if the lower platen moves the profile, whose coordinate is ``low``; 1: the upper.
    """
    (nx, ny), (a, b) = normal, nodes
    _start(lagged_contacts, n, (2 * a, 2 * b, low), 0.0)
    lagged_contacts.slopes[n, 0, 0] = -(1.0 - tau) * ny
    lagged_contacts.slopes[n, 0, 1] = (1.0 - tau) * nx
    lagged_contacts.slopes[n, 1, 0], lagged_contacts.slopes[n, 1, 1] = -tau * ny, tau * nx
    lagged_contacts.slopes[n, 2, carrier] = -nx


@jit_exact
def _lag_vertex(x, lagged_contacts, n, contact, k, i, mu):
    """Append the contacts of vertex ``i`` of profile ``k`` with elements; return the new count.

    Subtracted contributions at nodes are taken from all contacts in proportion.
    """
    profiles, begun = contact.profiles, n
    low, carrier = contact.low, profiles.carrier[k] - contact.low
    for e in range(profiles.edges.shape[0]):
        starts, weight = profiles.edge_half[e], profiles.weight[i]
        tau, nx, ny, d = profile.near_element(x, profiles, k, i, e, starts)
        if d >= starts:
            continue
        _lag_on(lagged_contacts, n, pair(profiles.edges, e), tau, (nx, ny), low, carrier)
        lagged_contacts.load[n] = -phi(weight, contact.stiffness, starts, d)[1]
        n += 1
        for end in range(2):
            _, _, d = profile.near_end(x, profiles, k, i, profiles.edges[e, end])
            if profiles.subtract[e, end] != 0.0 and d < starts:
                lagged_contacts.load[n] = phi(weight, contact.stiffness, starts, d)[1]
                n += 1
    for j in range(begun, n):
        lagged_contacts.claim[j] = 0.0
        lagged_contacts.after[j] = j - 1 if j > begun else NO_CONTACT
    settle(
        lagged_contacts.load,
        lagged_contacts.claim,
        lagged_contacts.after,
        n - 1 if n > begun else NO_CONTACT,
    )
    return _kept(lagged_contacts, begun, n, mu)


@jit_exact
def _kept(lagged_contacts, begun, end, mu):
    """Close the gaps in the contacts from ``begun`` on, keeping those with a load; return the new
    count.
    """
    n = begun
    for j in range(begun, end):
        if lagged_contacts.load[j] > 0.0:
            lagged_contacts.load[n] = mu * lagged_contacts.load[j]
            lagged_contacts.dual[n] = UNKNOWN
            for v in range(3):
                lagged_contacts.points[n, v] = lagged_contacts.points[j, v]
                lagged_contacts.slopes[n, v, 0] = lagged_contacts.slopes[j, v, 0]
                lagged_contacts.slopes[n, v, 1] = lagged_contacts.slopes[j, v, 1]
            n += 1
    return n


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
        i = lagged_contacts.points[k, v]
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
            i = lagged_contacts.points[k, v]
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

    points (n, 3): first coordinates of p, a, b, or of two nodes and both platens. slopes (n, 3, 2):
    derivatives of the slip in their moves. load (n,): mu lambda, N. dual (n,): w; `UNKNOWN` stands
    for f'. A rigid platen does not move sideways: a = b = p with slope zero. Scratch: touching, the
    contacts; first (nodes,), the first contact of each node; after (n,), the next contact of the
    same node; claim (n,), the load to be subtracted from each, N.
    """

    points: np.ndarray
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
        at = lagged_contacts.points
        last = 3 if at[k, 2] != at[k, 0] else 1
        for a in range(last):
            ax, ay = (
                weight * lagged_contacts.slopes[k, a, 0],
                weight * lagged_contacts.slopes[k, a, 1],
            )
            for b in range(a + 1):
                bx, by = lagged_contacts.slopes[k, b, 0], lagged_contacts.slopes[k, b, 1]
                if at[k, a] == at[k, b] and a != b:  # of one node twice: slope zero
                    continue
                add_block(matrix, at[k, a], at[k, b], ax * bx, ax * by, ay * bx, ay * by)
