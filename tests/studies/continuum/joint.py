"""The joint of two crossing walls as an elastic block: how much less than point joints it yields.

A cross of four half walls of l thicknesses, of small strain: its half walls yield as 4 l^3 under a
shear force at their ends, in t / (Y depth), if they are beams that meet at a point. A solid cross
yields as 4 l^3 + b l^2 + c l + d, as stresses beyond the joint are those of beams. b is what a
moment at the joint yields less than 12 l^2, spread over a wall of two ends.
"""

import numpy as np
from scipy.sparse.linalg import splu
from skfem import MeshQuad

from tests.studies.continuum.grid import crowded
from tests.studies.continuum.rubber import Rubber
from tests.studies.continuum.solid import Solid

ARMS = (2.0, 2.5, 3.0, 4.0, 6.0, 10.0)  # l
GROWTH = 1.7  # exponent: elements of the arms become longer outwards
SIDES = ((0, 1.0), (0, -1.0), (1, 1.0), (1, -1.0))  # axis and sign of the four ends


def shear(o):
    """Traction of a force of 1 across the arm, over o from -1/2 to 1/2."""
    return 1.5 - 6.0 * o * o


class Cross:
    """Half walls of ``arm`` thicknesses, modulus and thickness 1; ``across``: elements."""

    def __init__(self, arm, across, poisson):
        outwards = 0.5 + (arm - 0.5) * np.linspace(0.0, 1.0, 4 * across + 1)[1:] ** GROWTH
        lines = np.sort(np.concatenate([crowded(across) - 0.5, outwards, -outwards]))
        full = MeshQuad.init_tensor(lines, lines)
        centre = np.abs(full.p[:, full.t].mean(axis=1))
        mesh = full.restrict(np.flatnonzero(centre.min(axis=0) < 0.5))
        self.arm, self.solid = arm, Solid(mesh, Rubber(1.0, poisson), 1.0)
        centre, beside = (self._nearest(x) for x in (0.0, 0.4))
        held = [2 * centre, 2 * centre + 1, 2 * beside + 1]  # no more than rigid motion
        self.free = np.setdiff1d(np.arange(self.solid.size), held)
        matrix = self.solid.hessian(np.zeros(self.solid.size))
        self.factor = splu(matrix[self.free][:, self.free].tocsc())

    def _nearest(self, x):
        """Node nearest to (x, 0)."""
        return int(np.argmin(np.hypot(self.solid.points[:, 0] - x, self.solid.points[:, 1])))

    def load(self, axis, sign, way, traction):
        """Nodal forces of a traction in direction ``way`` over one end, by Simpson's rule."""
        at = np.flatnonzero(np.isclose(self.solid.points[:, axis], sign * self.arm))
        at = at[np.argsort(self.solid.points[at, 1 - axis])]
        o = self.solid.points[at, 1 - axis]
        share = np.zeros_like(o)
        for k in range(0, len(o) - 2, 2):
            share[k : k + 3] += (o[k + 2] - o[k]) * np.array([1.0, 4.0, 1.0]) / 6.0
        force = np.zeros(self.solid.size)
        force[2 * at + way] = share * traction(o)
        return force

    def work(self, force):
        """Twice the energy of forces in balance, f . K^-1 f."""
        return force[self.free] @ self.factor.solve(force[self.free])

    def sheared(self):
        """What one half wall yields where all four are sheared, turning the joint neither way."""
        force = sum(sign * self.load(axis, sign, 1 - axis, shear) for axis, sign in SIDES)
        return self.work(force) / 4.0


def coefficients(across, poisson):
    """The three numbers b, c, d."""
    crosses = [Cross(arm, across, poisson) for arm in ARMS]
    excess = [cross.sheared() - 4.0 * cross.arm**3 for cross in crosses]
    powers = np.array(ARMS)[:, None] ** np.array([2, 1, 0])
    return np.linalg.lstsq(powers, excess)[0]


def spared(across, poisson):
    """Thicknesses s of a wall that seem not to bend: 4 l^3 - 3 s l^2 of a half wall."""
    return -coefficients(across, poisson)[0] / 3.0
