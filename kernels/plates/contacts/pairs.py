"""Near pairs of wall surfaces: which may touch, where their contact starts, and with which weight.

*Counted once.* A node p sees the triangles T that it may touch. The sum of phi(d(p, T)) would count
a side or a corner once for every triangle that shares it. Sides E and corners V therefore have
weights such that each counts once together with all that contains it (inclusion and exclusion):

    w(T) = 1,   w(E) = 1 - n_T(E),   w(V) = 1 - n_T(V) - sum of w(E) over the sides at V

n_T: number of triangles seen by p that share E or V. In a flat sheet w(E) = -1 and w(V) = 1; at a
free edge w(E) = w(V) = 0; where k walls meet along a line w(E) = 1 - k. The sum is the number of
pieces of surface within a distance, whatever the mesh: with B the ball round p of radius r, the
Euler characteristic of the union of the triangles that meet B, integrated over r by phi'. A
junction of walls counts once, and walls in front of p and behind it count both.

*Parts that touch must have been apart.* As in `kernels.terms.contact_near_joints`, walls can fold
upon themselves only at parts that are farther than pi t / 2 apart, t the mean thickness. Where
walls meet at an angle, s is the straight distance at rest, not the path along the walls. Contact
starts at

    t_c = t s / sqrt(s^2 + t^2)   for s < 5 t,   t beyond,

s the distance of p from T at rest. t_c is less than s, so that the rest state is free of stress,
and less than the distance t sin(s / t) of two points of a wall that is bent to its limit 2 / t, up
to s = 2 t. A triangle whose centre is nearer to p at rest than pi t / 2 is not in contact with it.
Crossing has to be prevented there too, where a wall is creased or crushed, and a step limit alone
would stop a search: for such near parts contact starts at `NEAR_SHARE` t_c.

*Images.* A surface that repeats is surrounded by copies of its triangles. Nodes that are images see
nothing; if one of two edges is an image, both copies of the pair are listed, with half the weight.

t_c of a side or a corner is the least t_c of the triangles seen that share it: where t_c differs
between triangles, the one with the largest contribution counts.
"""

import math
from typing import NamedTuple

import numpy as np

from kernels.arrays import first_at_least, grouped, triple
from kernels.compile.jit import jit_exact, jit_owning
from kernels.geometry.space import near
from kernels.geometry.space.closest import (
    squared_between_edges,
    squared_to_edge,
    squared_to_triangle,
)
from kernels.geometry.space.parallel import SINE2
from kernels.geometry.space.vectors import inner, length, minus, point, row
from kernels.terms.contact_near_joints import FAR

LEAST_PATH = 0.5 * math.pi  # least distance at rest of parts that may touch, in units of t
NEAR_SHARE = 0.3  # share of t_c at which contact of near parts starts; walls can be crushed to it
EDGE_SHARE = 0.5  # share of t_c at which contact of two edges starts
SHELLS = 64  # number of classes of distance into which pairs of edges are sorted


class Pairs(NamedTuple):
    """Pairs of a node and a triangle, a side or a corner, and of two edges, without common node.

    Pairs start[p] .. start[p + 1] belong to node p: triangle (k,), bound (k,): distance when they
    were listed, m, ascending for each node; path (k,): s of the module's docstring, m, negative for
    near parts; d_contact (k,): distance at which contact starts, m, 0 for parts that are not apart
    at rest.

    lower_start (n + 1,), lower (j,): corners by node, sides by n + edge; lower_weight, lower_bound
    and lower_contact (j,): weight, distance when listed and distance at which contact starts;
    lower_triangle (j,): a triangle that contains it.

    one, two (i,): edges; edge_bound (i,): lower bound of their distance when listed, ascending;
    edge_path (i,): s, m, negative as above; edge_contact (i,): distance at which contact starts, m;
    edge_area (i,): weight, m^2; edge_scale (i,): e of `geometry.space.parallel`, m^4.
    """

    start: np.ndarray
    triangle: np.ndarray
    bound: np.ndarray
    path: np.ndarray
    d_contact: np.ndarray
    lower_start: np.ndarray
    lower: np.ndarray
    lower_weight: np.ndarray
    lower_bound: np.ndarray
    lower_contact: np.ndarray
    lower_triangle: np.ndarray
    one: np.ndarray
    two: np.ndarray
    edge_bound: np.ndarray
    edge_path: np.ndarray
    edge_contact: np.ndarray
    edge_area: np.ndarray
    edge_scale: np.ndarray


@jit_exact
def starts_at(path, t):
    """Return the distance at which contact starts, m. path: distance at rest, m, negative for near
    parts.
    """
    share = NEAR_SHARE if path < 0.0 else 1.0
    s = abs(path)
    return share * (t if s >= FAR * t else t * s / math.hypot(s, t))


@jit_exact
def _thickness(contact, thickness, p, k):
    """Return the mean thickness of node ``p`` and triangle ``k``, m."""
    a, b, c = triple(contact.triangles, k)
    return 0.5 * (thickness[p] + (thickness[a] + thickness[b] + thickness[c]) / 3.0)


@jit_exact
def _edge_thickness(contact, thickness, one, two):
    """Return the mean thickness of two edges, m."""
    total = 0.0
    for i in range(2):
        total += thickness[contact.edges[one, i]] + thickness[contact.edges[two, i]]
    return 0.25 * total


@jit_exact
def _path(contact, p, k):
    """Return s of node ``p`` and triangle ``k``, m, negative if they are near."""
    at = row(contact.rest, p)
    a, b, c = triple(contact.triangles, k)
    one, two, three = row(contact.rest, a), row(contact.rest, b), row(contact.rest, c)
    centre = (
        (one[0] + two[0] + three[0]) / 3.0,
        (one[1] + two[1] + three[1]) / 3.0,
        (one[2] + two[2] + three[2]) / 3.0,
    )
    least = LEAST_PATH * _thickness(contact, contact.rest_thickness, p, k)
    path = math.sqrt(squared_to_triangle(at, one, two, three))
    return -path if length(minus(centre, at)) < least else path


@jit_exact
def _middle(points, a, b):
    """Return the point half way between two of ``points`` (n, 3)."""
    return (
        0.5 * (points[a, 0] + points[b, 0]),
        0.5 * (points[a, 1] + points[b, 1]),
        0.5 * (points[a, 2] + points[b, 2]),
    )


@jit_exact
def _edge_path(contact, one, two):
    """Return s of two edges, m, negative if they are near."""
    a, b = contact.edges[one, 0], contact.edges[one, 1]
    c, d = contact.edges[two, 0], contact.edges[two, 1]
    rest = contact.rest
    path = math.sqrt(squared_between_edges(row(rest, a), row(rest, b), row(rest, c), row(rest, d)))
    apart = length(minus(_middle(rest, a, b), _middle(rest, c, d)))
    least = LEAST_PATH * _edge_thickness(contact, contact.rest_thickness, one, two)
    return -path if apart < least else path


@jit_exact
def _sort(first, last, triangle, bound):
    """Sort the pairs ``first`` .. ``last`` (exclusive) by ascending ``bound``."""
    for k in range(first + 1, last):
        value, moved, at = bound[k], triangle[k], k
        while at > first and bound[at - 1] > value:
            bound[at], triangle[at] = bound[at - 1], triangle[at - 1]
            at -= 1
        bound[at], triangle[at] = value, moved


@jit_exact
def _feature(contact, k, i):
    """Return the number of corner (``i`` < 3) or side ``i`` - 3 of triangle ``k``."""
    if i < 3:
        return contact.triangles[k, i]
    return contact.area.size + contact.sides[k, i - 3]


@jit_exact
def _weigh(contact, seen, p, weight, owner, listed):
    """Write w of the sides and corners that node ``p`` sees to ``weight``; return their number.

    seen: start, triangle and path of `Pairs`. ``owner``: -1 for features not listed yet, else a
    triangle; ``listed``: the numbers of the listed features.
    """
    n_nodes, count = contact.area.size, 0
    start, triangle, path = seen
    for q in range(start[p], start[p + 1]):
        if path[q] != 0.0:
            k = triangle[q]
            for i in range(6):
                f = _feature(contact, k, i)
                if owner[f] < 0:
                    owner[f], weight[f], listed[count] = k, 1.0, f
                    count += 1
                weight[f] -= 1.0
    for j in range(count):
        if listed[j] >= n_nodes:
            for i in range(2):
                weight[contact.edges[listed[j] - n_nodes, i]] -= weight[listed[j]]
    return count


@jit_exact
def _lower_distance(x, contact, p, f):
    """Return the distance of node ``p`` from a corner or side, m."""
    at, n_nodes = point(x, p), contact.area.size
    if f < n_nodes:
        return length(minus(at, point(x, f)))
    a, b = contact.edges[f - n_nodes, 0], contact.edges[f - n_nodes, 1]
    return math.sqrt(squared_to_edge(at, point(x, a), point(x, b)))


@jit_owning
def _lower(x, contact, seen):
    """Return lower_start, lower, lower_weight, lower_bound, lower_triangle of `Pairs`.

    seen: start, triangle and path.
    """
    n_nodes = contact.area.size
    size = n_nodes + contact.edges.shape[0]
    weight, owner = np.empty(size), np.full(size, -1)
    listed, start = np.empty(size, np.int64), np.zeros(n_nodes + 1, np.int64)
    lower, weights = np.empty(64, np.int64), np.empty(64)
    bound, triangle = np.empty(64), np.empty(64, np.int64)
    count = 0
    for p in range(n_nodes):
        n = _weigh(contact, seen, p, weight, owner, listed)
        if count + n > lower.size:
            larger = 2 * (count + n)
            lower, weights = near.grown(lower, larger), near.grown(weights, larger)
            bound, triangle = near.grown(bound, larger), near.grown(triangle, larger)
        for j in range(n):
            f = listed[j]
            if weight[f] != 0.0:
                lower[count], weights[count], triangle[count] = f, weight[f], owner[f]
                bound[count] = _lower_distance(x, contact, p, f)
                count += 1
            owner[f] = -1
        start[p + 1] = count
    return start, lower[:count], weights[:count], bound[:count], triangle[:count]


@jit_owning
def _seen(x, contact, radius):
    """Return start, triangle, bound and path of `Pairs` closer than ``radius`` (m) at ``x``."""
    n_nodes = contact.area.size
    node, triangles, distance = near.node_triangle(
        x, n_nodes, contact.original, contact.triangles, radius
    )
    start, order = grouped(node, n_nodes)
    triangle, bound, path = np.empty(node.size, np.int64), np.empty(node.size), np.empty(node.size)
    for q in range(node.size):
        triangle[q], bound[q] = triangles[order[q]], distance[order[q]]
    for p in range(n_nodes):
        _sort(start[p], start[p + 1], triangle, bound)
        for q in range(start[p], start[p + 1]):
            path[q] = _path(contact, p, triangle[q])
    return start, triangle, bound, path


@jit_exact
def _squared_rest_length(contact, e):
    """Return the squared length of edge ``e`` at rest, m^2."""
    a, b = contact.edges[e, 0], contact.edges[e, 1]
    u = minus(row(contact.rest, b), row(contact.rest, a))
    return inner(u, u)


@jit_owning
def _of_edges(x, contact, radius):
    """Return one, two, edge_bound, edge_path, edge_area, edge_scale of `Pairs`.

    radius: largest distance of the pairs at ``x``, m.
    """
    first, second, distance = near.edge_edge(x, contact.edges, contact.own, radius)
    n = first.size
    shell = np.empty(n, np.int64)
    for i in range(n):
        shell[i] = min(int(distance[i] / radius * SHELLS), SHELLS - 1)
    _, order = grouped(shell, SHELLS)
    one, two, bound = np.empty(n, np.int64), np.empty(n, np.int64), np.empty(n)
    path, areas, scale = np.empty(n), np.empty(n), np.empty(n)
    for i in range(n):
        q = order[i]
        a, b = first[q], second[q]
        one[i], two[i], bound[i] = a, b, shell[q] * radius / SHELLS
        path[i], areas[i] = _edge_path(contact, a, b), contact.widths[a] * contact.widths[b]
        areas[i] *= 0.5 * (contact.own[a] + contact.own[b])
        scale[i] = SINE2 * _squared_rest_length(contact, a) * _squared_rest_length(contact, b)
    return one, two, bound, path, areas, scale


@jit_owning
def find(x, contact, radius):
    """Return the `Pairs` of ``contact`` closer than ``radius`` (m) at ``x``."""
    start, triangle, bound, path = _seen(x, contact, radius)
    below, lower, weight, lower_bound, owner = _lower(x, contact, (start, triangle, path))
    edges = _of_edges(x, contact, radius - (1.0 - EDGE_SHARE) * contact.reach)
    one, two, edge_bound, edge_path, areas, scale = edges
    pairs = Pairs(
        start, triangle, bound, path, np.zeros(bound.size), below, lower, weight, lower_bound,
        np.zeros(lower.size), owner, one, two, edge_bound, edge_path, np.zeros(one.size), areas,
        scale,
    )  # fmt: skip
    renew_distances(contact, pairs)
    return pairs


@jit_owning
def renew_distances(contact, pairs):
    """Write the distances at which contact starts, for the present ``contact.thickness``.

    Call it after every change of the thickness; ``contact.reach`` must be at least the largest
    thickness.
    """
    least = np.full(contact.area.size + contact.edges.shape[0], np.inf)
    for p in range(contact.area.size):
        for q in range(pairs.start[p], pairs.start[p + 1]):
            k = pairs.triangle[q]
            t = _thickness(contact, contact.thickness, p, k)
            pairs.d_contact[q] = starts_at(pairs.path[q], t)
            if pairs.path[q] != 0.0:
                for i in range(6):
                    f = _feature(contact, k, i)
                    least[f] = min(least[f], pairs.d_contact[q])
        for j in range(pairs.lower_start[p], pairs.lower_start[p + 1]):
            pairs.lower_contact[j] = least[pairs.lower[j]]
        for q in range(pairs.start[p], pairs.start[p + 1]):
            for i in range(6):
                least[_feature(contact, pairs.triangle[q], i)] = np.inf
    for i in range(pairs.one.size):
        t = _edge_thickness(contact, contact.thickness, pairs.one[i], pairs.two[i])
        pairs.edge_contact[i] = EDGE_SHARE * starts_at(pairs.edge_path[i], t)


@jit_exact
def edges_within(pairs, radius):
    """Return the number of pairs of edges, the first ones listed, that may be nearer than
    ``radius``.
    """
    return first_at_least(pairs.edge_bound, radius, 0, pairs.edge_bound.size)
