"""Compliance of the arms of a joint beyond beams that meet at a point, by linear plane elasticity.

Arm i bears (N, V, M) at the centre of the joint: along the arm, to its left, turning left. A solid
joint of arms yields as Timoshenko's beams of shear coefficient 5/6 that reach the centre, and

    r . C r,    r = (N, V, M t) of all arms, in balance,

over 2 Y depth, in thicknesses t. C does not depend on the length of the arms. It is linear in
Poisson's ratio, as stresses under forces at the rim do not depend on it.
"""

from dataclasses import dataclass

import numpy as np
from skfem import MeshQuad

from tests.studies.continuum.grid import crowded
from tests.studies.continuum.press import factor
from tests.studies.continuum.rubber import Rubber
from tests.studies.continuum.solid import Solid

GROWTH = 1.7  # exponent: elements of the arms become longer outwards
LENGTH = 4.0  # of an arm, thicknesses
SIDE = 2.0 * np.pi / 3.0  # angle between the arms of a Y
REST = 0.51  # of a thickness: farther off its axis is not in an arm
TRACTIONS = (
    np.ones_like,
    lambda o: 1.5 - 6.0 * o * o,
    lambda o: -12.0 * o,
)  # of N, V and M at an end
ARMS = {"X": (0, 90, 180, 270), "T": (0, 90, 180), "L": (0, 90), "Y": (90, 210, 330)}
SWAY = {"X": (1, -1, 1, -1), "T": (1, -2, 1), "L": (1, -1), "Y": (2, -1, -1)}


def outwards(along, start, end):
    """Lines from start to end, finer at the start."""
    return start + (end - start) * np.linspace(0.0, 1.0, along + 1) ** GROWTH


def axes(angle):
    """Unit vectors along an arm and to its left."""
    co, si = np.cos(angle), np.sin(angle)
    return np.array([co, si]), np.array([-si, co])


def square(angles, across):
    """Mesh of arms at multiples of 90 degrees."""
    out = outwards(4 * across, 0.5, LENGTH)[1:]
    lines = np.sort(np.concatenate([crowded(across) - 0.5, out, -out]))
    full = MeshQuad.init_tensor(lines, lines)
    centre = full.p[:, full.t].mean(axis=1)
    wall = np.all(np.abs(centre) < 0.5, axis=0)
    for along, left in map(axes, np.radians(angles)):
        wall |= (along @ centre > 0.5) & (np.abs(left @ centre) < 0.5)
    return full.restrict(np.flatnonzero(wall))


def patch(corner):
    """Quadrilaterals of a (m, n, 2) lattice of points."""
    m, n = corner.shape[:2]
    place = np.arange(m * n).reshape(m, n)
    quads = np.array([place[:-1, :-1], place[1:, :-1], place[1:, 1:], place[:-1, 1:]])
    return MeshQuad(corner.reshape(-1, 2).T.copy(), quads.reshape(4, -1))


def three(angles, across):
    """Mesh of three arms at 120 degrees: a triangle of side 1 between them; across is even."""
    height = 0.5 / np.sqrt(3.0)  # of its sides over its centre
    edge, out = crowded(across) - 0.5, outwards(4 * across, height, LENGTH)
    share = 2.0 * crowded(across)[: across // 2 + 1, None]
    pieces = []
    for angle in np.radians(angles):
        along, left = axes(angle)
        pieces.append(patch(along * out[:, None, None] + left * edge[:, None]))
        corner = 2.0 * height * axes(angle + 0.5 * SIDE)[0]
        one, other = height * along, height * axes(angle + SIDE)[0]
        first = corner + share * (one - corner)
        pieces.append(
            patch(
                first[:, None]
                + share * (other - corner + 0.0 * first[:, None])
                + share * share[:, None] * (corner - one - other)
            )
        )
    whole = pieces[0]
    for piece in pieces[1:]:
        whole = whole + piece
    return whole


@dataclass
class Joint:
    """A solid joint of thickness, modulus and depth 1; ``across``: elements through an arm."""

    kind: str
    across: int
    poisson: float

    def __post_init__(self):
        self.angles = np.radians(ARMS[self.kind])
        mesh = (three if self.kind == "Y" else square)(ARMS[self.kind], self.across)
        self.solid = Solid(mesh, Rubber(1.0, self.poisson), 1.0)
        centre, beside = (self._nearest(x) for x in (0.0, 0.4))
        held = [2 * centre, 2 * centre + 1, 2 * beside + 1]  # no more than rigid motion
        self.free = np.setdiff1d(np.arange(self.solid.size), held)
        matrix = self.solid.hessian(np.zeros(self.solid.size))
        self.factor = factor(matrix[self.free][:, self.free])

    def _nearest(self, x):
        """Node nearest to (x, 0)."""
        return int(np.argmin(np.hypot(self.solid.points[:, 0] - x, self.solid.points[:, 1])))

    def _end(self, arm, traction, way):
        """Nodal forces of a traction of the place across the end of an arm."""
        along, left = axes(self.angles[arm])
        points = self.solid.points
        at = np.flatnonzero(np.isclose(points @ along, LENGTH) & (np.abs(points @ left) < REST))
        at = at[np.argsort(points[at] @ left)]
        o, force = points[at] @ left, np.zeros(self.solid.size)
        mass = np.array([[4.0, 2.0, -1.0], [2.0, 16.0, 2.0], [-1.0, 2.0, 4.0]]) / 30.0
        for k in range(0, len(o) - 2, 2):
            share = (o[k + 2] - o[k]) * mass @ traction(o[k : k + 3])
            for axis in range(2):
                force[2 * at[k : k + 3] + axis] += share * way[axis]
        return force

    def load(self, resultants):
        """Nodal forces of (N, V, M) at the centre, (arms, 3)."""
        force = np.zeros(self.solid.size)
        for arm, (n, v, m) in enumerate(resultants):
            along, left = axes(self.angles[arm])
            for value, traction, way in zip(
                (n, v, m - v * LENGTH), TRACTIONS, (along, left, along), strict=True
            ):
                force += value * self._end(arm, traction, way)
        return force

    def beyond(self, one, other):
        """The form C of two sets of resultants in balance, (arms, 3)."""
        first, second = self.load(one)[self.free], self.load(other)[self.free]
        sheared = 2.4 * (1.0 + self.poisson) * LENGTH + 4.0 * LENGTH**3
        beam = np.array(
            [
                [LENGTH, 0.0, 0.0],
                [0.0, sheared, -6.0 * LENGTH**2],
                [0.0, -6.0 * LENGTH**2, 12.0 * LENGTH],
            ]
        )
        return first @ self.factor.solve(second) - np.einsum("ia,ab,ib->", one, beam, other)

    def sway(self):
        """C of one arm as (MM, MV, VV), under the moments and shears of a lattice that sways."""
        share = np.array(SWAY[self.kind], float)
        along, left = np.array([axes(angle) for angle in self.angles]).swapaxes(0, 1)
        moments, shears = np.zeros((2, len(share), 3))
        moments[:, 2] = shears[:, 1] = share
        shears[:, 0] = np.linalg.lstsq(along.T, -(left.T @ share))[0]
        pairs = ((moments, moments), (moments, shears), (shears, shears))
        return np.array([self.beyond(*pair) for pair in pairs]) / (share @ share)
