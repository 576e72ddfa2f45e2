"""Geometrically exact frames: a structure's walls as rods, by collocation (scipy's `solve_bvp`).

Rods stretch and bend and have no shear (Reissner 1972). In each wall, s from 0 to 1 along its
length l at rest, with N = H cos theta + V sin theta:

    x' = l (1 + N / YA) cos theta    theta' = l M / YI    M' = H y' - V x'    H' = V' = 0
"""

from dataclasses import dataclass

import numpy as np
from scipy.integrate import solve_bvp
from scipy.interpolate import CubicSpline

from tests.studies.validation.problem import axial, bending
from tests.support.designs.structures import MM, structure

WAYS = ("x", "y", "rotation")
TOLERANCE = 1e-6
POINTS = 7


@dataclass
class Frame:
    """A structure of straight walls with supports, pins, loads and prescribed moves; lengths over
    ``unit``, forces times unit^2 / YI of the first wall. Searches start from the last solution.
    """

    parts: dict

    def __post_init__(self):
        of = structure(**self.parts)
        points, ends = MM * np.array(of.nodes_mm), np.array(of.walls)
        along = points[ends[:, 1]] - points[ends[:, 0]]
        self.unit, self.force = np.linalg.norm(along, axis=1).max(), 1.0
        self.force = bending(of.thickness_mm[0]) / self.unit**2
        self.of, self.points, self.walls = of, points / self.unit, len(ends)
        self.length = np.linalg.norm(along, axis=1) / self.unit
        self.rest = np.arctan2(along[:, 1], along[:, 0])
        moment = self.force * self.unit
        thickness = of.thickness_mm
        self.bending = np.array([bending(t) for t in thickness]) / (moment * self.unit)
        self.axial = np.array([axial(t) for t in thickness]) / self.force
        self.at = {node: [] for node in range(len(points))}
        for wall, pair in enumerate(ends):
            for end, node in enumerate(pair):
                self.at[node].append((wall, end))
        self.load = {node: np.zeros(3) for node in self.at}
        for part in of.loads:
            size = [*part.force_N, MM * part.moment_Nmm / self.unit]
            self.load[part.node] += np.array(size) / self.force
        self.move = dict.fromkeys(of.restraints, 0.0)
        for part in of.prescribed:
            turns = part.direction == "rotation"
            move = part.angle_rad if turns else MM * part.displacement_mm / self.unit
            self.move[part.node, part.direction] = move
        self.s = np.linspace(0.0, 1.0, 33)
        straight = points[ends[:, 0], :, None] + along[:, :, None] * self.s
        self.y = np.zeros((self.walls, 6, len(self.s)))
        self.y[:, :2] = straight / self.unit
        self.y[:, 2] = self.rest[:, None]
        self.factor = 0.0

    def _slope(self, s, y, _=None):
        _, _, angle, moment, h, v = np.moveaxis(y.reshape(self.walls, 6, -1), 1, 0)
        co, si = np.cos(angle), np.sin(angle)
        length, axial = self.length[:, None], self.axial[:, None]
        stretch = length * (1.0 + (h * co + v * si) / axial)
        dx, dy = stretch * co, stretch * si
        zero = np.zeros_like(dx)
        turn = length * moment / self.bending[:, None]
        return np.stack([dx, dy, turn, h * dy - v * dx, zero, zero], axis=1).reshape(y.shape)

    def _joints(self, first, last, factor):
        """Residuals of continuity and balance at every node."""
        ends = np.stack([first, last]).reshape(2, self.walls, 6)
        left = []
        for node, meeting in self.at.items():
            moves = np.array([ends[end, wall, :3] for wall, end in meeting])
            moves[:, 2] -= self.rest[[wall for wall, _ in meeting]]
            pushes = self._pushes(meeting, ends)
            start = [*self.points[node], 0.0]
            for way, name in enumerate(WAYS):
                if name == "rotation" and node in self.of.pins:
                    left += list(pushes[:, way])
                    continue
                left += list(np.diff(moves[:, way]))
                if (node, name) in self.move:
                    left.append(moves[0, way] - start[way] - factor * self.move[node, name])
                else:
                    left.append(pushes[:, way].sum() - factor * self.load[node][way])
        return left

    @staticmethod
    def _pushes(meeting, ends):
        """Forces and moments that walls' ends bear at a node, (walls' ends, 3)."""
        return np.array([(2 * end - 1) * ends[end, wall, [4, 5, 3]] for wall, end in meeting])

    @property
    def ends(self):
        """Both ends of every wall, (2, m, 6)."""
        return np.moveaxis(self.y[:, :, [0, -1]], 2, 0)

    def reaction(self, node, way):
        """Force (N) or moment (N m) that holds a node."""
        unit = self.force * (self.unit if way == "rotation" else 1.0)
        return unit * self._pushes(self.at[node], self.ends)[:, WAYS.index(way)].sum()

    def place(self, node, way, ends=None):
        """Coordinate (over unit) or rotation of a node; ``ends`` (2, m, 6): of walls, elsewhere."""
        wall, end = self.at[node][0]
        ends = self.ends if ends is None else ends
        value = ends[end, wall, WAYS.index(way)]
        return value - (self.rest[wall] if way == "rotation" else 0.0)

    def near(self, places):
        """Begin the next search at the shape of a mesh with equally many elements in every wall.

        places (n, 2): of the joints, then of the nodes inside each wall, m.
        """
        places = places / self.unit
        inner = places[len(self.points) :].reshape(self.walls, -1, 2)
        for wall, (first, last) in enumerate(self.of.walls):
            passed = np.stack([places[first], *inner[wall], places[last]])
            through = CubicSpline(np.linspace(0.0, 1.0, len(passed)), passed)
            angle = np.unwrap(np.arctan2(*through(self.s, 1).T[::-1]))
            angle += 2.0 * np.pi * np.round((self.rest[wall] - angle.mean()) / (2.0 * np.pi))
            self.y[wall, :3] = *through(self.s).T, angle
        return self

    def solve(self, factor, steps=1):
        """Find the shape under a share of the loads, from the last one, in equal steps."""
        for share in np.linspace(self.factor, factor, steps + 1)[1:]:
            self._accept(
                solve_bvp(
                    self._slope, lambda a, b, share=share: np.array(self._joints(a, b, share)),
                    self.s, self.y.reshape(6 * self.walls, -1), tol=TOLERANCE, max_nodes=20000,
                )
            )  # fmt: skip
            self.factor = share
        return self

    def lead(self, node, way, value):
        """Find the load factor with which a node has gone to a coordinate (over unit)."""

        def joints(a, b, p):
            at = self.place(node, way, np.stack([a, b]).reshape(2, self.walls, 6))
            return np.array([*self._joints(a, b, p[0]), at - value])

        found = solve_bvp(
            self._slope, joints, self.s, self.y.reshape(6 * self.walls, -1), [self.factor],
            tol=TOLERANCE, max_nodes=20000,
        )  # fmt: skip
        self._accept(found)
        self.factor = float(found.p[0])
        return self.factor

    def _accept(self, found):
        if not found.success:
            raise ArithmeticError(found.message)
        self.y = found.sol(self.s).reshape(self.walls, 6, -1)

    def greatest(self, node, way, step, measure):
        """The first greatest ``measure`` of the frame while a node goes on in steps (over unit).

        Of the polynomial through the last points, three of them behind the greatest.
        """
        places, found = [], []
        while len(found) < POINTS or np.argmax(found[-4:]) != 0:
            places.append(self.place(node, way) + step)
            self.lead(node, way, places[-1])
            found.append(measure(self))
        near = (np.array(places[-POINTS:]) - places[-4]) / step
        through = np.polynomial.Polynomial.fit(near, found[-POINTS:], POINTS - 1)
        peaks = through.deriv().roots().real
        return float(through(peaks[np.argmin(abs(peaks))]))
