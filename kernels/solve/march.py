"""Steps through a stage of loading, shorter ones where one fails or errs, and keeps the book."""

from typing import NamedTuple

import numpy as np

from kernels.arrays import copy, zero
from kernels.compile.jit import jit_exact, jit_owning
from kernels.compile.reference import by_reference
from kernels.solve import energy_book, friction_loop, integrators
from kernels.solve.energy_book import enter, kinetic, made, strike, unbalanced
from kernels.solve.integrators import BACKWARD_EULER, BDF2, Ahead
from kernels.solve.newton import CONVERGED, DESCENT, INTERRUPTED, ITERATIONS, OUTGROWN, minimise
from kernels.solve.problem import Step
from kernels.solve.residual import loosened
from kernels.solve.workspace import make_workspace

SMALLEST = 2.0**-24  # share of a step
LONGER = 0.1  # of the error that is allowed: the next step may be twice as long
FURTHER = 2.0  # times the last step: a longer one is not extrapolated
EASY_LOOPS = 10  # of friction: after more of them the next step is no longer
GIFT = 2e-3  # of all energy: what backward Euler may make, and once more in all further steps
SHORT = 2.0**-12  # share of a step that may make more: the run is judged at its end
INACCURATE, UNBALANCED = 7, 9  # outcomes, beside those of `newton` and `friction_loop`
AT_START = -1  # loops of friction before `_set_out`
PROGRESS = np.dtype(
    (
        np.record,  # for attributes in plain Python too
        [
            ("row", np.int64),  # the next one of the history
            ("done", np.float64),  # share of the row's step that is done
            ("share", np.float64),  # share of the row's step that is tried now
            ("failed", np.int64),  # tries since a share was done
            ("spent", np.int64),  # Newton iterations for the row
            ("effort", np.int64),  # Newton iterations for the share
            ("tried", np.int64),  # Newton iterations for the minimum that is looked for
            ("loops", np.int64),  # of friction in the share
            ("relaxed", np.float64),  # share of the last approach (`aitken`)
            ("nearest", np.float64),  # least residual when friction was lagged anew, N
            ("circles", np.int64),  # loops since then
            ("rough", np.float64),  # times the tolerance to which the next minimum is found
            ("h", np.float64),  # of the last share tried, s
        ],
    )
)


class Stage(NamedTuple):
    """Linear ramps of the load factor and of the driven coordinate (m) from ``*0`` to ``*1``.

    steps: number. duration: of one in s. dynamic: whether there is inertia; a static step has a
    duration all the same, for materials with a rate. scheme: the integrator. error: allowed to a
    step by itself, m.
    """

    steps: int
    duration: float
    dynamic: bool
    factor0: float
    factor1: float
    driven0: float
    driven1: float
    scheme: int = BACKWARD_EULER
    error: float = np.inf


@jit_exact
def _part(stage, progress):
    """Return how much of the stage is done at the end of the share that is tried."""
    return (progress.row + progress.done + progress.share) / stage.steps


@jit_exact
def _target(stage, progress):
    """Return where the driven coordinate is to be then, m."""
    return stage.driven0 + (stage.driven1 - stage.driven0) * _part(stage, progress)


@jit_exact
def _step(stage, space, progress):
    """Return the `Step` of the share that is tried."""
    duration = stage.duration * progress.share
    factor = stage.factor0 + (stage.factor1 - stage.factor0) * _part(stage, progress)
    theta = integrators.weight(progress.h, duration, stage.dynamic)
    return Step(space.x0, space.y, space.x_pred, progress.h, duration, stage.dynamic, factor, theta)


@jit_exact
def _onwards(u, driven, remaining):
    """Return how many times the last move ``u`` the driven coordinate has to go: 0 where that tells
    nothing of this step.
    """
    if driven < 0 or not 0.0 < remaining * u[driven] or abs(remaining) > FURTHER * abs(u[driven]):
        return 0.0
    return remaining / u[driven]


@jit_exact
def _set_out(problem, stage, state, space, descent, progress):
    """Set out on the next share of a step, from where the last one ended.

    The descent begins at the extrapolated position; where the last static step snapped, at x0.
    """
    last = state.totals[0].last
    if stage.scheme != BACKWARD_EULER and last == 0.0:
        progress.share = min(progress.share, integrators.FIRST)
    duration, coordinates = stage.duration * progress.share, problem.scene.coordinates
    u, work, driven, remaining = space.found.u, space.work, coordinates.driven, 0.0
    if driven >= 0:
        remaining = _target(stage, progress) - state.x[driven]
    more = _onwards(u, driven, remaining)
    h = integrators.length(stage.scheme, duration, last)
    if stage.dynamic and h != progress.h:  # the next Hessian is another
        descent.kept = np.inf
    progress.h = h
    copy(state.x, space.x0)
    copy(state.x, space.lagged)
    if stage.dynamic:
        if driven >= 0 and stage.scheme != BACKWARD_EULER and last == 0.0:
            strike(state, problem, remaining / duration, work.direction)
        heavy = coordinates.heavy
        integrators.set_out(state, duration, h, heavy, space.y, space.x_pred, work.dx)
    else:
        copy(state.x, space.y)
        if more * problem.travel(u) > max(coordinates.cap, FURTHER * abs(remaining)):
            more = 0.0  # it snapped
        for i in range(u.size):
            work.dx[i] = more * u[i]
    if more > 0.0:
        work.dx[driven] = remaining
    ahead = duration - h if h < duration else 0.0
    last = last if stage.scheme == BDF2 else 0.0
    rates = Ahead(ahead, last, state.rates.position, work.dx)
    problem.begin(_step(stage, space, progress), rates, work.trial)
    if problem.lag(state.x):  # the next Hessian is another
        descent.kept = np.inf
    progress.effort, progress.tried = 0, 0
    friction_loop.begin(progress)


@jit_exact
def _balance(x, target, problem, step, tolerance, space, descent, control, progress):
    """Minimise until the forces that lag agree with where they were lagged; return the outcome."""
    outcome, there = CONVERGED, False
    while True:
        rough = loosened(tolerance, progress.rough)
        outcome = minimise(x, target, problem, step, rough, space, descent, control, there)
        there = True
        progress.spent += descent.iterations
        progress.effort += descent.iterations
        progress.tried += max(descent.iterations, 1)
        if outcome != CONVERGED or not problem.lags():
            break
        if friction_loop.agrees(x, problem, step, tolerance, space, progress):
            break
        if friction_loop.in_vain(progress):
            outcome = friction_loop.UNSETTLED
            break
    return outcome


@jit_exact
def _invents(problem, stage, state, found, share, noise):
    """Return whether a step of backward Euler makes energy that none was lost for before."""
    gain, there = made(state, found, problem.scene.coordinates.mass, stage.duration * share)
    enough = GIFT * there + noise
    return gain - state.book[0].integrator > enough and gain > enough * share / stage.steps


@jit_exact
def _judged(problem, stage, state, step, noise, space, progress):
    """Return whether a step is accurate, and its error as a share of what is allowed."""
    strayed = 0.0
    if stage.error < np.inf:
        strayed = integrators.error(state, step, problem.scene.coordinates.heavy) / stage.error
    fine, first_order = strayed <= 1.0, stage.dynamic and step.h == step.duration
    if fine and first_order and progress.share > SHORT:
        fine = not _invents(problem, stage, state, space.found, progress.share, noise)
    return fine, strayed


@jit_exact
def _step_back(outcome, problem, step, state, space, descent, progress):
    """Return to where a step set out, for a shorter one."""
    copy(space.x0, state.x)
    problem.roll_back(step)
    zero(space.found.u)
    if outcome != INACCURATE:
        progress.failed += 1
    progress.share *= 0.5 ** max(progress.failed, 1)  # the oftener, the more boldly
    progress.loops, descent.kept = AT_START, np.inf


@jit_exact
def _settle(problem, stage, step, state, space, descent):
    """Accept where a step has led, and book it."""
    found, work, book, totals = space.found, space.work, state.book[0], state.totals[0]
    if stage.dynamic:
        book.integrator += integrators.arrive(stage.scheme, state, step, problem, found.u)
        book.kinetic = kinetic(state.v, problem.scene.coordinates.mass)
        totals.last = step.duration
    problem.commit(state.x, step, found)
    enter(problem, step, state, found, work)
    if energy_book.project(problem, step, state, found, work.trial):
        descent.kept = np.inf
    totals.steps += 1


@jit_exact
def _advance(strayed, iterations, descent, progress):
    """Count a share as done; the next one is twice as long if this was easy and that fits."""
    easy = strayed < LONGER and progress.effort <= iterations and progress.loops <= EASY_LOOPS
    progress.done, progress.failed, progress.loops = progress.done + progress.share, 0, AT_START
    if progress.share < 1.0:  # the next Hessian is another
        descent.kept = np.inf
    if easy and progress.done % (2.0 * progress.share) == 0.0:
        progress.share *= 2.0


@jit_exact
def _go(problem, tolerance, stage, state, out, control, space, descent, progress):
    """March on from where ``progress`` says, until the stage ends or the problem must be renewed.

    Return the outcome and the rows written.
    """
    work, totals = space.work, state.totals[0]
    while progress.row < stage.steps:
        if progress.loops == AT_START:
            if not problem.covers(state.x, 0.0):  # after a step back
                descent.far = 0.0
                return OUTGROWN, progress.row
            _set_out(problem, stage, state, space, descent, progress)
        step, target = _step(stage, space, progress), _target(stage, progress)
        outcome = _balance(
            state.x, target, problem, step, tolerance, space, descent, control, progress
        )
        if outcome == CONVERGED and not problem.covers_projection(state.x):
            outcome, progress.tried = OUTGROWN, 0
            zero(work.dx)
        if outcome == OUTGROWN and progress.tried <= tolerance.iterations:
            if stage.dynamic:
                zero(work.dx)  # where it was is the better guess
            return outcome, progress.row
        strayed = 0.0
        if outcome == CONVERGED:
            fine, strayed = _judged(problem, stage, state, step, tolerance.noise, space, progress)
            outcome = CONVERGED if fine else INACCURATE
            if fine and unbalanced(step.x0, problem, tolerance, state, space.found, work):
                outcome = UNBALANCED
        if outcome != CONVERGED:
            _step_back(outcome, problem, step, state, space, descent, progress)
            if outcome == INTERRUPTED or progress.share < SMALLEST:
                return (ITERATIONS if outcome == OUTGROWN else outcome), progress.row
            continue
        _settle(problem, stage, step, state, space, descent)
        _advance(strayed, tolerance.iterations, descent, progress)
        if progress.done == 1.0:
            totals.iterations += progress.spent
            totals.time += stage.duration
            problem.write(out, progress.row, state, space.found)
            control[1] += 1
            progress.row, progress.done, progress.spent = progress.row + 1, 0.0, 0
    return CONVERGED, progress.row


@jit_owning
def march(scene, tolerance, stage, state, out, control):
    """March through ``stage`` from ``state`` (changed in place); fill ``out``.

    scene: `problem.Scene`. Return (outcome, rows written). ``control`` (2,): [0] != 0 interrupts,
    [1] counts steps done.
    """
    progress, descent = np.zeros(1, PROGRESS), np.zeros(1, DESCENT)
    progress[0].share, progress[0].loops, descent[0].kept = 1.0, AT_START, np.inf
    last = state.totals[0].last
    if stage.error < np.inf and last > 0.0:
        progress[0].share = last / stage.duration
    neighbours, buffers = scene.find_neighbours(state.x), scene.make_buffers(state.memory)
    space = make_workspace(state.x.size, state.stored.size)
    while True:
        problem = by_reference(scene).assemble(by_reference(neighbours), by_reference(buffers))
        outcome, rows = _go(
            problem, tolerance, stage, by_reference(state), out, control,
            by_reference(space), descent[0], progress[0],
        )  # fmt: skip
        if outcome != OUTGROWN:
            return outcome, rows
        # A factor outlives its pairs; if the matrix will be another, `minimise` has given it up.
        neighbours = scene.renew_neighbours(neighbours, state.x, descent[0].far)
