"""Contact of walls in space over their thickness, and with two platens, as a barrier on distance.

    E_c = 1/2 sum_p a_p sum_F w_pF phi(d(p, F)) + sum_p a_p phi(d(p, platen))
          + sum of pairs of edges a m phi(d)
    phi(d) = C Y' t_c b(d / t_c)

p: nodes with the tributary area a_p; F: triangles, sides and corners with the weights of `pairs`,
by which a surface counts once at any mesh; 1/2, as each pair of walls counts from both sides; t_c:
distance at which contact starts, at most the mean thickness, half of the thickness for a platen; b:
`barrier`. Two surfaces can cross along edges where all nodes are far. Contact of two edges, below
half of t_c, keeps them apart: a is the product of the widths of the strips that belong to them, so
that all edges together count about once, and m takes parallel edges out
(`geometry.space.parallel`).
"""

from typing import NamedTuple

import numpy as np

from kernels.compile.jit import jit, jit_exact
from kernels.geometry.space import derivatives, parallel, surface
from kernels.geometry.space.vectors import SIZE
from kernels.laws.barrier import phi
from kernels.plates.contacts.touching import NO_PAIR, corners, detect, shares

MOST_THICKENING = 1.5  # greatest contact thickness / thickness at rest: few walls become thicker


class Contact(NamedTuple):
    """Data of contact. Lengths in m, areas in m^2; an absent contact has empty arrays.

    stiffness: C Y', Pa. reach: largest distance at which contact starts. most_move: longest move of
    a node that neighbour lists cover. triangles (k, 3), edges (l, 2): nodes; sides (k, 3): edges
    ab, bc, ca of each triangle (`geometry.space.surface`); widths (l,): of the strips that belong
    to edges; own (l,): 1, or 0 for edges of images. area (n,): a_p of each node, 0 for images,
    which only own nodes touch. original (n,): the node itself or, for an image, its original, a
    period away. thickness (n,): at each node, which a problem may change between steps, up to
    ``reach`` (`plates.thickness`); rest_thickness (n,): at rest. rest (n, 3): positions at rest.
    low_nodes (i,), high_nodes (j,): nodes that may touch the lower and the upper platen; low_rest,
    high_rest: their distances from it at rest. low, high: coordinates of the platens.
    """

    stiffness: float
    reach: float
    most_move: float
    triangles: np.ndarray
    sides: np.ndarray
    edges: np.ndarray
    widths: np.ndarray
    own: np.ndarray
    area: np.ndarray
    original: np.ndarray
    thickness: np.ndarray
    rest_thickness: np.ndarray
    rest: np.ndarray
    low_nodes: np.ndarray
    low_rest: np.ndarray
    high_nodes: np.ndarray
    high_rest: np.ndarray
    low: int
    high: int


def build(stiffness, most_move, triangles, area, thickness, rest, low, high, original=None):
    """Return the `Contact` of a surface that may thicken up to `MOST_THICKENING` times.

    low, high: (nodes, distances at rest, coordinate) of the two platens. original: None without
    images. Others: as in `Contact`. Of an edge and its images one is own: the edge whose node with
    the lowest original is not an image.
    """
    if original is None:
        original = np.arange(area.size)
    edges, sides = surface.edges_of(triangles, area.size)
    widths = surface.widths(rest, triangles, edges, sides)
    one, two = edges.T
    first = np.where(original[one] < original[two], one, two)
    own = (original[first] == first).astype(np.float64)
    return Contact(
        stiffness, MOST_THICKENING * float(thickness.max()), most_move, triangles, sides, edges,
        widths, own, area, original, thickness.copy(), thickness, rest, low[0], low[1], high[0],
        high[1], low[2], high[2],
    )  # fmt: skip


@jit_exact
def is_absent(contact):
    """Return whether no wall touches another, and no node a platen."""
    return (
        contact.triangles.shape[0] == 0
        and contact.low_nodes.size == 0
        and contact.high_nodes.size == 0
    )


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
    value, slope, _ = phi(
        pairs.edge_area[i], contact.stiffness, pairs.edge_contact[i], touching.distance[n]
    )
    _, first, second = parallel.factor(points, pairs.edge_scale[i])
    return value, slope, first, second


@jit
def _push_apart(contact, pairs, touching, n, points, g):
    """Add to ``g`` the part of the gradient of a contact of two edges that comes from m."""
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
def block(x, contact, pairs, touching, n, K):
    """Write the Hessian of contact ``n`` of ``touching`` at ``x`` to ``K`` (12, 12); return the
    number of its nodes.

    Row and column 3 i + k: coordinate k of node touching.nodes[n, i]; rows and columns of further
    nodes are zero.
    """
    points, share = corners(x, touching, n), shares(touching, n)
    i = touching.pair[n]
    slopes = derivatives.TRIANGLE if i == NO_PAIR else derivatives.EDGES
    slope, curvature = touching.slope[n], touching.curvature[n]
    normal = derivatives.fill(points, slopes, share, touching.free[n], curvature, slope, K)
    if i != NO_PAIR:
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
    return phi(contact.area[p], contact.stiffness, dc, d)


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

    upper: whether the platen is the upper one. The Hessian is k at (z_p, z_p) and at the platen's
    coordinate, and -k between them; it is positive semi-definite.
    """
    nodes, rests, platen, side = contact.low_nodes, contact.low_rest, contact.low, 1.0
    if upper:
        nodes, rests, platen, side = contact.high_nodes, contact.high_rest, contact.high, -1.0
    _, slope, curvature = _against(x, contact, nodes[i], rests[i], platen, side)
    return nodes[i], -slope, curvature
