"""Beams in numpy, element by element, as they are often written: `beams` shows the equations."""

import math
from typing import NamedTuple

import numpy as np
from scipy.linalg import solve

from tests.studies.bench.peers.beams import Material


class Found(NamedTuple):
    """Energy, gradient (n,) and Hessian (n, n)."""

    energy: float
    gradient: np.ndarray
    hessian: np.ndarray


def beam(x, l0, axial, bending, arc, rest):
    """Energy of a beam with its derivatives in ``x`` (6,): x, y, phi of both ends."""
    ex, ey = x[3] - x[0], x[4] - x[1]
    length = math.hypot(ex, ey)
    tx, ty = ex / length, ey / length
    t, n = np.array([-tx, -ty, 0, tx, ty, 0]), np.array([ty, -tx, 0, -ty, tx, 0])
    deformed = np.stack([t, n / length, n / length])
    deformed[[1, 2], [2, 5]] = -1.0
    a = np.array([math.remainder(math.atan2(ey, ex) - rest - x[c], math.tau) for c in (2, 5)])
    slope = arc @ a
    strain = length / l0 - 1.0 + 0.5 * a @ slope
    of_strain = np.array([1.0 / l0, *slope])
    pull = axial * l0 * strain
    force = pull * of_strain
    force[1:] += bending @ a
    rigidity = axial * l0 * np.outer(of_strain, of_strain)
    rigidity[1:, 1:] += pull * arc + bending
    curl = (force[1] + force[2]) / length**2
    hessian = deformed.T @ rigidity @ deformed + force[0] / length * np.outer(n, n)
    hessian -= curl * (np.outer(t, n) + np.outer(n, t))
    return 0.5 * (pull * strain + a @ bending @ a), force @ deformed, hessian


class Elements:
    """What walls store, over the coordinates ``free`` (n,)."""

    def __init__(self, scene):
        self.x, leader = scene.x_rest.copy(), scene.terms.layout.leader
        self.free = np.flatnonzero(leader == np.arange(leader.size))
        self.dofs, given = scene.terms.walls.dofs, Material.of(scene.terms)
        self.parts = list(zip(self.dofs, *given, strict=True))

    def found(self, x):
        """Energy and its derivatives at ``x`` (n,)."""
        self.x[self.free] = x
        energy, g, hessian = 0.0, np.zeros(self.x.size), np.zeros((self.x.size, self.x.size))
        for at, *given in self.parts:
            value, slope, curvature = beam(self.x[at], *given)
            energy += value
            g[at] += slope
            hessian[at[:, None], at] += curvature
        return Found(energy, g[self.free], hessian[np.ix_(self.free, self.free)])

    def towards(self, found, diagonal, g):
        """Newton's step, with more on the diagonal of the Hessian, which has to be positive."""
        return solve(found.hessian + np.diag(diagonal), -g, assume_a="pos")
