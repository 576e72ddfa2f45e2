"""Walls as chains of beam elements, and derivatives of energies in their deformations.

Element k joins two nodes, each with a position and a rotation phi. Its chord is e = l t, and n is t
rotated by 90 degrees anticlockwise. A rigid motion changes none of its three *deformations*

    l,   a_i = bearing of e - bearing at rest - phi_i,   i = 1, 2

(the natural deformations of a corotational beam; J. Argyris et al., 1979). For an energy
E(l, a_1, a_2) with N = dE/dl, M_i = dE/da_i and M = M_1 + M_2 the chain rule gives

    dE/de = N t + M n / l                  dE/dphi_i = -M_i
    d2E/de2 = E_ll t t + E_lb (t n + n t) / l + E_bb n n / l^2 + N n n / l - M (t n + n t) / l^2
    d2E/de dphi_i = -E_li t - E_bi n / l   d2E/dphi_i dphi_j = E_ij

with d/db = d/da_1 + d/da_2. An element couples its own two nodes only.
"""

import math
from typing import NamedTuple

import numpy as np

from kernels.arrays import zero_rows
from kernels.compile.jit import jit
from kernels.geometry.angle import between

NEAR_ENOUGH = 0.5  # rad
WHOLE = 2.0 * math.pi  # rad: a turn


class Walls(NamedTuple):
    """Topology. The elements of wall w, in their order along it, are start[w] .. start[w + 1].

    edges (m, 2): nodes. start (w + 1,). rest (m, 2): direction at rest. dofs (m, 6): coordinates
    x, y, phi of both ends.
    """

    edges: np.ndarray
    start: np.ndarray
    rest: np.ndarray
    dofs: np.ndarray


class Shape(NamedTuple):
    """Geometry of the elements, and sums over the terms.

    t (2, m), length (m,) in m, turn (2, m): a_1 and a_2 in rad. slope (4, m): sums of dE/de in N
    and of dE/dphi in N m.
    """

    t: np.ndarray
    length: np.ndarray
    turn: np.ndarray
    slope: np.ndarray


class Resultants(NamedTuple):
    """Derivatives of an energy in the deformations.

    force (3, m): N, M_1, M_2. rigidity (6, m): ll, l1, l2, 11, 12, 22.
    """

    force: np.ndarray
    rigidity: np.ndarray


class Stiffness(NamedTuple):
    """Second derivatives, summed over the terms: own (3, m) of e: xx, xy, yy; lean (4, m): of e and
    phi_1 x, y, of e and phi_2 x, y; twist (3, m): of phi 11, 12, 22.
    """

    own: np.ndarray
    lean: np.ndarray
    twist: np.ndarray


@jit
def renew_frame(x, walls, frame):
    """Update ``frame`` (m, 3): direction at rest of every element rotated with its ends (cos, sin),
    and the mean phi of its ends.

    Small angles from it take a short arctangent (`between`). A frame within `NEAR_ENOUGH` of the
    present phi is kept.
    """
    for k in range(frame.shape[0]):
        phi = 0.5 * (x[walls.dofs[k, 2]] + x[walls.dofs[k, 5]])
        if abs(phi - frame[k, 2]) < NEAR_ENOUGH:
            continue
        co, si = math.cos(phi), math.sin(phi)
        frame[k, 0] = co * walls.rest[k, 0] - si * walls.rest[k, 1]
        frame[k, 1] = si * walls.rest[k, 0] + co * walls.rest[k, 1]
        frame[k, 2] = phi


@jit
def measure(x, walls, frame, shape):
    """Fill directions, lengths and turns; return the shortest length in m.

    Whole turns of the chord are counted by the mean phi of its ends: (a_1 + a_2) / 2 is within
    [-pi, pi], however far an element has turned from its frame.
    """
    shortest = np.inf
    for k in range(shape.length.size):
        i, j = 2 * walls.edges[k, 0], 2 * walls.edges[k, 1]
        ex, ey = x[j] - x[i], x[j + 1] - x[i + 1]
        length = math.sqrt(ex * ex + ey * ey)
        shape.length[k] = length
        shape.t[0, k] = ex / length
        shape.t[1, k] = ey / length
        shortest = min(shortest, length)
    for k in range(shape.length.size):
        one, two = x[walls.dofs[k, 2]], x[walls.dofs[k, 5]]
        turned = between(frame[k, 0], frame[k, 1], shape.t[0, k], shape.t[1, k])
        turned += WHOLE * np.rint((0.5 * (one + two) - frame[k, 2] - turned) / WHOLE)
        shape.turn[0, k] = turned - (one - frame[k, 2])
        shape.turn[1, k] = turned - (two - frame[k, 2])
    return shortest


@jit
def clear(shape, stiffness):
    """Set the sums over the terms to zero."""
    zero_rows(shape.slope)
    zero_rows(stiffness.own)
    zero_rows(stiffness.lean)
    zero_rows(stiffness.twist)


@jit
def add(resultants, geometric, projected, shape, stiffness):
    """Add the derivatives of an energy by the chain rule.

    geometric: with N n n / l. projected: without second derivatives of the bearing, and with N n n
    / l in tension only; then a semi-definite ``rigidity`` yields a semi-definite Hessian.
    """
    force, rigidity = resultants.force, resultants.rigidity
    own, lean, twist, slope = stiffness.own, stiffness.lean, stiffness.twist, shape.slope
    curls = 0.0 if projected else 1.0
    for k in range(shape.length.size):
        tx, ty, by_length = shape.t[0, k], shape.t[1, k], 1.0 / shape.length[k]
        tension, moment = force[0, k], (force[1, k] + force[2, k]) * by_length
        slope[0, k] += tension * tx - moment * ty
        slope[1, k] += tension * ty + moment * tx
        slope[2, k] -= force[1, k]
        slope[3, k] -= force[2, k]
        b1 = (rigidity[3, k] + rigidity[4, k]) * by_length
        b2 = (rigidity[4, k] + rigidity[5, k]) * by_length
        across = max(tension, 0.0) if projected else tension
        nn = (b1 + b2) * by_length + (across * by_length if geometric else 0.0)
        tn = (rigidity[1, k] + rigidity[2, k] - curls * moment) * by_length
        tt = rigidity[0, k]
        own[0, k] += tt * tx * tx - 2.0 * tn * tx * ty + nn * ty * ty
        own[1, k] += (tt - nn) * tx * ty + tn * (tx * tx - ty * ty)
        own[2, k] += tt * ty * ty + 2.0 * tn * tx * ty + nn * tx * tx
        lean[0, k] += b1 * ty - rigidity[1, k] * tx
        lean[1, k] -= b1 * tx + rigidity[1, k] * ty
        lean[2, k] += b2 * ty - rigidity[2, k] * tx
        lean[3, k] -= b2 * tx + rigidity[2, k] * ty
        twist[0, k] += rigidity[3, k]
        twist[1, k] += rigidity[4, k]
        twist[2, k] += rigidity[5, k]


@jit
def gather(walls, shape, g):
    """Add the sums of slopes to the gradient ``g`` (n,) by coordinate."""
    dofs, slope = walls.dofs, shape.slope
    for k in range(shape.length.size):
        g[dofs[k, 0]] -= slope[0, k]
        g[dofs[k, 1]] -= slope[1, k]
        g[dofs[k, 2]] += slope[2, k]
        g[dofs[k, 3]] += slope[0, k]
        g[dofs[k, 4]] += slope[1, k]
        g[dofs[k, 5]] += slope[3, k]


@jit
def product(walls, stiffness, u, factor, shape):
    """Add ``factor`` K u to the slopes for a move ``u`` (n,); return u . K u."""
    own, lean, twist, slope = stiffness.own, stiffness.lean, stiffness.twist, shape.slope
    total = 0.0
    for k in range(shape.length.size):
        dofs = walls.dofs[k]
        ex, ey = u[dofs[3]] - u[dofs[0]], u[dofs[4]] - u[dofs[1]]
        phi, psi = u[dofs[2]], u[dofs[5]]
        px = own[0, k] * ex + own[1, k] * ey + lean[0, k] * phi + lean[2, k] * psi
        py = own[1, k] * ex + own[2, k] * ey + lean[1, k] * phi + lean[3, k] * psi
        m1 = lean[0, k] * ex + lean[1, k] * ey + twist[0, k] * phi + twist[1, k] * psi
        m2 = lean[2, k] * ex + lean[3, k] * ey + twist[1, k] * phi + twist[2, k] * psi
        slope[0, k] += factor * px
        slope[1, k] += factor * py
        slope[2, k] += factor * m1
        slope[3, k] += factor * m2
        total += px * ex + py * ey + m1 * phi + m2 * psi
    return total


@jit
def add_scaled(stiffness, other, factor):
    """Add ``factor`` x ``other`` to ``stiffness``."""
    for k in range(stiffness.own.shape[1]):
        for c in range(3):
            stiffness.own[c, k] += factor * other.own[c, k]
            stiffness.twist[c, k] += factor * other.twist[c, k]
        for c in range(4):
            stiffness.lean[c, k] += factor * other.lean[c, k]
