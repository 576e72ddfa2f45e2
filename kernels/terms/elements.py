"""Walls as chains of straight elements, and derivatives of energies in the element vectors.

Element k has the vector e_k = l t; n is t rotated by 90 degrees anticlockwise. Stretching and
bending of a wall depend only on the vectors of its elements and the rotations phi of its two
joints, and a hinge couples neighbouring elements only:

    slope_k = dE/de_k    own_k = d2E/de_k de_k    next_k = d2E/de_k de_{k+1}
    moment_a = -dE/dphi_a    arm_a = (d2E/dphi_a de, d2E/dphi_a dphi_a)    twist = d2E/dphi_a dphi_b
"""

from typing import NamedTuple

import numpy as np

from kernels.arrays import zero, zero_rows
from kernels.compile.jit import jit


class Walls(NamedTuple):
    """Topology. The elements of wall w, in their order along it, are start[w] .. start[w + 1].

    edges (m, 2): nodes. start (w + 1,). arm_element, rotation (2 w,): the element at each end of
    each wall (its arms 2 w and 2 w + 1), and the coordinate of the rotation of the joint there.
    """

    edges: np.ndarray
    start: np.ndarray
    arm_element: np.ndarray
    rotation: np.ndarray


class Shape(NamedTuple):
    """Geometry of the elements, and sums of derivatives over the terms.

    t (2, m), length (m,) in m. Turns from rest in rad: hinge_turn (m,) between an element and the
    next, arm_turn (2 w,). Sums: slope (2, m) in N, moment (2 w,) in N m.
    """

    t: np.ndarray
    length: np.ndarray
    hinge_turn: np.ndarray
    arm_turn: np.ndarray
    slope: np.ndarray
    moment: np.ndarray


class Stiffness(NamedTuple):
    """Sums of second derivatives: own (3, m) xx, xy, yy; next (4, m) xx, xy, yx, yy; arm (3, 2 w)
    x, y and phi; twist (w,).
    """

    own: np.ndarray
    next: np.ndarray
    arm: np.ndarray
    twist: np.ndarray


@jit
def measure(x, walls, shape):
    """Fill directions and lengths; return the shortest length in m."""
    shortest = np.inf
    for k in range(shape.length.size):
        i, j = 2 * walls.edges[k, 0], 2 * walls.edges[k, 1]
        ex, ey = x[j] - x[i], x[j + 1] - x[i + 1]
        length = np.sqrt(ex * ex + ey * ey)
        shape.length[k] = length
        shape.t[0, k] = ex / length
        shape.t[1, k] = ey / length
        shortest = min(shortest, length)
    return shortest


@jit
def clear(shape, stiffness):
    """Set the sums over the terms to zero."""
    zero_rows(shape.slope)
    zero(shape.moment)
    zero_rows(stiffness.own)
    zero_rows(stiffness.next)
    zero_rows(stiffness.arm)
    zero(stiffness.twist)


@jit
def stretch(shape, stiffness, k, tension, along, across):
    """Add an energy of the length of element ``k``.

    slope: tension t. own: along t t + across n n.
    """
    tx, ty = shape.t[0, k], shape.t[1, k]
    shape.slope[0, k] += tension * tx
    shape.slope[1, k] += tension * ty
    stiffness.own[0, k] += along * tx * tx + across * ty * ty
    stiffness.own[1, k] += (along - across) * tx * ty
    stiffness.own[2, k] += along * ty * ty + across * tx * tx


@jit
def turn(shape, stiffness, k, moment, rigidity, bent):
    """Add an energy of the bearing of element ``k``, whose derivative in the bearing is ``moment``.

    slope: moment n / l. own: rigidity n n / l^2 - bent (t n + n t) / l^2.
    """
    tx, ty = shape.t[0, k], shape.t[1, k]
    by_length = 1.0 / shape.length[k]
    shape.slope[0, k] -= moment * by_length * ty
    shape.slope[1, k] += moment * by_length * tx
    nn, tn = rigidity * by_length * by_length, bent * by_length * by_length
    stiffness.own[0, k] += nn * ty * ty + 2.0 * tn * tx * ty
    stiffness.own[1, k] -= nn * tx * ty + tn * (tx * tx - ty * ty)
    stiffness.own[2, k] += nn * tx * tx - 2.0 * tn * tx * ty


@jit
def turn_hinge(shape, stiffness, k, moment, rigidity, bent):
    """Add an energy of the angle between elements ``k`` and ``k`` + 1."""
    turn(shape, stiffness, k, -moment, rigidity, -bent)
    turn(shape, stiffness, k + 1, moment, rigidity, bent)
    weight = -rigidity / (shape.length[k] * shape.length[k + 1])
    tx, ty, ux, uy = shape.t[0, k], shape.t[1, k], shape.t[0, k + 1], shape.t[1, k + 1]
    stiffness.next[0, k] += weight * ty * uy
    stiffness.next[1, k] -= weight * ty * ux
    stiffness.next[2, k] -= weight * tx * uy
    stiffness.next[3, k] += weight * tx * ux


@jit
def turn_arm(shape, stiffness, walls, a, moment, rigidity, bent):
    """Add an energy of the turn of arm ``a`` against its joint."""
    k = walls.arm_element[a]
    turn(shape, stiffness, k, moment, rigidity, bent)
    shape.moment[a] += moment
    weight = rigidity / shape.length[k]
    stiffness.arm[0, a] += weight * shape.t[1, k]
    stiffness.arm[1, a] -= weight * shape.t[0, k]
    stiffness.arm[2, a] += rigidity


@jit
def couple_arms(shape, stiffness, walls, w, rigidity):
    """Add the mixed second derivative ``rigidity`` in the turns of both arms of one element."""
    k = walls.arm_element[2 * w]
    turn(shape, stiffness, k, 0.0, 2.0 * rigidity, 0.0)
    weight = rigidity / shape.length[k]
    for a in (2 * w, 2 * w + 1):
        stiffness.arm[0, a] += weight * shape.t[1, k]
        stiffness.arm[1, a] -= weight * shape.t[0, k]
    stiffness.twist[w] += rigidity


@jit
def gather(walls, shape, g):
    """Add the sums to the gradient ``g`` (n,) by coordinate."""
    for k in range(shape.length.size):
        i, j = 2 * walls.edges[k, 0], 2 * walls.edges[k, 1]
        g[i] -= shape.slope[0, k]
        g[i + 1] -= shape.slope[1, k]
        g[j] += shape.slope[0, k]
        g[j + 1] += shape.slope[1, k]
    for a in range(shape.moment.size):
        g[walls.rotation[a]] -= shape.moment[a]


@jit
def product(walls, stiffness, u, factor, shape):
    """Add ``factor`` K u to slopes and moments for a move ``u`` (n,); return u . K u."""
    own, following, arm, total = stiffness.own, stiffness.next, stiffness.arm, 0.0
    for w in range(walls.start.size - 1):
        px, py = 0.0, 0.0
        for k in range(walls.start[w], walls.start[w + 1]):
            i, j = 2 * walls.edges[k, 0], 2 * walls.edges[k, 1]
            ex, ey = u[j] - u[i], u[j + 1] - u[i + 1]
            fx, fy = own[0, k] * ex + own[1, k] * ey, own[1, k] * ex + own[2, k] * ey
            if k > walls.start[w]:
                b = following[:, k - 1]
                shape.slope[0, k - 1] += factor * (b[0] * ex + b[1] * ey)
                shape.slope[1, k - 1] += factor * (b[2] * ex + b[3] * ey)
                gx, gy = b[0] * px + b[2] * py, b[1] * px + b[3] * py
                fx, fy = fx + gx, fy + gy
                total += gx * ex + gy * ey
            shape.slope[0, k] += factor * fx
            shape.slope[1, k] += factor * fy
            total += fx * ex + fy * ey
            px, py = ex, ey
        for a in (2 * w, 2 * w + 1):
            k, phi = walls.arm_element[a], u[walls.rotation[a]]
            i, j = 2 * walls.edges[k, 0], 2 * walls.edges[k, 1]
            turned = arm[0, a] * (u[j] - u[i]) + arm[1, a] * (u[j + 1] - u[i + 1])
            bent = arm[2, a] * phi + stiffness.twist[w] * u[walls.rotation[4 * w + 1 - a]]
            shape.slope[0, k] += factor * arm[0, a] * phi
            shape.slope[1, k] += factor * arm[1, a] * phi
            shape.moment[a] -= factor * (turned + bent)
            total += (2.0 * turned + bent) * phi
    return total


@jit
def add_scaled(stiffness, other, factor):
    """Add ``factor`` x ``other`` to ``stiffness``."""
    for k in range(stiffness.own.shape[1]):
        for c in range(3):
            stiffness.own[c, k] += factor * other.own[c, k]
        for c in range(4):
            stiffness.next[c, k] += factor * other.next[c, k]
    for a in range(stiffness.arm.shape[1]):
        for c in range(3):
            stiffness.arm[c, a] += factor * other.arm[c, a]
    for w in range(stiffness.twist.size):
        stiffness.twist[w] += factor * other.twist[w]
