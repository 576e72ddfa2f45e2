"""The inside of a step as tests reach it: the one place that knows how its kernels are called."""

from dataclasses import dataclass, replace
from typing import NamedTuple
from unittest.mock import patch

import numpy as np

from kernels.compile.reference import by_reference, referred
from kernels.linear.condensed import periodic_images
from kernels.planar import problem as planar
from kernels.planar.problem import Planar
from kernels.shared.rows import ROW, STORED, Output
from kernels.solve import march, newton, outcomes
from kernels.solve.problem import FREE, NEGATIVE, NO_ROOM, Evaluation, Step
from kernels.solve.workspace import make_workspace
from kernels.terms import contact, fold, friction, spring
from sweep.scene.lattice import build_scene
from sweep.scene.loading import tolerances
from tests.support.kernels.terms import assembled, dense, full_matrix, nowhere

RUN = np.zeros(2, dtype=np.int64)  # nobody asks to stop


@dataclass(frozen=True)
class Whole:
    """All that a step minimises, as one term."""

    problem: Planar
    step: Step

    @property
    def terms(self):
        """The data of all terms."""
        return self.problem.scene

    @property
    def neighbours(self):
        """Pairs, system and lagged friction of some state."""
        return self.problem.neighbours

    def beside(self, neighbours):
        """The same with other neighbours."""
        return replace(self, problem=self.problem._replace(neighbours=by_reference(neighbours)))

    def lagging(self, lagged_contacts):
        """The same with other contacts that have friction."""
        return self.beside(referred(self.neighbours)._replace(lagged_contacts=lagged_contacts))

    def found(self, x) -> tuple[float, Evaluation]:
        """Energy and other results of `evaluate` at ``x``."""
        found = make_workspace(x.size, STORED).evaluation
        return self.problem.evaluate(x, self.step, found), found

    def energy_gradient(self, x):
        """Energy and gradient (n,) at ``x``."""
        energy, found = self.found(x)
        return energy, found.g

    def energy(self, x):
        """Energy at ``x``."""
        return self.found(x)[0]

    def gradient(self, x):
        """Gradient (n,) at ``x``."""
        return self.found(x)[1].g

    def hessian(self, x):
        """Hessian (n, n) at ``x``, put together apart from `factoring.factor`."""
        _, found = self.found(x)
        terms, matrix, step = self.terms, full_matrix(x.size), self.step
        fold.hessian(x, terms.fold, matrix)
        spring.hessian(x, terms.spring, matrix)
        neighbours = self.neighbours
        contact.hessian(x, terms.contact, neighbours.pairs, neighbours.touching, matrix)
        friction.hessian(found.u, self.neighbours.lagged_contacts, self.slip, matrix)
        walls = assembled(terms.walls, self.problem.buffers.stiffness, x.size)
        inert = (1.0 / step.h + terms.damp.alpha_m) / step.h * step.dynamic
        return walls + dense(matrix) + np.diag(inert * terms.coordinates.mass)

    @property
    def slip(self):
        """Slip below which friction is smoothed, m."""
        return self.terms.friction.slip * (self.step.h if self.step.dynamic else 1.0)

    def factor(self, x, shift=0.0):
        """Whether there is a negative pivot at ``x``, the first one; whether room is lacking."""
        _, found = self.found(x)
        result, pivot = self.problem.factor(x, self.step, found, shift, False)
        return result == NEGATIVE, pivot, result == NO_ROOM

    def solve(self, b):
        """Solution (n,) for a right side ``b`` (n,) after `factor`."""
        y = b.copy()
        self.problem.solve(y)
        return y

    def escape(self):
        """Direction (n,) of negative curvature after a `factor` that has met it."""
        d = np.zeros(self.terms.coordinates.mass.size)
        self.problem.descend(d)
        return d

    def limit(self, x, dx):
        """Share of the move ``dx`` from ``x`` that is admissible."""
        self.found(x)
        nodes = dx[: 2 * self.terms.layout.n_nodes]
        most = max(np.abs(nodes).max(), np.abs(dx[-2:]).max())
        return self.problem.step_limit(x, dx, most)


def neighbours_of(x, terms, move=0.0):
    """`Neighbours` at ``x`` for a ``move`` (m), in the plane or in space, with friction lagged
    there and room for it.
    """
    found = terms.find_neighbours(x)
    found.lagged_contacts.lag(x, terms.contact, found.pairs, 0.0, terms.friction)
    (found.matrix if hasattr(found, "matrix") else found.system.matrix).missing[0] = 1
    return terms.renew_neighbours(found, x, move)


def whole(scene, x, x0=None, dt=np.inf, v=None, factor=1.0, reach=0.0):
    """A step from x0 (``x``) and v (0), with pairs within ``reach`` of ``x``; friction lags at x.

    It is static if ``dt`` is infinite.
    """
    terms, x0 = scene.terms, (x if x0 is None else x0).copy()
    dynamic = bool(dt < np.inf)
    h = dt if dynamic else 1.0
    x_pred = x0.copy() if v is None else x0 + dt * v
    problem = Planar(
        by_reference(terms), by_reference(neighbours_of(x, terms, reach)),
        by_reference(terms.make_buffers(np.empty((0, 0)))),
    )  # fmt: skip
    one = Step(x0, x0, x_pred, h, h, dynamic, factor, 1.0, 1.0, 0.0)
    problem.begin(one, nowhere(x.size), np.zeros(x.size))
    return Whole(problem, one)


def reduction(scene):
    """Matrix (n, free) from unknowns to coordinates: tied ones follow their leader."""
    leader, free = scene.terms.layout.leader, free_of(scene)
    return (leader[:, None] == np.array(free)).astype(float)


def moves(layout):
    """Coordinates (k,) that follow no other, the driven one last, and the moves (n, k) of all
    coordinates by theirs: tied ones by their ratio, periodic images by two others.
    """
    images = getattr(layout, "images", periodic_images.NONE)
    own = np.setdiff1d(np.flatnonzero(layout.leader == np.arange(layout.leader.size)), images[:, 0])
    follows = (layout.leader[:, None] == own) * layout.ratio[:, None]
    for c, of, mean, times in images:
        follows[c] = times * follows[mean] + (follows[of] if of >= 0 else 0.0)
    return own, follows


def residual(scene, x, args):
    """Forces (free,) out of balance in N, the driven one left out."""
    R = reduction(scene)
    return R.T @ args.gradient(x) / (R.T @ scene.terms.coordinates.scale / R.sum(axis=0))


def free_of(scene):
    """Coordinates that move by themselves."""
    return np.flatnonzero(scene.terms.coordinates.role == FREE)


def shaken(scene, x, seed, share):
    """All that is free moved at random, by up to a share of an element or of 1 rad."""
    free, h = free_of(scene), scene.mesh.rest_length.mean()
    amount = np.where(scene.terms.coordinates.scale[free] == 1.0, h, 1.0)
    moved = x.copy()
    moved[free] += share * amount * np.random.default_rng(seed).uniform(-1, 1, free.size)
    return moved


class Descent(NamedTuple):
    """How a minimisation ended, and where."""

    outcome: int
    iterations: int
    x: np.ndarray


def descend(
    case, scene, start, args, target=None, control=RUN, move=None, evaluated=False, **tolerance
):
    """Minimise from ``start``, moved by ``move``, with the platen at ``target`` (where it is).

    evaluated: whether ``start`` has been evaluated before.
    """
    x, workspace = start.copy(), make_workspace(start.size, STORED)
    descent, problem, done = np.zeros(1, newton.DESCENT)[0], args.problem, 0
    allowed = tolerances(case, scene, like(args.step))._replace(**tolerance)
    descent.target, descent.since_factor = x[-1] if target is None else target, np.inf
    descent.evaluated = evaluated
    workspace.work.dx[:] = 0.0 if move is None else move
    if evaluated:
        workspace.work.trial[:] = x
        problem.evaluate(x, args.step, workspace.evaluation)
    while True:
        left = allowed._replace(iterations=allowed.iterations - done)
        outcome = newton.minimise(
            x, problem, args.step, left, by_reference(workspace), descent, control
        )
        done += int(descent.iterations)
        if outcome != outcomes.OUTGROWN:
            return Descent(outcome, done, x)
        neighbours = neighbours_of(x, scene.terms, descent.travel_bound)._replace(
            lagged_contacts=problem.neighbours.lagged_contacts
        )
        problem = problem._replace(neighbours=by_reference(neighbours))
        workspace.work.dx[:], descent.since_factor = 0.0, np.inf


def like(step):
    """A stage of one such step, in which nothing changes."""
    return march.Stage(1, step.duration, step.dynamic, 0.0, 0.0, 0.0, 0.0)


def at_rest(scene):
    """State of a march that begins."""
    return planar.at_rest(scene.terms, scene.x_rest)


def ramp(scene, steps, dt=np.inf, factor=(0.0, 0.0), travel=(0.0, 0.0)):
    """Stage in which the load factor and the platen's way down (m) go from one value to another.

    It is static where ``dt`` is infinite.
    """
    high, dynamic = scene.x_rest[-1], bool(dt < np.inf)
    duration = dt if dynamic else 1.0
    return march.Stage(steps, duration, dynamic, *factor, high - travel[0], high - travel[1])


def go_on(case, scene, state, stage, control=RUN, frames=None, **tolerance):
    """March ``state`` through a stage; return the outcome and the rows written.

    frames (steps, n): filled with the shapes.
    """
    frames = np.zeros((0, state.x.size)) if frames is None else frames
    out = Output(
        np.zeros(stage.steps, ROW), np.where(len(frames), np.arange(stage.steps), -1),
        frames, scene.bottom, scene.top, scene.base,
        scene.probes, np.zeros((stage.steps, 2, scene.probes.size)), scene.standing,
        np.zeros((scene.standing.size, 3)), 5e-3,
    )  # fmt: skip
    allowed = tolerances(case, scene, stage)._replace(**tolerance)
    outcome, written = march.march(scene.terms, allowed, stage, state, out, control)
    return outcome, out.rows[:written]


def floating(case):
    """The scene of a case without its supports: only the platens are held."""

    def leaders(numbering, *_):
        leader = np.arange(numbering.size)
        leader[[numbering.low, numbering.high]] = -1
        return leader

    with patch("sweep.scene.lattice.leaders", leaders):
        return build_scene(case)
