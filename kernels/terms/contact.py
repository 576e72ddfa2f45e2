"""Contact of walls over their thickness, and with two platens, as a barrier on distance.

    E_c = 1/2 sum_p l_p [ sum_e phi(d(p, e)) - sum_v (n_v - 1) phi(d(p, v)) ]
          + sum_p l_p phi(d(p, platen))
    phi(d) = c Y' depth t_c b(d / t_c)

The subtraction lets a straight wall count once at any mesh; 1/2 because each pair of walls is seen
from both sides. (Signs of the barrier as in `barrier`.)
"""

from typing import NamedTuple

import numpy as np

from kernels.geometry import ccd
from kernels.terms.barrier import barrier
from kernels.geometry.distance import (
    closest,
    direction,
    normal,
    push,
    push_point,
    push_point_stiffen,
    push_stiffen,
)
from kernels.linear.block_matrix import add
from kernels.compile.jit import jit, jit_exact
from kernels.geometry.near_pairs import counted, within
from kernels.arrays import pair


class Contact(NamedTuple):
    """What may touch. Lengths in m; an absent contact has empty arrays.

    stiffness: c Y' depth, N/m. reach: largest contact distance. edges (m, 2). tributary (n,): l_p.
    node_thickness (n,), edge_thickness (m,). subtract (m, 2): ends counted by another segment.
    special_*: pairs near a joint or near at rest, by edge (start (m + 1,)): node, weight, distance
    of contact, subtract. plate_nodes (k,): nodes that may touch a platen. low, high: coordinates
    of the surfaces of the lower and the upper platen.
    """

    stiffness: float
    reach: float
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
    plate_nodes: np.ndarray
    low: int
    high: int


@jit
def _law(contact, weight, d_contact, d):
    """Return weight * phi(d) and its first two derivatives in d."""
    value, slope, curvature = barrier(d / d_contact)
    scale = weight * contact.stiffness
    return scale * d_contact * value, scale * slope, scale / d_contact * curvature


@jit
def cancelled(tau, inside, first, second):
    """Return which end (0, 1) of a segment is closest and taken off again; -1 if none is.

    first, second: as `pairs.counted` returns them.
    """
    end = 0 if tau == 0.0 else 1
    return -1 if inside or (first, second)[end] == 0.0 else end


@jit
def _segment_distance(x, p, a, b):
    tau, _ = closest(x, p, a, b)
    _, _, d = normal(x, p, a, b, tau)
    return d


@jit
def evaluate(x, contact, pairs, drift, g):
    """Return E_c in J, infinite where anything touches at distance zero; add dE_c/dx to ``g``.

    ``drift``: farthest move in m of a node since the pairs were listed. Those in contact are noted
    in ``pairs.touching``, their number in ``pairs.count``.
    """
    total = _plates(x, contact, g)
    pairs.count[0] = 0
    for k in range(within(pairs, contact.reach + 2.0 * drift)):
        p, dc = pairs.node[k], pairs.d_contact[k]
        if dc == 0.0:
            continue
        a, b = pair(contact.edges, pairs.edge[k])
        tau, inside = closest(x, p, a, b)
        _, _, d = normal(x, p, a, b, tau)
        if d >= dc:
            continue
        if d == 0.0:  # at a vertex what is taken off is infinite too
            return np.inf
        pairs.touching[pairs.count[0]] = k
        pairs.count[0] += 1
        length, first, second = counted(pairs, k, contact)
        weight, off = 0.5 * length, cancelled(tau, inside, first, second)
        if off < 0:
            value, slope, _ = _law(contact, weight, dc, d)
            total += value
            push(g, x, p, a, b, slope)
        for side, v, elsewhere in ((0, a, first), (1, b, second)):
            if elsewhere != 0.0 and side != off:
                _, _, dv = direction(x, v, p)
                if dv < dc:
                    value, slope, _ = _law(contact, weight, dc, dv)
                    total -= value
                    push_point(g, x, p, v, -slope)
    return total


@jit
def hessian(x, contact, pairs, matrix, projected):
    """Add d2E_c/dx2 of what touched in `evaluate`; ``projected`` keeps each pair's convex part."""
    _plates_hessian(x, contact, matrix)
    for n in range(pairs.count[0]):
        k = pairs.touching[n]
        p, dc = pairs.node[k], pairs.d_contact[k]
        a, b = pair(contact.edges, pairs.edge[k])
        tau, inside = closest(x, p, a, b)
        _, _, d = normal(x, p, a, b, tau)
        length, first, second = counted(pairs, k, contact)
        weight, off = 0.5 * length, cancelled(tau, inside, first, second)
        if off < 0:
            _, slope, curvature = _law(contact, weight, dc, d)
            push_stiffen(matrix, x, p, a, b, curvature, 0.0 if projected else slope)
        if projected:
            continue
        for side, v, elsewhere in ((0, a, first), (1, b, second)):
            if elsewhere != 0.0 and side != off:
                _, _, dv = direction(x, v, p)
                if dv < dc:
                    _, slope, curvature = _law(contact, weight, dc, dv)
                    push_point_stiffen(matrix, x, p, v, -curvature, -slope)


@jit
def _plates(x, contact, g):
    total = 0.0
    for p in contact.plate_nodes:
        dc, y = 0.5 * contact.node_thickness[p], x[2 * p + 1]
        for plate, side in ((contact.low, 1.0), (contact.high, -1.0)):
            d = side * (y - x[plate])
            if d < dc:
                value, slope, _ = _law(contact, contact.tributary[p], dc, d)
                total += value
                g[2 * p + 1] += side * slope
                g[plate] -= side * slope
    return total


@jit
def _plates_hessian(x, contact, matrix):
    for p in contact.plate_nodes:
        dc, y = 0.5 * contact.node_thickness[p], x[2 * p + 1]
        for plate, side in ((contact.low, 1.0), (contact.high, -1.0)):
            d = side * (y - x[plate])
            if d < dc:
                _, _, curvature = _law(contact, contact.tributary[p], dc, d)
                add(matrix, 2 * p + 1, 2 * p + 1, curvature)
                add(matrix, plate, plate, curvature)
                add(matrix, plate, 2 * p + 1, -curvature)


@jit_exact
def step_limit(x, dx, most, contact, pairs, drift):
    """Return the first share of the step ``dx`` at which a node meets a segment or a platen.

    ``most``: farthest move in m of a node in the step.
    """
    first = np.inf
    for k in range(within(pairs, 2.0 * (drift + most))):
        a, b = pair(contact.edges, pairs.edge[k])
        first = min(first, ccd.first_contact(x, dx, pairs.node[k], a, b))
    for p in contact.plate_nodes:
        for plate, side in ((contact.low, 1.0), (contact.high, -1.0)):
            closing = side * (dx[plate] - dx[2 * p + 1])
            if closing > 0.0:
                first = min(first, side * (x[2 * p + 1] - x[plate]) / closing)
    return first


@jit_exact
def least_gap(x, contact, pairs, drift):
    """Return the smallest distance in m between lines that may touch, over the pairs in reach."""
    least = np.inf
    for k in range(pairs.node.size):
        if pairs.distance[k] - 2.0 * drift >= least:
            break  # all others are farther away
        if pairs.d_contact[k] > 0.0:
            a, b = pair(contact.edges, pairs.edge[k])
            least = min(least, _segment_distance(x, pairs.node[k], a, b))
    for p in contact.plate_nodes:
        y = x[2 * p + 1]
        least = min(least, y - x[contact.low], x[contact.high] - y)
    return least
