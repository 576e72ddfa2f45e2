"""How far a move may go: no wall crosses another or touches it, and no node passes a platen."""

import numpy as np

from kernels.compile.jit import jit_exact
from kernels.geometry.space import advancement
from kernels.geometry.space.closest import squared_to_triangle
from kernels.geometry.space.vectors import SIZE, point
from kernels.plates.contacts.pairs import edges_within
from kernels.shared.moves import ADVANCE


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
    """Return the share of the move ``dx``, at most 1, up to which no surfaces cross or touch, and
    no node passes a platen.

    far: longest move of a node in ``dx``, m. drift: as in `detect`. At least `advancement.KEPT` of
    each distance is left; the pairs must be valid for the move.
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
    touch, without near parts of a wall; drift: `detect`.
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
