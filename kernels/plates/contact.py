"""Contact of walls in space over their thickness, and with two platens, as a barrier on distance.

    E_c = 1/2 sum_p a_p sum_F w_pF phi(d(p, F)) + sum_p a_p phi(d(p, platen))
          + sum of two edges a m phi(d) / 2
    phi(d) = C Y' t_c b(d / t_c)

p: nodes with the tributary area a_p; F: triangles, sides and corners with the weights of
`kernels.plates.pairs`, by which a surface counts once at any mesh; 1/2, as each pair of walls
counts from both sides; t_c: distance at which contact starts, at most the mean thickness, half of
the thickness for a platen; b: `barrier`.

Two surfaces can cross along edges where all nodes are far. Contact of two edges, below half of t_c,
keeps them apart: a is the product of the widths of the strips that belong to them, so that all
edges together count about once, and m takes parallel edges out (`geometry.space.parallel`).
"""

from typing import NamedTuple

import numpy as np

from kernels.compile.jit import jit, jit_exact, jit_owning
from kernels.geometry.space import advancement, derivatives, parallel, surface
from kernels.geometry.space.closest import (
    FACE,
    on_edge,
    on_edges,
    on_triangle,
    squared_to_triangle,
)
from kernels.geometry.space.vectors import SIZE, combined, inner, minus, point
from kernels.laws.barrier import barrier
from kernels.plates.pairs import EDGE_SHARE, edges_within

NEGLIGIBLE = 1e-12  # of what adds up at a side or a corner: below it nothing is left of the sum
ADVANCE = 0.9  # admissible share of the move up to the first contact with a platen
NO_PAIR = -1
MOST_THICKENING = 1.5  # greatest thickness over which walls touch / that at rest: few are thicker


class Contact(NamedTuple):
    """Data of contact. Lengths in m, areas in m^2; an absent contact has empty arrays.

    stiffness: C Y', Pa. reach: largest distance at which contact starts. most_move: longest move of
    a node that neighbour lists cover. triangles (k, 3), edges (l, 2): nodes; sides (k, 3): edges
    ab, bc, ca of each triangle (`geometry.space.surface`); widths (l,): of the strips that belong
    to edges. area (n,): a_p of each node. thickness (n,): at each node, which a problem may change
    between steps, up to ``reach`` (`plates.thickness`); rest_thickness (n,): at rest. rest (n,
    3): positions at rest. low_nodes (i,), high_nodes (j,): nodes that may touch the lower and the
    upper platen; low_rest, high_rest: their distances from it at rest. low, high: coordinates of
    the platens.
    """

    stiffness: float
    reach: float
    most_move: float
    triangles: np.ndarray
    sides: np.ndarray
    edges: np.ndarray
    widths: np.ndarray
    area: np.ndarray
    thickness: np.ndarray
    rest_thickness: np.ndarray
    rest: np.ndarray
    low_nodes: np.ndarray
    low_rest: np.ndarray
    high_nodes: np.ndarray
    high_rest: np.ndarray
    low: int
    high: int


def build(stiffness, most_move, triangles, area, thickness, rest, low, high):
    """Return the `Contact` of a surface that may thicken up to `MOST_THICKENING` times.

    low, high: (nodes, distances at rest, coordinate) of the two platens. Others: as in `Contact`.
    """
    edges, sides = surface.edges_of(triangles, area.size)
    widths = surface.widths(rest, triangles, edges, sides)
    return Contact(
        stiffness, MOST_THICKENING * float(thickness.max()), most_move, triangles, sides, edges,
        widths, area, thickness.copy(), thickness, rest, low[0], low[1], high[0], high[1], low[2],
        high[2],
    )  # fmt: skip


@jit_exact
def is_absent(contact):
    """Return whether no wall touches another, and no node a platen."""
    return (
        contact.triangles.shape[0] == 0
        and contact.low_nodes.size == 0
        and contact.high_nodes.size == 0
    )


class Touching(NamedTuple):
    """Active contacts at one position, filled by `detect`: the first ``count`` (1,) entries.

    nodes (n, 4): of the stencil; share (n, 4): weights of its nodes in the vector between the
    closest points; size (n,): number of its nodes, the first ones; free (n,): which closest points
    move (`geometry.space.derivatives`). pair (n,): of edges, or `NO_PAIR`; triangle (n,): that of a
    node. slope, curvature (n,): of the energy in the distance, N and N/m; scale (n,): sum of the
    sizes that add up, N. distance (n,): m. feature (n,): corner, or number of nodes + side, -1 if
    neither; slot: its contact, -1 if none, scratch.
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
def _law(contact, weight, d_contact, d):
    """Return weight * phi(d) and its first two derivatives in d. weight in m^2."""
    value, slope, curvature = barrier(d / d_contact)
    scale = weight * contact.stiffness
    return scale * d_contact * value, scale * slope, scale / d_contact * curvature


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
    """Add to the force of contact ``n``."""
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
    """Return (e, s): the edge on which the closest point of triangle ``k`` lies, and where."""
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
        if not d2 > 0.0:
            return np.inf
        d = d2**0.5
        value, slope, curvature = _law(contact, weight, dc, d)
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
        value, slope, curvature = _law(contact, weight, dc, d)
        total += value
        n = _meet_lower(contact, touching, p, f, s, pairs.lower_triangle[j])
        _raise(touching, n, d, slope, curvature)
    return total


@jit
def _copy(touching, n, to):
    """Copy contact ``n`` to the place ``to``."""
    for i in range(4):
        touching.nodes[to, i], touching.share[to, i] = touching.nodes[n, i], touching.share[n, i]
    touching.size[to], touching.free[to] = touching.size[n], touching.free[n]
    touching.pair[to], touching.triangle[to] = touching.pair[n], touching.triangle[n]
    touching.slope[to], touching.curvature[to] = touching.slope[n], touching.curvature[n]
    touching.distance[to] = touching.distance[n]


@jit
def _keep(touching, first):
    """Keep those contacts from ``first`` on whose contributions do not cancel; free their slots."""
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
        if not d2 > 0.0:
            return np.inf
        value, slope, curvature = _law(contact, pairs.edge_area[i], dc, d2**0.5)
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
    out: above a flat sheet one contact is left for each node.
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


@jit
def evaluate(x, contact, pairs, drift, touching, g):
    """Return E_c in J, infinite at a distance of zero; add dE_c/dx to ``g`` (n,).

    Fill ``touching``. drift: as in `detect`.
    """
    total = detect(x, contact, pairs, drift, touching)
    if not total < np.inf:
        return np.inf
    total += _platens(x, contact, g)
    for n in range(touching.count[0]):
        share = shares(touching, n)
        points = corners(x, touching, n)
        normal, _ = derivatives.gap(share, points)
        for i in range(touching.size[n]):
            force = touching.slope[n] * share[i]
            place = SIZE * touching.nodes[n, i]
            for k in range(3):
                g[place + k] += force * normal[k]
        if touching.pair[n] != NO_PAIR:
            _push_apart(contact, pairs, touching, n, points, g)
    return total


@jit
def _mollified(contact, pairs, touching, n, points):
    """Return phi and phi' of a contact of two edges, and m' and m''."""
    i = touching.pair[n]
    value, slope, _ = _law(contact, pairs.edge_area[i], pairs.edge_contact[i], touching.distance[n])
    _, first, second = parallel.factor(points, pairs.edge_scale[i])
    return value, slope, first, second


@jit
def _push_apart(contact, pairs, touching, n, points, g):
    """Add the part of the gradient of a contact of two edges that comes from m to ``g``."""
    value, _, first, _ = _mollified(contact, pairs, touching, n, points)
    if first == 0.0:
        return
    by_u, by_v = parallel.slopes(points)
    for k in range(3):
        g[SIZE * touching.nodes[n, 0] + k] -= value * first * by_u[k]
        g[SIZE * touching.nodes[n, 1] + k] += value * first * by_u[k]
        g[SIZE * touching.nodes[n, 2] + k] -= value * first * by_v[k]
        g[SIZE * touching.nodes[n, 3] + k] += value * first * by_v[k]


@jit
def block(x, contact, pairs, touching, n, projected, K):
    """Write the Hessian of contact ``n`` of ``touching`` at ``x`` to ``K`` (12, 12); return the
    number of its nodes.

    Row and column 3 i + k: coordinate k of node touching.nodes[n, i]; of nodes beyond the number
    that is returned, rows and columns are zero. projected: positive semi-definite, without the
    negative parts of the terms of `geometry.space.derivatives.fill`.
    """
    points, share = corners(x, touching, n), shares(touching, n)
    i = touching.pair[n]
    slopes = derivatives.TRIANGLE if i == NO_PAIR else derivatives.EDGES
    slope, curvature = touching.slope[n], touching.curvature[n]
    normal = derivatives.fill(
        points, slopes, share, touching.free[n], curvature, slope, projected, K
    )
    if i != NO_PAIR and not projected:
        value, slope, first, second = _mollified(contact, pairs, touching, n, points)
        if first != 0.0:
            parallel.add(points, value * first, value * second, share, normal, slope * first, K)
    return touching.size[n]


@jit
def _against(x, contact, p, rest, platen, side):
    """Return energy (J), slope (N) and curvature (N/m) of node ``p`` against a platen, in its
    distance.

    rest: distance at rest, m; side: 1 for the lower platen, -1 for the upper one.
    """
    d = side * (x[SIZE * p + 2] - x[platen])
    dc = min(0.5 * contact.thickness[p], rest)
    if d >= dc:
        return 0.0, 0.0, 0.0
    return _law(contact, contact.area[p], dc, d)


@jit
def _platen(x, contact, nodes, rests, platen, side, g):
    """Return the energy of contact with one platen, J; add its gradient to ``g``."""
    total = 0.0
    for i in range(nodes.size):
        value, slope, _ = _against(x, contact, nodes[i], rests[i], platen, side)
        total += value
        g[SIZE * nodes[i] + 2] += side * slope
        g[platen] -= side * slope
    return total


@jit
def _platens(x, contact, g):
    """Return the energy of contact with platens, J; add its gradient to ``g``."""
    low = _platen(x, contact, contact.low_nodes, contact.low_rest, contact.low, 1.0, g)
    return low + _platen(x, contact, contact.high_nodes, contact.high_rest, contact.high, -1.0, g)


@jit
def platen_block(x, contact, upper, i):
    """Return (p, force, stiffness) of platen node ``i``: the node, the normal force on it in N, and
    the curvature k of its energy in the distance, N/m.

    upper: whether of the upper platen. The Hessian is k at (z_p, z_p) and at the platen's
    coordinate, and -k between them; it is positive semi-definite.
    """
    nodes, rests, platen, side = contact.low_nodes, contact.low_rest, contact.low, 1.0
    if upper:
        nodes, rests, platen, side = contact.high_nodes, contact.high_rest, contact.high, -1.0
    _, slope, curvature = _against(x, contact, nodes[i], rests[i], platen, side)
    return nodes[i], -slope, curvature


@jit_exact
def _limit_triangles(x, dx, far, contact, pairs, drift, most):
    """Return an admissible share of ``dx``, at most ``most``, for nodes and triangles."""
    for p in range(contact.area.size):
        at, move = point(x, p), point(dx, p)
        for q in range(pairs.start[p], pairs.start[p + 1]):
            if pairs.bound[q] >= 2.0 * (drift + far):
                break
            k = pairs.triangle[q]
            a, b, c = contact.triangles[k, 0], contact.triangles[k, 1], contact.triangles[k, 2]
            most = advancement.point_triangle(
                (at, point(x, a), point(x, b), point(x, c)),
                (move, point(dx, a), point(dx, b), point(dx, c)),
                most,
            )
    return most


@jit_exact
def _limit_edges(x, dx, far, contact, pairs, drift, most):
    """Return an admissible share of ``dx``, at most ``most``, for pairs of edges."""
    for i in range(edges_within(pairs, 2.0 * (drift + far))):
        one, two = pairs.one[i], pairs.two[i]
        a, b = contact.edges[one, 0], contact.edges[one, 1]
        c, d = contact.edges[two, 0], contact.edges[two, 1]
        most = advancement.edge_edge(
            (point(x, a), point(x, b), point(x, c), point(x, d)),
            (point(dx, a), point(dx, b), point(dx, c), point(dx, d)),
            most,
        )
    return most


@jit_exact
def _limit_platen(x, dx, nodes, platen, side, most):
    """Return an admissible share of ``dx``, at most ``most``, for nodes and a platen."""
    for p in nodes:
        closing = side * (dx[platen] - dx[SIZE * p + 2])
        if closing > 0.0:
            most = min(most, ADVANCE * side * (x[SIZE * p + 2] - x[platen]) / closing)
    return most


@jit_exact
def step_limit(x, dx, far, contact, pairs, drift):
    """Return the admissible share of the move ``dx``, at most 1: no surfaces cross or touch, and no
    node passes a platen.

    far: longest move of a node in ``dx``, m. drift: as in `detect`. At least `advancement.KEPT` of
    each distance is left; the pairs have to hold for the move.
    """
    most = _limit_platen(x, dx, contact.low_nodes, contact.low, 1.0, 1.0)
    most = _limit_platen(x, dx, contact.high_nodes, contact.high, -1.0, most)
    most = _limit_triangles(x, dx, far, contact, pairs, drift, most)
    return _limit_edges(x, dx, far, contact, pairs, drift, most)


@jit_exact
def _gap_to_platen(x, nodes, platen, side):
    """Return the smallest distance of ``nodes`` from a platen, m."""
    least = np.inf
    for p in nodes:
        least = min(least, side * (x[SIZE * p + 2] - x[platen]))
    return least


@jit_exact
def least_gap(x, contact, pairs, drift):
    """Return the smallest distance in m of nodes from middle surfaces and platens that they may
    touch, near parts of a wall left out; drift: `detect`.
    """
    least = min(
        _gap_to_platen(x, contact.low_nodes, contact.low, 1.0),
        _gap_to_platen(x, contact.high_nodes, contact.high, -1.0),
    )
    for p in range(contact.area.size):
        for q in range(pairs.start[p], pairs.start[p + 1]):
            if pairs.bound[q] - 2.0 * drift >= least:
                break
            if pairs.path[q] > 0.0:
                k = pairs.triangle[q]
                a, b, c = contact.triangles[k, 0], contact.triangles[k, 1], contact.triangles[k, 2]
                d2 = squared_to_triangle(point(x, p), point(x, a), point(x, b), point(x, c))
                least = min(least, d2**0.5)
    return least
