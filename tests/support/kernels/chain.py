"""A second problem for the solver: a chain of particles on a line, each in a double well.

    E = sum_i h ((x_i / a)^2 - 1)^2 + sum_i k / 2 (x_{i+1} - x_i - a0)^2 - f . u + E_i + D_f

One unknown a particle, no walls, no plane, no compiled code. Friction with the line is Coulomb's,
smoothed as in `kernels.terms.friction`; its normal force depends on the place, N = n (1 + (x /
a)^2), and lags. The list of neighbours is imaginary: it holds for moves up to `MARGIN`.
"""
# ruff: noqa: D102  the verbs are explained in `kernels.solve.problem`

from typing import NamedTuple

import numpy as np

from kernels.solve.problem import FREE, LED, NEGATIVE, POSITIVE, Coordinates

MARGIN = 0.4  # of a: a particle that has moved farther needs a new list
WELLS, SPRINGS = range(2)
FIELDS = ("time", "work", "kinetic", "wells", "springs", "material", "friction", "integrator")
ROW = np.dtype((np.record, [(name, np.float64) for name in (*FIELDS, "residual", "reaction")]))


class Output(NamedTuple):
    """rows (steps,) of `ROW`; positions (steps, n)."""

    rows: np.ndarray
    positions: np.ndarray


class Neighbours(NamedTuple):
    """Positions (n,) at which the list was made."""

    anchor: np.ndarray


class Buffers(NamedTuple):
    """Lagged normal forces (n,); Hessian (n, n) and pivots (n,) of the factor; place (1,) of the
    first negative pivot.
    """

    normal: np.ndarray
    hessian: np.ndarray
    pivot: np.ndarray
    place: np.ndarray


def _smoothed(u, slip):
    """Return |u| (n,), smoothed, and its two derivatives."""
    size, s = np.abs(u), np.minimum(np.abs(u) / slip, 1.0)
    near = size < slip
    value = np.where(near, slip * s * s * (1.0 - s / 3.0), size - slip / 3.0)
    return value, np.sign(u) * s * (2.0 - s), np.where(near, 2.0 / slip * (1.0 - s), 0.0)


class Chain(NamedTuple):
    """The problem."""

    scene: "Line"
    neighbours: Neighbours
    buffers: Buffers

    def nothing(self, *_):
        """Nothing is remembered, tied or measured from the start of a step."""

    begin = commit = roll_back = tie = forget = write_share = nothing

    def store(self, x, step, found):
        scene = self.scene
        well, slope, _ = scene.well(x)
        stretched = np.diff(x) - scene.apart
        found.stored[:] = well.sum(), 0.5 * scene.spring * stretched @ stretched
        found.elastic[:] += slope
        found.elastic[:-1] -= scene.spring * stretched
        found.elastic[1:] += scene.spring * stretched

    def evaluate(self, x, step, found):
        coordinates = self.scene.coordinates
        for part in (found.elastic, found.friction, found.material):
            part[:] = 0.0
        found.u[:] = x - step.y
        self.store(x, step, found)
        force = step.factor * coordinates.load
        total = found.stored.sum() - force @ found.u
        found.g[:] = found.elastic - force
        if step.dynamic:
            inert = coordinates.mass * (x - step.x_pred) / step.h**2
            total += 0.5 * inert @ (x - step.x_pred)
            found.g[:] += inert
        sums = found.sums[0]
        sums.potential, sums.friction, sums.dissipated = total, 0.0, 0.0
        return self.exchange(step, found)

    def solved(self):
        """Which coordinates (n,) are unknown."""
        role = self.scene.coordinates.role
        return (role == FREE) & (np.arange(role.size) != self.scene.coordinates.driven)

    def factor(self, x, step, found, shift, through):
        scene, buffers, solved = self.scene, self.buffers, self.solved()
        pivot = buffers.pivot
        ends = np.r_[0.0, np.full(x.size - 1, scene.spring)]
        diagonal = scene.well(x)[2] + shift + ends + ends[::-1]
        if step.dynamic:
            diagonal += scene.coordinates.mass / step.h**2
        if scene.friction > 0.0:
            diagonal += scene.friction * buffers.normal * _smoothed(found.u, scene.slip)[2]
        buffers.hessian[:] = np.diag(diagonal) - np.diag(ends[1:], 1) - np.diag(ends[1:], -1)
        met, first, before = POSITIVE, 0.0, np.inf
        for i in range(x.size):
            pivot[i] = diagonal[i] - ends[i] ** 2 / before if solved[i] else 1.0
            before = pivot[i] if solved[i] else np.inf
            if pivot[i] <= 0.0 and met == POSITIVE:
                met, first, buffers.place[0] = NEGATIVE, pivot[i], i
                if not through:
                    break
        return met, first

    def solve(self, b):
        free = np.flatnonzero(self.solved())
        y = np.linalg.solve(self.buffers.hessian[np.ix_(free, free)], b[free])
        b[:] = 0.0
        b[free] = y

    def descend(self, direction):
        failed, hessian = self.buffers.place[0], self.buffers.hessian
        before = np.flatnonzero(self.solved()[:failed])
        direction[:] = 0.0
        direction[failed] = 1.0
        direction[before] = -np.linalg.solve(
            hessian[np.ix_(before, before)], hessian[before, failed]
        )

    def unstable(self):
        return np.count_nonzero(self.buffers.pivot < 0.0)

    def stiffest(self):
        return np.abs(np.diag(self.buffers.hessian)).max()

    def reduce(self, g, residual):
        role = self.scene.coordinates.role
        residual[:] = np.where((role == FREE) | (role == LED), g, 0.0)

    def lead(self, move, direction):
        if self.scene.coordinates.driven >= 0:
            direction[self.scene.coordinates.driven] = move

    def pull(self, move, direction):
        direction[:] = self.buffers.hessian[:, self.scene.coordinates.driven] * move

    def travel(self, dx):
        return np.abs(dx).max()

    def step_limit(self, x, dx, far):
        """Return a share with which no particle goes farther than half the way to the other
        well.
        """
        return min(1.0, self.scene.width / far) if far > 0.0 else 1.0

    def covers(self, x, far):
        moved = np.abs(x - self.neighbours.anchor).max()
        return moved + far <= MARGIN * self.scene.width or (far > 0.0 and moved == 0.0)

    def lag(self, y):
        scene = self.scene
        self.buffers.normal[:] = scene.weight * (1.0 + (y / scene.width) ** 2)
        return scene.friction > 0.0

    def exchange(self, step, found):
        scene, sums = self.scene, found.sums[0]
        if scene.friction > 0.0:
            value, slope, _ = _smoothed(found.u, scene.slip)
            load = scene.friction * self.buffers.normal
            found.g[:] += load * slope - found.friction
            found.friction[:] = load * slope
            sums.potential += load @ value - sums.friction
            sums.friction = load @ value
        return sums.potential

    def follow(self, dx, share, step, found):
        return True

    def project(self, x):
        return False

    def covers_projection(self, x):
        return True

    def write(self, out, k, state, found):
        row, book, totals = out.rows[k], state.book[0], state.totals[0]
        row.time, row.reaction = totals.time, totals.reaction
        row.wells, row.springs = state.stored[WELLS], state.stored[SPRINGS]
        for name in ("work", "kinetic", "material", "friction", "integrator", "residual"):
            row[name] = book[name]
        out.positions[k] = state.x


class Line(NamedTuple):
    """The data of a chain. height: of the hill between two wells, J; width: half their distance, m.

    spring, apart: stiffness, N/m, and rest length, m. friction, weight, slip: coefficient, n in
    N, smoothing in m.
    """

    coordinates: Coordinates
    height: float
    width: float
    spring: float
    apart: float
    friction: float
    weight: float
    slip: float

    def well(self, x):
        """Return the energies of particles at ``x`` (n,) and their two derivatives."""
        s = x / self.width
        hill = s * s - 1.0
        slope = 4.0 * self.height * s * hill / self.width
        return self.height * hill**2, slope, 4.0 * self.height * (3.0 * s * s - 1.0) / self.width**2

    def make_buffers(self, memory):
        n = self.coordinates.role.size
        return Buffers(np.zeros(n), np.zeros((n, n)), np.zeros(n), np.full(1, -1))

    def find_neighbours(self, x):
        return Neighbours(x.copy())

    def renew_neighbours(self, neighbours, x, far):
        return Neighbours(x.copy())

    def assemble(self, neighbours, buffers):
        return Chain(self, neighbours, buffers)
