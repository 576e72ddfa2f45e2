"""The active contacts of walls at one position, with their forces.

Contributions of triangles, sides and corners at one closest point add up to one contact;
contributions that cancel are left out. `kernels.plates.contacts.contact` has the energy.
"""

from typing import NamedTuple

import numpy as np

from kernels.compile.jit import jit, jit_owning
from kernels.geometry.space import parallel
from kernels.geometry.space.closest import FACE, on_edge, on_edges, on_triangle
from kernels.geometry.space.vectors import combined, inner, minus, point
from kernels.laws.barrier import CLOSEST, phi
from kernels.plates.contacts.pairs import EDGE_SHARE, edges_within

NEGLIGIBLE = 1e-12  # a sum below this share of its terms, at a side or a corner, is zero
NO_PAIR = -1


class Touching(NamedTuple):
    """Active contacts at one position, filled by `detect`: the first ``count`` (1,) entries.

    nodes (n, 4): of the stencil; share (n, 4): weights of its nodes in the vector between the
    closest points; size (n,): number of its nodes, the first ones; free (n,): which closest points
    move (`geometry.space.derivatives`). pair (n,): of edges, or `NO_PAIR`; triangle (n,): triangle
    that the node touches. slope, curvature (n,): of the energy in the distance, N and N/m; scale
    (n,): sum of the magnitudes of the contributions, N. distance (n,): m. feature (n,): corner, or
    number of nodes + side, -1 if neither; slot: its contact, -1 if none, scratch.
    """

    nodes: np.ndarray
    share: np.ndarray
    size: np.ndarray
    free: np.ndarray
    pair: np.ndarray
    triangle: np.ndarray
    slope: np.ndarray
    curvature: np.ndarray
    scale: np.ndarray
    distance: np.ndarray
    feature: np.ndarray
    slot: np.ndarray
    count: np.ndarray


@jit_owning
def no_contacts(contact, pairs):
    """Return an empty `Touching` with room for all pairs."""
    n = pairs.triangle.size + pairs.lower.size + pairs.one.size
    return Touching(
        np.empty((n, 4), np.int64), np.empty((n, 4)), np.empty(n, np.int64), np.empty(n, np.int64),
        np.empty(n, np.int64), np.empty(n, np.int64), np.empty(n), np.empty(n), np.empty(n),
        np.empty(n), np.empty(n, np.int64),
        np.full(contact.area.size + contact.edges.shape[0], -1), np.zeros(1, np.int64),
    )  # fmt: skip


@jit
def _write(touching, nodes, share, size, free, feature):
    """Append a contact without force; return its number."""
    n = touching.count[0]
    for i in range(4):
        touching.nodes[n, i], touching.share[n, i] = nodes[i], share[i]
    touching.size[n], touching.free[n], touching.pair[n] = size, free, NO_PAIR
    touching.feature[n] = feature
    touching.slope[n], touching.curvature[n], touching.scale[n] = 0.0, 0.0, 0.0
    touching.count[0] = n + 1
    return n


@jit
def _raise(touching, n, d, slope, curvature):
    """Add ``slope`` and ``curvature`` to contact ``n``."""
    touching.distance[n] = d
    touching.slope[n] += slope
    touching.curvature[n] += curvature
    touching.scale[n] += abs(slope) + d * abs(curvature)


@jit
def _at_corner(touching, p, v, triangle):
    """Return the contact of node ``p`` with corner ``v``."""
    n = touching.slot[v]
    if n < 0:
        n = _write(touching, (p, v, v, v), (1.0, -1.0, 0.0, 0.0), 2, 0, v)
        touching.slot[v], touching.triangle[n] = n, triangle
    return n


@jit
def _at_side(contact, touching, p, e, s, triangle):
    """Return the contact of node ``p`` with edge ``e`` at the share ``s`` along it."""
    f = contact.area.size + e
    n = touching.slot[f]
    if n < 0:
        a, b = contact.edges[e, 0], contact.edges[e, 1]
        n = _write(touching, (p, a, b, b), (1.0, s - 1.0, -s, 0.0), 3, 1, f)
        touching.slot[f], touching.triangle[n] = n, triangle
    return n


@jit
def _along(contact, k, feature, v, w):
    """Return (e, s): the edge on which the closest point of triangle ``k`` lies, and its place
    there.
    """
    i = feature - 3
    e = contact.sides[k, i]
    s = v if i == 0 else (w if i == 1 else 1.0 - w)
    return e, (s if contact.edges[e, 0] == contact.triangles[k, i] else 1.0 - s)


@jit
def _meet(contact, touching, p, k, closest):
    """Return the contact of node ``p`` with triangle ``k`` at its ``closest`` point."""
    feature, v, w = closest
    if feature < 3:
        return _at_corner(touching, p, contact.triangles[k, feature], k)
    if feature < FACE:
        e, s = _along(contact, k, feature, v, w)
        return _at_side(contact, touching, p, e, s, k)
    a, b, c = contact.triangles[k, 0], contact.triangles[k, 1], contact.triangles[k, 2]
    n = _write(touching, (p, a, b, c), (1.0, v + w - 1.0, -v, -w), 4, 3, -1)
    touching.triangle[n] = k
    return n


@jit
def _meet_lower(contact, touching, p, f, s, triangle):
    """Return the contact of node ``p`` with corner or side ``f``, at ``s`` along a side."""
    if f < contact.area.size:
        return _at_corner(touching, p, f, triangle)
    e = f - contact.area.size
    if s <= 0.0:
        return _at_corner(touching, p, contact.edges[e, 0], triangle)
    if s >= 1.0:
        return _at_corner(touching, p, contact.edges[e, 1], triangle)
    return _at_side(contact, touching, p, e, s, triangle)


@jit
def _triangles(x, contact, pairs, p, drift, touching):
    """Add the contacts of node ``p`` with triangles; return their energy, J."""
    total, at, weight = 0.0, point(x, p), 0.5 * contact.area[p]
    for q in range(pairs.start[p], pairs.start[p + 1]):
        if pairs.bound[q] >= contact.reach + 2.0 * drift:
            break
        dc, k = pairs.d_contact[q], pairs.triangle[q]
        if dc == 0.0 or pairs.bound[q] >= dc + 2.0 * drift:
            continue
        a = point(x, contact.triangles[k, 0])
        b, c = point(x, contact.triangles[k, 1]), point(x, contact.triangles[k, 2])
        feature, v, w = on_triangle(at, a, b, c)
        r = combined((1.0, v + w - 1.0, -v, -w), at, a, b, c)
        d2 = inner(r, r)
        if d2 >= dc * dc:
            continue
        if not d2 > (CLOSEST * dc) ** 2:
            return np.inf
        d = d2**0.5
        value, slope, curvature = phi(weight, contact.stiffness, dc, d)
        total += value
        n = _meet(contact, touching, p, k, (feature, v, w))
        _raise(touching, n, d, slope, curvature)
    return total


@jit
def _lower(x, contact, pairs, p, drift, touching):
    """Add the contacts of node ``p`` with sides and corners; return their energy, J."""
    total, at, n_nodes = 0.0, point(x, p), contact.area.size
    for j in range(pairs.lower_start[p], pairs.lower_start[p + 1]):
        dc, f, s = pairs.lower_contact[j], pairs.lower[j], 0.0
        if pairs.lower_bound[j] >= dc + 2.0 * drift:
            continue
        if f < n_nodes:
            r = minus(at, point(x, f))
        else:
            a, b = contact.edges[f - n_nodes, 0], contact.edges[f - n_nodes, 1]
            one, two = point(x, a), point(x, b)
            s = on_edge(at, one, two)
            r = combined((1.0, s - 1.0, -s, 0.0), at, one, two, two)
        d2 = inner(r, r)
        if d2 >= dc * dc:
            continue
        weight, d = 0.5 * contact.area[p] * pairs.lower_weight[j], d2**0.5
        value, slope, curvature = phi(weight, contact.stiffness, dc, d)
        total += value
        n = _meet_lower(contact, touching, p, f, s, pairs.lower_triangle[j])
        _raise(touching, n, d, slope, curvature)
    return total


@jit
def _copy(touching, n, to):
    """Copy contact ``n`` to place ``to``."""
    for i in range(4):
        touching.nodes[to, i], touching.share[to, i] = touching.nodes[n, i], touching.share[n, i]
    touching.size[to], touching.free[to] = touching.size[n], touching.free[n]
    touching.pair[to], touching.triangle[to] = touching.pair[n], touching.triangle[n]
    touching.slope[to], touching.curvature[to] = touching.slope[n], touching.curvature[n]
    touching.distance[to] = touching.distance[n]


@jit
def _keep(touching, first):
    """Keep the contacts from ``first`` on whose contributions do not cancel; free their slots."""
    kept = first
    for n in range(first, touching.count[0]):
        if touching.feature[n] >= 0:
            touching.slot[touching.feature[n]] = -1
        size = abs(touching.slope[n]) + touching.distance[n] * abs(touching.curvature[n])
        if size > NEGLIGIBLE * touching.scale[n]:
            if kept < n:
                _copy(touching, n, kept)
            kept += 1
    touching.count[0] = kept


@jit
def corners(x, touching, n):
    """Return the positions of the four nodes of contact ``n``."""
    return (
        point(x, touching.nodes[n, 0]), point(x, touching.nodes[n, 1]),
        point(x, touching.nodes[n, 2]), point(x, touching.nodes[n, 3]),
    )  # fmt: skip


@jit
def shares(touching, n):
    """Return the weights of the four nodes of contact ``n``."""
    return (
        touching.share[n, 0], touching.share[n, 1], touching.share[n, 2], touching.share[n, 3],
    )  # fmt: skip


@jit
def _edges(x, contact, pairs, drift, touching):
    """Add the contacts of two edges; return their energy, J."""
    total = 0.0
    for i in range(edges_within(pairs, EDGE_SHARE * contact.reach + 2.0 * drift)):
        dc, one, two = pairs.edge_contact[i], pairs.one[i], pairs.two[i]
        if dc == 0.0 or pairs.edge_bound[i] >= dc + 2.0 * drift:
            continue
        a, b, c, d = (
            contact.edges[one, 0], contact.edges[one, 1],
            contact.edges[two, 0], contact.edges[two, 1],
        )  # fmt: skip
        points = point(x, a), point(x, b), point(x, c), point(x, d)
        s, t = on_edges(points[0], points[1], points[2], points[3])
        share = (1.0 - s, s, t - 1.0, -t)
        r = combined(share, points[0], points[1], points[2], points[3])
        d2 = inner(r, r)
        if d2 >= dc * dc:
            continue
        if not d2 > (CLOSEST * dc) ** 2:
            return np.inf
        value, slope, curvature = phi(pairs.edge_area[i], contact.stiffness, dc, d2**0.5)
        m, _, _ = parallel.factor(points, pairs.edge_scale[i])
        free = (1 if 0.0 < s < 1.0 else 0) + (2 if 0.0 < t < 1.0 else 0)
        n = _write(touching, (a, b, c, d), share, 4, free, -1)
        touching.pair[n], touching.triangle[n] = i, -1
        _raise(touching, n, d2**0.5, m * slope, m * curvature)
        total += m * value
    return total


@jit
def detect(x, contact, pairs, drift, touching):
    """Fill ``touching`` with all active contacts of walls at ``x``; return their energy in J,
    infinite at a distance of zero.

    drift: longest move of a node since the pairs were listed, m. Contributions that cancel are left
    out: above a flat sheet one contact remains for each node.
    """
    touching.count[0], total = 0, 0.0
    for p in range(contact.area.size):
        first = touching.count[0]
        energy = _triangles(x, contact, pairs, p, drift, touching)
        if touching.count[0] > first and energy < np.inf:
            energy += _lower(x, contact, pairs, p, drift, touching)
        _keep(touching, first)
        if not energy < np.inf:
            touching.count[0] = 0
            return np.inf
        total += energy
    return total + _edges(x, contact, pairs, drift, touching)
