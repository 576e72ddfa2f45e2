"""Rods in numpy, element by element, as they are often written: `rods` shows the equations.

Each element, hinge and arm has a small gradient and Hessian of its own, found in one go and added
to dense ones.
"""

import math
from typing import NamedTuple

import numpy as np
from scipy.linalg import solve

SPAN = np.hstack([-np.eye(2), np.eye(2)])  # from the nodes of an element to e
BEFORE, AFTER = np.pad(SPAN, ((0, 0), (0, 2))), np.pad(SPAN, ((0, 0), (2, 0)))  # of a hinge
ALONE, TURN = np.pad(SPAN, ((0, 0), (0, 1))), np.eye(5)[4]  # from those and phi to e, to phi


class Found(NamedTuple):
    """Energy, gradient (n,) and Hessian (n, n)."""

    energy: float
    gradient: np.ndarray
    hessian: np.ndarray


def stretched(x, stiffness, l0):
    """Energy of an element with its derivatives in both nodes."""
    e = SPAN @ x
    length = math.hypot(e[0], e[1])
    tension, slope = stiffness * (length - l0), e / length @ SPAN
    across = tension / length
    hessian = across * SPAN.T @ SPAN + (stiffness - across) * np.outer(slope, slope)
    return 0.5 * tension * (length - l0), tension * slope, hessian


def bearing(e):
    """Bearing of a vector with its derivatives."""
    square = e @ e
    q = np.array([-e[1], e[0]]) / square
    xx, xy = -2.0 * q[0] * q[1], q[0] ** 2 - q[1] ** 2
    return math.atan2(e[1], e[0]), q, np.array([[xx, xy], [xy, -xx]])


def turned(stiffness, angle, slope, curvature):
    """Energy of an angle with its derivatives, from those of the angle."""
    angle = math.remainder(angle, 2.0 * math.pi)
    moment = stiffness * angle
    hessian = stiffness * np.outer(slope, slope) + moment * curvature
    return 0.5 * moment * angle, moment * slope, hessian


def hinge(x, stiffness, rest):
    """Energy of the angle between two elements with its derivatives in their three nodes."""
    one, p, a = bearing(BEFORE @ x)
    two, q, b = bearing(AFTER @ x)
    curvature = AFTER.T @ b @ AFTER - BEFORE.T @ a @ BEFORE
    return turned(stiffness, two - one - rest, q @ AFTER - p @ BEFORE, curvature)


def arm(x, stiffness, rest):
    """Energy of an element that turns against its joint, in both nodes and the rotation."""
    beta, q, own = bearing(ALONE @ x)
    return turned(stiffness, beta - x[4] - rest, q @ ALONE - TURN, ALONE.T @ own @ ALONE)


class Elements:
    """What walls of two elements and more store, over the coordinates ``free`` (n,)."""

    def __init__(self, scene):
        self.x, leader = scene.x_rest.copy(), scene.terms.layout.leader
        self.free = np.flatnonzero(leader == np.arange(leader.size))
        self.parts = list(parts(scene.terms))

    def found(self, x):
        """Energy and its derivatives at ``x`` (n,)."""
        self.x[self.free] = x
        energy, g, hessian = 0.0, np.zeros(self.x.size), np.zeros((self.x.size, self.x.size))
        for part, at, stiffness, rest in self.parts:
            value, slope, curvature = part(self.x[at], stiffness, rest)
            energy += value
            g[at] += slope
            hessian[at[:, None], at] += curvature
        return Found(energy, g[self.free], hessian[np.ix_(self.free, self.free)])

    def towards(self, found, diagonal, g):
        """Newton's step, with more on the diagonal of the Hessian, which has to be positive."""
        return solve(found.hessian + np.diag(diagonal), -g, assume_a="pos")


def parts(terms):
    """Elements, hinges and arms: function, coordinates, stiffness, length or angle at rest."""
    walls, bend, stretch = terms.walls, terms.bend, terms.stretch
    of = np.column_stack([2 * walls.edges[:, :1], 2 * walls.edges[:, :1] + 1])
    of = np.column_stack([of, 2 * walls.edges[:, 1:], 2 * walls.edges[:, 1:] + 1])
    for at, area, l0 in zip(of, stretch.area, stretch.l0, strict=True):
        yield stretched, at, terms.law.modulus * area / l0, l0
    for k, stiffness, rest in zip(bend.hinges, bend.hinge_stiffness, bend.hinge_angle, strict=True):
        yield hinge, np.concatenate([of[k], of[k + 1, 2:]]), stiffness, rest
    bearings = np.arctan2(bend.arm_rest[:, 1], bend.arm_rest[:, 0])
    ends = zip(walls.arm_element, walls.rotation, strict=True)
    for (k, phi), stiffness, rest in zip(ends, bend.arm_stiffness, bearings, strict=True):
        yield arm, np.append(of[k], phi), stiffness, rest
