"""The inside of a step as tests reach it: the one place that knows how its kernels are called."""

from typing import NamedTuple
from unittest.mock import patch

import numpy as np

from kernels.terms import contact, damping as damp, fold, friction, spring
from kernels.solve import march, newton
from kernels.planar import potential as step, rows as trace
from kernels.linear import system
from sweep.scene.terms import build_scene
from sweep.scene.loading import tolerances
from tests.terms import assembled, dense, full_matrix, nowhere, room

RUN = np.zeros(2, dtype=np.int64)  # nobody asks to stop


class Whole(NamedTuple):
    """All that a step minimises, as one term; ``near``: pairs and system of some state."""

    terms: step.Terms
    step: step.Step
    near: step.Near

    def found(self, x, projected=False):
        """Energy and what else `evaluate` finds at ``x``."""
        at = step.At(*np.zeros((5, x.size)), *map(np.zeros, (3, 2, 2)), *room(self.terms.walls))
        return step.evaluate(x, self.terms, self.step, self.near, at, projected), at

    def energy(self, x):
        """Energy at ``x``."""
        return self.found(x)[0]

    def gradient(self, x):
        """Gradient (n,) at ``x``."""
        return self.found(x)[1].g

    def hessian(self, x, projected=False):
        """Hessian (n, n) at ``x``, put together apart from `step.factor`."""
        _, at = self.found(x, projected)
        terms, dt, matrix = self.terms, self.step.dt, full_matrix(x.size)
        fold.hessian(x, terms.fold, matrix, projected)
        spring.hessian(x, terms.spring, matrix, projected)
        contact.hessian(x, terms.contact, self.near.pairs, matrix, projected)
        friction.hessian(at.u, self.step.grips, self.step.slip, matrix, projected)
        inert = (1.0 / dt + terms.damp.alpha_m) / dt * terms.mass
        return assembled(terms.walls, at.stiffness, x.size) + dense(matrix) + np.diag(inert)

    def factor(self, x, projected=False):
        """Place of the first negative pivot at ``x``, and whether an entry had no room."""
        _, at = self.found(x, projected)
        place = step.factor(x, self.terms, self.step, self.near, at, projected, False)
        return place, bool(self.near.system.matrix.missing[0])

    def solve(self, b):
        """Solution (n,) for a right side ``b`` (n,) after `factor`."""
        y = b.copy()
        system.solve(self.near.system, self.terms.layout, y)
        return y

    def escape(self, place):
        """Direction (n,) of negative curvature after a `factor` that has met it."""
        d = np.zeros(self.terms.mass.size)
        wall, failed, _ = place
        system.descend(self.near.system, self.terms.layout, wall, failed, d)
        return d

    def limit(self, x, dx):
        """Share of the move ``dx`` from ``x`` that is admissible."""
        _, at = self.found(x)
        nodes = dx[: 2 * self.terms.layout.n_nodes]
        most = max(np.abs(nodes).max(), np.abs(dx[-2:]).max())
        return step.step_limit(x, dx, most, self.terms, self.near, at)


def gripped(x, terms, near):
    """What friction lags at ``x``."""
    grips = friction.room(near.pairs, terms.contact, terms.friction)
    friction.lag(x, terms.contact, near.pairs, np.inf, terms.friction, grips)
    return grips


def whole(scene, x, x0=None, dt=np.inf, v=None, factor=1.0, reach=0.0):
    """A step from x0 (``x``) and v (0), near ``x`` and what is in ``reach``; friction lags at x."""
    terms, x0 = scene.terms, x if x0 is None else x0
    x_pred = x0 if v is None else x0 + dt * v
    frame = np.full((terms.walls.rotation.size, 3), np.inf)
    before = damp.Before(x0.copy(), x0.copy(), frame, *room(terms.walls))
    damp.prepare(terms, before, nowhere(terms))
    grips = gripped(x, terms, step.find_near(x, terms, friction.none(), reach))
    slip = terms.friction.slip * (dt if dt < np.inf else 1.0)
    one = step.Step(before, x_pred.copy(), dt, factor, grips, slip, 1.0)
    return Whole(terms, one, step.find_near(x, terms, grips, reach))


def reduction(scene):
    """Matrix (n, free) from what is solved for to coordinates: tied ones go with their leader."""
    leader, driven = scene.unknowns.leader, scene.unknowns.driven
    free = [c for c in np.unique(leader[leader >= 0]) if c != driven]
    return (leader[:, None] == np.array(free)).astype(float)


def residual(scene, x, args):
    """Forces (free,) out of balance in N, the driven one left out."""
    R = reduction(scene)
    return R.T @ args.gradient(x) / (R.T @ scene.unknowns.scale / R.sum(axis=0))


def free_of(scene):
    """Coordinates that move by themselves."""
    leader = scene.unknowns.leader
    own = leader == np.arange(leader.size)
    own[scene.unknowns.driven] &= scene.unknowns.driven < 0
    return np.flatnonzero(own)


def shaken(scene, x, seed, share):
    """All that is free moved at random, by up to a share of an element or of 1 rad."""
    free, h = free_of(scene), scene.mesh.rest_length.mean()
    amount = np.where(scene.unknowns.scale[free] == 1.0, h, 1.0)
    moved = x.copy()
    moved[free] += share * amount * np.random.default_rng(seed).uniform(-1, 1, free.size)
    return moved


class Descent(NamedTuple):
    """How a minimisation ended, and where."""

    outcome: int
    iterations: int
    x: np.ndarray


def scratch(n):
    """Scratch of a minimisation that begins, with no factor at hand."""
    return newton.Work(*np.zeros((5, n)), np.full(1, np.inf))


def descend(
    case, scene, start, args, target=None, control=RUN, move=None, there=False, **tolerance
):
    """Minimise from ``start``, moved by ``move``, with the platen at ``target`` (where it is).

    ``there``: ``start`` has been evaluated before.
    """
    terms, one, _ = args
    x, work = start.copy(), scratch(start.size)
    at = step.At(*np.zeros((5, x.size)), *map(np.zeros, (3, 2, 2)), *room(terms.walls))
    allowed = tolerances(case, scene, one.dt)._replace(**tolerance)
    target, done, near = x[-1] if target is None else target, 0, args.near
    work.dx[:] = 0.0 if move is None else move
    if there:
        work.trial[:] = x
        step.evaluate(x, terms, one, near, at, False)
    while True:
        outcome, iterations, reach = newton.minimise(
            x, target, terms, one, near, scene.unknowns,
            allowed._replace(iterations=allowed.iterations - done), at, work, control, there,
        )  # fmt: skip
        done += iterations
        if outcome != newton.OUTGROWN:
            return Descent(outcome, done, x)
        near, there = step.find_near(x, terms, one.grips, reach), False
        work.dx[:], work.kept[0] = 0.0, np.inf


def at_rest(scene):
    """State of a march that begins."""
    n = scene.x_rest.size
    return trace.State(
        scene.x_rest.copy(), np.zeros(n), np.zeros(trace.TIME), np.zeros((2, n)), np.zeros((4, n)),
        np.zeros(3), np.zeros(2), np.zeros(4),
    )  # fmt: skip


def ramp(scene, steps, dt=np.inf, factor=(0.0, 0.0), travel=(0.0, 0.0)):
    """Stage in which the load factor and the platen's way down (m) go from one value to another."""
    high = scene.x_rest[-1]
    pace = dt if np.isfinite(dt) else 1.0
    return march.Stage(steps, dt, pace, *factor, high - travel[0], high - travel[1])


def go_on(case, scene, state, stage, control=RUN, **tolerance):
    """March ``state`` through a stage; return the outcome and the rows written."""
    out = trace.Output(
        np.zeros((stage.steps, trace.N_COLUMNS)), np.full(stage.steps, -1),
        np.zeros((0, state.x.size)), scene.bottom, scene.top, scene.base,
        scene.probes, np.zeros((stage.steps, 2, scene.probes.size)),
    )  # fmt: skip
    allowed = tolerances(case, scene, stage.dt)._replace(**tolerance)
    outcome, written = march.march(scene.terms, scene.unknowns, allowed, stage, state, out, control)
    return outcome, out.rows[:written]


def floating(case):
    """The scene of a case without its supports: only the platens are held."""
    with patch("sweep.scene.held", lambda layout, _: np.array([layout.low, layout.high])):
        return build_scene(case)
