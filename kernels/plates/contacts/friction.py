"""Coulomb friction of walls in space, with normal force and tangent plane lagged.

    D_f = sum mu lambda f(|delta|),   f of `terms.friction`

delta: tangential slip since y, two numbers in the plane normal to the contact; lambda: normal force
of the contact where it was last lagged, as in `terms.friction` (Li et al. 2020, eq. 16). Walls have
a thickness, so that two walls that rotate together do not slip: with the distance d, the normal n,
the moves dp of the node and dc of the closest point, and the rotation omega of the triangle,

    delta = T^T [dp - dc - d omega x n],   linear in the moves of p, a, b, c

The rotation of a triangle with the sides e_1, e_2, its normal N and the dual basis e^k is omega =
(sum e^k x de_k + N x dN) / 2, which is exact for any rigid motion, so that friction has no
resultant moment.

Primal-dual Newton method (Chan, Golub & Mulet 1999, SIAM J. Sci. Comput. 20, 1964): the dual w =
f' e, e = delta / |delta|, is an unknown, and psi(|delta|) w = delta is linearised. The Hessian in
delta is

    (I - psi' (w e^T + e w^T) / 2) / psi,

positive semi-definite for |w| <= 1, and the second derivative where w = delta / psi.
`terms.friction` is the same in the plane. A negative force, where the contact sum subtracts more
than it adds at a side or a corner, is taken from the other forces of the same node: first in
proportion from features that contain this side or corner, the remainder from all forces.
"""

import math
from typing import NamedTuple

import numpy as np

from kernels.compile.jit import jit, jit_exact, jit_owning
from kernels.geometry.space.derivatives import gap
from kernels.geometry.space.vectors import SIZE, cross, inner, length, minus, plus, point, times
from kernels.plates.contacts.contact import platen_block
from kernels.plates.contacts.touching import NO_PAIR, Touching, corners, detect, shares
from kernels.plates.contacts.touching import no_contacts as none_touching
from kernels.terms.friction import DUAL_TOLERANCE, NO_CONTACT, UNKNOWN, settle, smooth


@jit_owning
def _room(n, touching):
    """Return an empty `LaggedContacts` with room for ``n``."""
    return LaggedContacts(
        np.empty((n, 4), np.int64), np.empty(n, np.int64), np.empty((n, 4, 2, 3)), np.empty(n),
        np.empty((n, 2)), np.zeros(1, np.int64), touching, np.empty(n, np.int64), np.empty(n),
    )  # fmt: skip


@jit_exact
def _most(pairs, contact, friction):
    """Return the greatest number of lagged contacts; 0 without friction."""
    nodes = contact.low_nodes.size + contact.high_nodes.size
    return pairs.triangle.size + pairs.lower.size + nodes if friction.mu != 0.0 else 0


@jit_owning
def no_contacts(pairs, contact, friction):
    """Return an empty `LaggedContacts`, with room for all pairs if there is friction."""
    return _room(_most(pairs, contact, friction), none_touching(contact, pairs))


@jit_owning
def with_room(lagged, pairs, contact, friction):
    """Return the contacts of ``lagged``, with room for all pairs."""
    most, touching = _most(pairs, contact, friction), none_touching(contact, pairs)
    if most <= lagged.load.size:
        return LaggedContacts(
            lagged.nodes, lagged.size, lagged.slopes, lagged.load, lagged.dual, lagged.count,
            touching, lagged.after, lagged.claim,
        )  # fmt: skip
    larger, count = _room(most, touching), lagged.count[0]
    larger.count[0] = count
    larger.nodes[:count], larger.size[:count] = lagged.nodes[:count], lagged.size[:count]
    larger.slopes[:count], larger.dual[:count] = lagged.slopes[:count], lagged.dual[:count]
    larger.load[:count] = lagged.load[:count]
    return larger


@jit_exact
def _tangents(n):
    """Return two unit vectors u, v with u x v = ``n``."""
    axis = (1.0, 0.0, 0.0) if abs(n[0]) < 0.6 else (0.0, 1.0, 0.0)
    u = plus(axis, -inner(axis, n), n)
    u = times(1.0 / length(u), u)
    return u, cross(n, u)


@jit_exact
def _add(slopes, i, j, factor, vector):
    """Add ``factor`` ``vector`` to the slope of slip ``j`` in the move of node ``i``."""
    for k in range(3):
        slopes[i, j, k] += factor * vector[k]


@jit_exact
def _turn(slopes, j, factor, along, a, b, c):
    """Add ``factor`` times the rotation of the triangle a, b, c about ``along`` to slip ``j``."""
    e1, e2 = minus(b, a), minus(c, a)
    normal = cross(e1, e2)
    size = length(normal)
    if not size > 0.0:
        return
    dual1, dual2 = times(1.0 / (size * size), cross(e2, normal)), cross(normal, e1)
    dual2, normal = times(1.0 / (size * size), dual2), times(1.0 / size, normal)
    across = cross(along, normal)
    one = times(0.5, plus(cross(along, dual1), -inner(dual1, across), normal))
    two = times(0.5, plus(cross(along, dual2), -inner(dual2, across), normal))
    _add(slopes, 2, j, factor, one)
    _add(slopes, 3, j, factor, two)
    _add(slopes, 1, j, -factor, one)
    _add(slopes, 1, j, -factor, two)


@jit_exact
def _start(lagged_contacts, n, load, size):
    """Begin contact ``n`` with zero slopes."""
    lagged_contacts.load[n], lagged_contacts.size[n] = load, size
    for j in range(2):
        lagged_contacts.dual[n, j] = UNKNOWN
        for i in range(4):
            for k in range(3):
                lagged_contacts.slopes[n, i, j, k] = 0.0


@jit_exact
def _lag_triangle(x, contact, touching, m, load, lagged_contacts, n):
    """Write contact ``m`` of ``touching`` with a triangle as contact ``n``."""
    triangle, slopes = contact.triangles[touching.triangle[m]], lagged_contacts.slopes[n]
    _start(lagged_contacts, n, load, 4)
    lagged_contacts.nodes[n, 0] = touching.nodes[m, 0]
    for i in range(3):
        lagged_contacts.nodes[n, i + 1] = triangle[i]
    points, share = corners(x, touching, m), shares(touching, m)
    normal, d = gap(share, points)
    u, v = _tangents(normal)
    _add(slopes, 0, 0, 1.0, u)
    _add(slopes, 0, 1, 1.0, v)
    for i in range(1, touching.size[m]):
        for j in range(3):
            if triangle[j] == touching.nodes[m, i]:
                _add(slopes, j + 1, 0, share[i], u)
                _add(slopes, j + 1, 1, share[i], v)
    a, b, c = point(x, triangle[0]), point(x, triangle[1]), point(x, triangle[2])
    _turn(slopes, 0, -d, v, a, b, c)
    _turn(slopes, 1, d, u, a, b, c)


@jit_exact
def _lag_platen(x, contact, upper, mu, lagged_contacts, n):
    """Append the contacts with a platen; return the new count."""
    nodes = contact.high_nodes if upper else contact.low_nodes
    for i in range(nodes.size):
        p, force, _ = platen_block(x, contact, upper, i)
        if force > 0.0:
            _start(lagged_contacts, n, mu * force, 1)
            for k in range(4):
                lagged_contacts.nodes[n, k] = p
            lagged_contacts.slopes[n, 0, 0, 0] = 1.0
            lagged_contacts.slopes[n, 0, 1, 1] = 1.0
            n += 1
    return n


@jit_exact
def _holds(touching, n, m):
    """Return whether the feature of contact ``n`` has all corners of the feature of contact
    ``m``.
    """
    count = 1
    for i in range(1, touching.size[m]):
        for j in range(1, touching.size[n]):
            count += touching.nodes[m, i] == touching.nodes[n, j]
    return count == touching.size[m]


@jit_exact
def _claim(lagged_contacts, m, first):
    """Claim the negative load ``m`` from the loads of its node whose features contain its
    feature.
    """
    touching, load = lagged_contacts.touching, lagged_contacts.load
    total, n = 0.0, first
    while n != NO_CONTACT:
        if load[n] > 0.0 and _holds(touching, n, m):
            total += load[n]
        n = lagged_contacts.after[n]
    share = min(-load[m] / total, 1.0) if total > 0.0 else 0.0
    n = first
    while n != NO_CONTACT:
        if load[n] > 0.0 and _holds(touching, n, m):
            lagged_contacts.claim[n] += share * load[n]
        n = lagged_contacts.after[n]


@jit_exact
def _fill_loads(lagged_contacts):
    """Fill ``load`` with the normal forces of all contacts of nodes in ``touching``, N, none
    negative; return their number.

    They precede the contacts of two edges, which have no friction.
    """
    touching, load, after = (
        lagged_contacts.touching, lagged_contacts.load, lagged_contacts.after,
    )  # fmt: skip
    count, first = 0, 0
    while count < touching.count[0] and touching.pair[count] == NO_PAIR:
        load[count], lagged_contacts.claim[count] = -touching.slope[count], 0.0
        after[count] = NO_CONTACT
        if count > 0 and touching.nodes[count, 0] == touching.nodes[count - 1, 0]:
            after[count - 1] = count
        count += 1
    for m in range(count):
        if touching.nodes[m, 0] != touching.nodes[first, 0]:
            settle(load, lagged_contacts.claim, after, first)
            first = m
        if load[m] < 0.0:
            _claim(lagged_contacts, m, first)
    if count > 0:
        settle(load, lagged_contacts.claim, after, first)
    return count


@jit_exact
def lag(lagged_contacts, x, contact, pairs, drift, friction):
    """Fill ``lagged_contacts`` with all contacts at ``x``.

    drift: as in `touching.detect`; friction: `kernels.terms.friction.Friction`.
    """
    n, lagged_contacts.count[0], touching = 0, 0, lagged_contacts.touching
    if friction.mu == 0.0:
        return
    detect(x, contact, pairs, drift, touching)
    for m in range(_fill_loads(lagged_contacts)):
        load = friction.mu * lagged_contacts.load[m]
        if load > 0.0:  # n <= m: no load is overwritten before it is read
            _lag_triangle(x, contact, touching, m, load, lagged_contacts, n)
            n += 1
    n = _lag_platen(x, contact, False, friction.mu, lagged_contacts, n)
    lagged_contacts.count[0] = _lag_platen(x, contact, True, friction.mu, lagged_contacts, n)


@jit
def _psi(size, eps):
    """Return psi, defined by f' = |delta| / psi, and psi' at |delta| = ``size``."""
    s = size / eps
    if s >= 1.0:
        return size, 1.0
    return eps / (2.0 - s), 1.0 / (2.0 - s) ** 2


@jit
def _slip(u, lagged_contacts, k):
    """Return the two slips of contact ``k`` in the move ``u`` (n,), m."""
    one, two = 0.0, 0.0
    for i in range(lagged_contacts.size[k]):
        place = SIZE * lagged_contacts.nodes[k, i]
        for m in range(3):
            one += lagged_contacts.slopes[k, i, 0, m] * u[place + m]
            two += lagged_contacts.slopes[k, i, 1, m] * u[place + m]
    return one, two


@jit
def evaluate(lagged_contacts, u, eps, g):
    """Return D_f in J for a move ``u`` (n,) from y, shifted to 0 at u = 0; add dD_f/dx to ``g``."""
    total = 0.0
    for k in range(lagged_contacts.count[0]):
        one, two = _slip(u, lagged_contacts, k)
        size = math.hypot(one, two)
        value, _ = smooth(size, eps)
        total += lagged_contacts.load[k] * (value - eps / 3.0)
        factor = lagged_contacts.load[k] / _psi(size, eps)[0]
        for i in range(lagged_contacts.size[k]):
            place = SIZE * lagged_contacts.nodes[k, i]
            for m in range(3):
                g[place + m] += factor * (
                    one * lagged_contacts.slopes[k, i, 0, m]
                    + two * lagged_contacts.slopes[k, i, 1, m]
                )
    return total


@jit
def curvature(delta, w, eps):
    """Return (c_11, c_12, c_22), the matrix of the module's docstring at the slip ``delta`` and the
    dual ``w``, of two numbers each.
    """
    size = math.hypot(delta[0], delta[1])
    psi, slope = _psi(size, eps)
    if size == 0.0:
        return 1.0 / psi, 0.0, 1.0 / psi
    one, two = (delta[0] / psi, delta[1] / psi) if w[0] == UNKNOWN else (w[0], w[1])
    e, f = delta[0] / size, delta[1] / size
    c11, c22 = 1.0 - slope * one * e, 1.0 - slope * two * f
    return c11 / psi, -0.5 * slope * (one * f + two * e) / psi, c22 / psi


@jit
def _next_dual(delta, move, w, eps):
    """Return the dual after the Newton step ``move`` from the slip ``delta`` and the dual ``w``.

    Its size is at most 1. It is linearised with the symmetric `curvature`, as the Hessian is: with
    the unsymmetric linearisation, a tenth of 200 random problems of one contact ended in a cycle.
    """
    psi, _ = _psi(math.hypot(delta[0], delta[1]), eps)
    c11, c12, c22 = curvature(delta, w, eps)
    one = delta[0] / psi + c11 * move[0] + c12 * move[1]
    two = delta[1] / psi + c12 * move[0] + c22 * move[1]
    shrink = max(math.hypot(one, two), 1.0)
    return one / shrink, two / shrink


@jit
def follow(lagged_contacts, u, dx, share, eps):
    """Update the duals in a Newton step ``dx`` (n,), a ``share`` of which has led to ``u``.

    Return whether they agree with the slip there, so that `block` is the second derivative.
    """
    agree = True
    for k in range(lagged_contacts.count[0]):
        move, at = _slip(dx, lagged_contacts, k), _slip(u, lagged_contacts, k)
        before = at[0] - share * move[0], at[1] - share * move[1]
        dual = lagged_contacts.dual[k, 0], lagged_contacts.dual[k, 1]
        one, two = _next_dual(before, move, dual, eps)
        lagged_contacts.dual[k, 0], lagged_contacts.dual[k, 1] = one, two
        psi, _ = _psi(math.hypot(at[0], at[1]), eps)
        off = math.hypot(one - at[0] / psi, two - at[1] / psi)
        agree = agree and off < DUAL_TOLERANCE
    return agree


@jit
def forget(lagged_contacts):
    """Reset all duals: `block` is then the second derivative."""
    for k in range(lagged_contacts.count[0]):
        lagged_contacts.dual[k, 0] = UNKNOWN


class LaggedContacts(NamedTuple):
    """Lagged contacts, the first ``count`` (1,) entries; verbs as in `kernels.shared.lagging`.

    nodes (n, 4): p, a, b, c; size (n,): 4, or 1 for a platen, which does not move sideways. slopes
    (n, 4, 2, 3): derivatives of the slip in the moves of the nodes. load (n,): mu lambda, N. dual
    (n, 2): w; `UNKNOWN` stands for f' e at the present slip. touching, after, claim (n,): scratch,
    the latter two as in `terms.friction`.
    """

    nodes: np.ndarray
    size: np.ndarray
    slopes: np.ndarray
    load: np.ndarray
    dual: np.ndarray
    count: np.ndarray
    touching: Touching
    after: np.ndarray
    claim: np.ndarray

    lag = lag
    evaluate = evaluate
    follow = follow
    forget = forget


@jit
def block(u, lagged_contacts, eps, k, K):
    """Write the primal-dual Hessian of contact ``k`` to ``K`` (12, 12); return the number of its
    nodes.

    Row and column 3 i + m: coordinate m of node lagged_contacts.nodes[k, i]; only rows and columns
    of its nodes are written. It is positive semi-definite.
    """
    load, size = lagged_contacts.load[k], lagged_contacts.size[k]
    dual = lagged_contacts.dual[k, 0], lagged_contacts.dual[k, 1]
    c11, c12, c22 = curvature(_slip(u, lagged_contacts, k), dual, eps)
    for i in range(size):
        for m in range(3):
            one, two = lagged_contacts.slopes[k, i, 0, m], lagged_contacts.slopes[k, i, 1, m]
            left, right = load * (c11 * one + c12 * two), load * (c12 * one + c22 * two)
            for j in range(size):
                for q in range(3):
                    K[3 * i + m, 3 * j + q] = (
                        left * lagged_contacts.slopes[k, j, 0, q]
                        + right * lagged_contacts.slopes[k, j, 1, q]
                    )
    return size
