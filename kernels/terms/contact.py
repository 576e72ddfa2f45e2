"""Contact of walls over their thickness, and with two platens, as a barrier on distance.

    E_c = 1/2 sum_p l_p [ sum_e phi(d(p, e)) - sum_v (n_v - 1) phi(d(p, v)) ]
          + sum_p l_p phi(d(p, platen)) + E_p
    phi(d) = c Y' depth t_c b(d / t_c),   J/m

p: nodes with tributary length l_p; e: segments in reach; v: vertices shared by n_v of them; t_c:
distance at which contact starts, (t_p + t_e) / 2 with the thicknesses of node and segment, t_p / 2
at a platen; E_p: of profiles in place of platens (`terms.profile`); c: a number,
`contact.stiffness` in configs; Y': modulus in stretching, Pa; depth: of the lattice, m; b:
`barrier`. Rules for pairs near joints replace l_p and t_c (`contact_near_joints`). With the
subtraction a straight wall counts once with any mesh; the factor is 1/2, as each pair of walls
counts from both sides.
"""

from typing import NamedTuple

import numpy as np

from kernels.arrays import pair
from kernels.compile.jit import jit, jit_exact, jit_owning
from kernels.geometry import ccd
from kernels.geometry.distance import (
    closest,
    direction,
    normal,
    push,
    push_point,
    push_point_stiffen,
    push_stiffen,
    squared_distance,
)
from kernels.geometry.near_pairs import counted, is_guarded, within
from kernels.geometry.profile import Profiles
from kernels.laws.barrier import CLOSEST, phi
from kernels.linear.condensed.block_matrix import add
from kernels.terms import profile


class Contact(NamedTuple):
    """Data of contact. Lengths in m; an absent contact has empty arrays.

    stiffness: c Y' depth, N/m. reach: largest contact distance. most_move: longest move of a node
    that neighbour lists cover. edges (m, 2). tributary (n,): l_p. node_thickness (n,),
    edge_thickness (m,). subtract (m, 2): 1 for ends that another segment counts. special_*: rules
    of pairs near a joint or near at rest, by edge (start (m + 1,)): node, weight, contact distance,
    subtract. A pair of weight 0 is only kept from crossing, with the whole tributary length; at a
    distance of 0, by collision detection alone. platen_nodes (k,): nodes that may touch a platen.
    low, high: coordinates of the surfaces of the lower and the upper platen. profiles: profiles in
    place of a platen. low_away, high_away: how far a platen is beyond its coordinate: 0, or
    infinite where a profile is in its place.
    """

    stiffness: float
    reach: float
    most_move: float
    edges: np.ndarray
    tributary: np.ndarray
    node_thickness: np.ndarray
    edge_thickness: np.ndarray
    subtract: np.ndarray
    special_start: np.ndarray
    special_node: np.ndarray
    special_weight: np.ndarray
    special_distance: np.ndarray
    special_subtract: np.ndarray
    platen_nodes: np.ndarray
    low: int
    high: int
    profiles: Profiles
    low_away: float
    high_away: float


class Touching(NamedTuple):
    """Active contacts at one position, filled by `detect`: the first ``count`` (1,) entries.

    pair (n,): number of the pair in `Pairs`. tau (n,): position on its segment, 0 .. 1. end (n,): 0
    or 1 for the subtracted contribution of a vertex that another segment counts too, else -1.
    weight (n,): contact length, m, negative if subtracted. distance (n,): m.
    """

    pair: np.ndarray
    tau: np.ndarray
    end: np.ndarray
    weight: np.ndarray
    distance: np.ndarray
    count: np.ndarray


@jit_owning
def no_contacts(pairs):
    """Return an empty `Touching` with room for three contacts of each pair."""
    far = 3 * pairs.node.size
    return Touching(
        np.empty(far, np.int64), np.empty(far), np.empty(far, np.int64), np.empty(far),
        np.empty(far), np.zeros(1, np.int64),
    )  # fmt: skip


@jit
def _add_contact(touching, k, tau, end, weight, distance):
    """Append a contact of pair ``k``."""
    n = touching.count[0]
    touching.pair[n], touching.tau[n], touching.end[n] = k, tau, end
    touching.weight[n], touching.distance[n] = weight, distance
    touching.count[0] = n + 1


@jit
def detect(x, contact, pairs, drift, touching):
    """Fill ``touching`` with all active contacts at ``x``; return whether none is `CLOSEST`.

    drift: longest move of a node since the pairs were listed, m. A contribution of a vertex that is
    the closest point and is subtracted again is left out.
    """
    touching.count[0], apart = 0, True
    for k in range(within(pairs, contact.reach + 2.0 * drift)):
        p, dc = pairs.node[k], pairs.d_contact[k]
        if pairs.distance[k] >= dc + 2.0 * drift:
            continue
        a, b = pair(contact.edges, pairs.edge[k])
        if squared_distance(x, p, a, b) >= dc * dc:
            continue
        tau, inside = closest(x, p, a, b)
        _, _, d = normal(x, p, a, b, tau)
        if d <= CLOSEST * dc:  # at a vertex the subtracted contribution is infinite too
            apart = False
            continue
        length, first, second = counted(pairs, k, contact)
        nearest = -1 if inside else (0 if tau == 0.0 else 1)
        if nearest < 0 or (first, second)[nearest] == 0.0:
            nearest = -1
            _add_contact(touching, k, tau, -1, 0.5 * length, d)
        for end, v, subtracted in ((0, a, first), (1, b, second)):
            if subtracted != 0.0 and end != nearest:
                _, _, d = direction(x, v, p)
                if d < dc:
                    _add_contact(touching, k, float(end), end, -0.5 * length, d)
    return apart


@jit
def _segment_distance(x, p, a, b):
    tau, _ = closest(x, p, a, b)
    _, _, d = normal(x, p, a, b, tau)
    return d


@jit
def evaluate(x, contact, pairs, drift, touching, g):
    """Return E_c in J, infinite at a distance of zero; add dE_c/dx to ``g`` (n,).

    Fill ``touching``. drift: as in `detect`.
    """
    total = _platens(x, contact, g)
    total += profile.evaluate(x, contact.profiles, contact.stiffness, g)
    if not detect(x, contact, pairs, drift, touching):
        return np.inf
    for n in range(touching.count[0]):
        k, end = touching.pair[n], touching.end[n]
        p, dc = pairs.node[k], pairs.d_contact[k]
        a, b = pair(contact.edges, pairs.edge[k])
        value, slope, _ = phi(touching.weight[n], contact.stiffness, dc, touching.distance[n])
        total += value
        if end < 0:
            push(g, x, p, a, b, slope)
        else:
            push_point(g, x, p, a if end == 0 else b, slope)
    return total


@jit
def hessian(x, contact, pairs, touching, matrix):
    """Add d2E_c/dx2 at ``x`` of the contacts in ``touching``."""
    _platens_hessian(x, contact, matrix)
    profile.hessian(x, contact.profiles, contact.stiffness, matrix)
    for n in range(touching.count[0]):
        k, end = touching.pair[n], touching.end[n]
        p, dc = pairs.node[k], pairs.d_contact[k]
        a, b = pair(contact.edges, pairs.edge[k])
        _, slope, curvature = phi(touching.weight[n], contact.stiffness, dc, touching.distance[n])
        if end < 0:
            push_stiffen(matrix, x, p, a, b, curvature, slope)
        else:
            push_point_stiffen(matrix, x, p, a if end == 0 else b, curvature, slope)


@jit
def normal_force(contact, pairs, touching, n):
    """Return the normal force of contact ``n`` in N: positive in compression, negative for a
    subtracted contribution.
    """
    d_contact = pairs.d_contact[touching.pair[n]]
    _, slope, _ = phi(touching.weight[n], contact.stiffness, d_contact, touching.distance[n])
    return -slope


@jit
def platen_force(contact, p, d):
    """Return the normal force of a platen on node ``p`` at a distance ``d`` (m), N."""
    d_contact = 0.5 * contact.node_thickness[p]
    if d >= d_contact:
        return 0.0
    _, slope, _ = phi(contact.tributary[p], contact.stiffness, d_contact, d)
    return -slope


@jit
def platens_of(contact):
    """Return, for each platen, its coordinate, the side on which walls are, and its `low_away` or
    `high_away`.
    """
    return (contact.low, 1.0, contact.low_away), (contact.high, -1.0, contact.high_away)


@jit
def _platens(x, contact, g):
    """Return the energy of contact with platens, J; add its gradient to ``g``."""
    total = 0.0
    for p in contact.platen_nodes:
        dc, y = 0.5 * contact.node_thickness[p], x[2 * p + 1]
        for platen, side, away in platens_of(contact):
            d = side * (y - x[platen]) + away
            if d < dc:
                value, slope, _ = phi(contact.tributary[p], contact.stiffness, dc, d)
                total += value
                g[2 * p + 1] += side * slope
                g[platen] -= side * slope
    return total


@jit
def _platens_hessian(x, contact, matrix):
    """Add the Hessian of contact with platens, which is positive semi-definite."""
    for p in contact.platen_nodes:
        dc, y = 0.5 * contact.node_thickness[p], x[2 * p + 1]
        for platen, side, away in platens_of(contact):
            d = side * (y - x[platen]) + away
            if d < dc:
                _, _, curvature = phi(contact.tributary[p], contact.stiffness, dc, d)
                add(matrix, 2 * p + 1, 2 * p + 1, curvature)
                add(matrix, platen, platen, curvature)
                add(matrix, platen, 2 * p + 1, -curvature)


@jit_exact
def step_limit(x, dx, far, contact, pairs, drift):
    """Return the first share of the move ``dx`` at which a node meets a segment or a platen.

    far: longest move of a node in ``dx``, m. drift: as in `detect`.
    """
    first = np.inf
    for k in range(within(pairs, 2.0 * (drift + far))):
        a, b = pair(contact.edges, pairs.edge[k])
        first = min(first, ccd.first_contact(x, dx, pairs.node[k], a, b))
    for p in contact.platen_nodes:
        for platen, side, away in platens_of(contact):
            closing = side * (dx[platen] - dx[2 * p + 1])
            if closing > 0.0:
                first = min(first, (side * (x[2 * p + 1] - x[platen]) + away) / closing)
    return first


@jit_exact
def least_gap(x, contact, pairs, drift):
    """Return the smallest distance in m between centre lines that may touch; drift: `detect`."""
    least = np.inf
    for k in range(pairs.node.size):
        if pairs.distance[k] - 2.0 * drift >= least:
            break  # pairs are listed by ascending distance
        if pairs.d_contact[k] > 0.0 and not is_guarded(pairs, k, contact):
            a, b = pair(contact.edges, pairs.edge[k])
            least = min(least, _segment_distance(x, pairs.node[k], a, b))
    for p in contact.platen_nodes:
        for platen, side, away in platens_of(contact):
            least = min(least, side * (x[2 * p + 1] - x[platen]) + away)
    return min(least, profile.least_gap(x, contact.profiles))
