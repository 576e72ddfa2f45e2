"""Steps through a stage of loading, shorter ones where one fails or errs, and keeps the book."""

from typing import NamedTuple

import numpy as np

from kernels.terms import damping as damp, friction, inertia
from kernels.solve import friction_loop as lagging, integrators as scheme
from kernels.solve.residual import loosened
from kernels.solve.energy_book import INTEGRATOR, KINETIC, enter, made, move_apart, strike, unbalanced
from kernels.compile.jit import jit_exact, jit_owning
from kernels.solve.newton import CONVERGED, INTERRUPTED, ITERATIONS, OUTGROWN, minimise
from kernels.solve.workspace import HEAVY, LAGGED, PREDICTED, Room, make_room
from kernels.arrays import copy, zero
from kernels.solve.integrators import BACKWARD_EULER, BDF2, POSITION
from kernels.planar.potential import Step, covers, drift, find_near, holds_crowd, renew, travel
from kernels.planar.rows import LAST, NOW, SPENT, STEPS, write

SMALLEST = 2.0**-24  # share of a step
LONGER = 0.1  # of the error that is allowed: the next step may be twice as long
FURTHER = 2.0  # times the last step: a longer one is not extrapolated
EASY_LOOPS = 10  # of friction: after more of them the next step is no longer
GIFT = 2e-3  # of all energy: what backward Euler may make, and once more in all further steps
SHORT = 2.0**-12  # share of a step that may make more: the run is judged at its end
INACCURATE, UNBALANCED = 7, 9  # outcomes, beside those of `newton` and `lagging`
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
            ("relaxed", np.float64),  # share of the last approach (`relax`)
            ("nearest", np.float64),  # least residual when friction was lagged anew, N
            ("circles", np.int64),  # loops since then
            ("rough", np.float64),  # times the tolerance to which the next minimum is found
            ("far", np.float64),  # that a node goes in a move which the pairs must cover, m
            ("length", np.float64),  # h of the last share tried, s
        ],
    )
)


class Stage(NamedTuple):
    """Linear ramps of the load factor and of the driven coordinate (m) from ``*0`` to ``*1``.

    steps: number. dt: duration of one in s, infinite if static. pace: time of one in s. scheme: the
    integrator. error: allowed to a step by itself, m.
    """

    steps: int
    dt: float
    pace: float
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
def _set_out(terms, stage, unknowns, state, near, room, progress):
    """Set out on the next share of a step, from where the last one ended and, unless that snapped,
    on as it went.
    """
    if stage.scheme != BACKWARD_EULER and state.totals[LAST] == 0.0:
        progress.share = min(progress.share, scheme.FIRST)
    before, at, work, grips, way = room
    x, dt, last = state.x, stage.dt * progress.share, state.totals[LAST]
    driven, more, remaining = unknowns.driven, 0.0, 0.0
    if driven >= 0:
        remaining = _target(stage, progress) - x[driven]
        if remaining * at.u[driven] > 0.0 and abs(remaining) <= FURTHER * abs(at.u[driven]):
            more = remaining / at.u[driven]
    h = scheme.length(stage.scheme, dt, last)
    if h != progress.length:  # the next Hessian is another
        progress.length, work.kept[0] = h, np.inf
    copy(x, before.x0)
    copy(x, way[LAGGED])
    if dt == np.inf:
        copy(x, before.y)
        if more * travel(at.u, terms) > max(unknowns.cap, FURTHER * abs(remaining)):
            more = 0.0  # it snapped
        for i in range(x.size):
            work.dx[i] = more * at.u[i]
    else:
        if driven >= 0 and stage.scheme != BACKWARD_EULER and last == 0.0:
            strike(state, terms.layout, terms.mass, remaining / dt)
        scheme.set_out(state, dt, h, way[HEAVY], before.y, way[PREDICTED], work.dx)
    if more > 0.0:
        work.dx[driven] = remaining
    ahead = dt - h if h < dt else 0.0
    last = last if stage.scheme == BDF2 else 0.0
    rate = state.rates[POSITION]
    damp.prepare(terms, before, damp.Ahead(ahead, last, rate, work.dx, work.trial, at.shape))
    if terms.friction.mu > 0.0:
        held = grips.count[0]
        friction.lag(x, terms.contact, near.pairs, drift(x, terms, near), terms.friction, grips)
        if held + grips.count[0] > 0:  # the next Hessian is another
            work.kept[0] = np.inf
    progress.effort, progress.tried = 0, 0
    lagging.begin(progress)


@jit_exact
def _step(terms, stage, room, progress):
    """Return the `Step` of the share that is tried."""
    dt, h, slip = stage.dt * progress.share, progress.length, terms.friction.slip
    factor = stage.factor0 + (stage.factor1 - stage.factor0) * _part(stage, progress)
    if dt < np.inf:
        slip *= h
    theta = scheme.weight(h, dt)
    return Step(room.before, room.way[PREDICTED], h, factor, room.grips, slip, theta)


@jit_exact
def _balance(x, target, terms, step, near, unknowns, tolerance, room, control, progress):
    """Minimise until friction agrees with where it was lagged; return the outcome."""
    outcome, there = CONVERGED, False
    while True:
        rough = loosened(tolerance, progress.rough)
        outcome, spent, progress.far = minimise(
            x, target, terms, step, near, unknowns, rough, room.at, room.work, control, there
        )
        there = True
        progress.spent, progress.effort = progress.spent + spent, progress.effort + spent
        progress.tried += max(spent, 1)
        if outcome != CONVERGED or terms.friction.mu == 0.0:
            break
        if lagging.agrees(x, terms, step, near, unknowns, tolerance, room, progress):
            break
        if lagging.in_vain(progress):
            outcome = lagging.UNSETTLED
            break
    return outcome


@jit_exact
def _invents(terms, stage, state, at, share, noise):
    """Return whether a step of backward Euler makes energy that none was lost for before."""
    gain, there = made(state, at, terms.mass, stage.dt * share)
    enough = GIFT * there + noise
    return gain - state.book[INTEGRATOR] > enough and gain > enough * share / stage.steps


@jit_exact
def _judged(terms, stage, state, step, noise, room, progress):
    """Return whether a step is accurate, and its error as a share of what is allowed."""
    dt, strayed = stage.dt * progress.share, 0.0
    if stage.error < np.inf:
        error = scheme.error(state, room.before.x0, dt, step.dt, room.way[HEAVY])
        strayed = error / stage.error
    fine = strayed <= 1.0
    if fine and step.dt == dt < np.inf and progress.share > SHORT:
        fine = not _invents(terms, stage, state, room.at, progress.share, noise)
    return fine, strayed


@jit_exact
def _step_back(outcome, state, room, progress):
    """Return to where a step set out, for a shorter one."""
    copy(room.before.x0, state.x)
    zero(room.at.least)  # what was found last was found elsewhere
    zero(room.at.u)
    if outcome != INACCURATE:
        progress.failed += 1
    progress.share *= 0.5 ** max(progress.failed, 1)  # the oftener, the more boldly
    progress.loops, room.work.kept[0] = AT_START, np.inf


@jit_exact
def _settle(terms, unknowns, stage, step, state, near, room, progress):
    """Stay where a step has led, and book it."""
    dt, at, work = stage.dt * progress.share, room.at, room.work
    if dt < np.inf:
        lost = scheme.arrive(stage.scheme, state, step, dt, terms, room.way[HEAVY], at.u)
        state.book[INTEGRATOR] += lost
        state.book[KINETIC] = inertia.kinetic(state.v, terms.mass)
        state.totals[LAST] = dt
    enter(terms, step, unknowns, state, at, work)
    move_apart(terms, step, state, near, at, work)
    state.totals[STEPS] += 1


@jit_exact
def _advance(strayed, iterations, work, progress):
    """Count a share as done; the next one is twice as long if this was easy and that fits."""
    easy = strayed < LONGER and progress.effort <= iterations and progress.loops <= EASY_LOOPS
    progress.done, progress.failed, progress.loops = progress.done + progress.share, 0, AT_START
    if progress.share < 1.0:  # the next Hessian is another
        work.kept[0] = np.inf
    if easy and progress.done % (2.0 * progress.share) == 0.0:
        progress.share *= 2.0


@jit_exact
def _go(terms, unknowns, tolerance, stage, state, out, control, near, room, progress):
    """March on from where ``progress`` says, until the stage ends or pairs must be found anew.

    Return the outcome and the rows written.
    """
    while progress.row < stage.steps:
        if progress.loops == AT_START:
            if not covers(near, state.x, terms, 0.0):  # after a step back
                progress.far = 0.0
                return OUTGROWN, progress.row
            _set_out(terms, stage, unknowns, state, near, room, progress)
        step, target = _step(terms, stage, room, progress), _target(stage, progress)
        outcome = _balance(
            state.x, target, terms, step, near, unknowns, tolerance, room, control, progress
        )
        if outcome == CONVERGED and not holds_crowd(near, state.x, terms):
            outcome, progress.tried = OUTGROWN, 0
            zero(room.work.dx)
        if outcome == OUTGROWN and progress.tried <= tolerance.iterations:
            if stage.dt < np.inf:
                zero(room.work.dx)  # where it was is the better guess
            return outcome, progress.row
        strayed = 0.0
        if outcome == CONVERGED:
            fine, strayed = _judged(terms, stage, state, step, tolerance.noise, room, progress)
            outcome = CONVERGED if fine else INACCURATE
            x0, at, work = room.before.x0, room.at, room.work
            if fine and unbalanced(x0, unknowns, tolerance, state, at, work):
                outcome = UNBALANCED
        if outcome != CONVERGED:
            _step_back(outcome, state, room, progress)
            if outcome == INTERRUPTED or progress.share < SMALLEST:
                return (ITERATIONS if outcome == OUTGROWN else outcome), progress.row
            continue
        _settle(terms, unknowns, stage, step, state, near, room, progress)
        _advance(strayed, tolerance.iterations, room.work, progress)
        if progress.done == 1.0:
            state.totals[SPENT] += progress.spent
            state.totals[NOW] += stage.pace
            write(out, progress.row, state, terms, near, unknowns, room.at)
            control[1] += 1
            progress.row, progress.done, progress.spent = progress.row + 1, 0.0, 0
    return CONVERGED, progress.row


@jit_owning
def march(terms, unknowns, tolerance, stage, state, out, control):
    """March through ``stage`` from ``state`` (changed in place); fill ``out``.

    Return (outcome, rows written). ``control`` (2,): [0] != 0 interrupts, [1] counts steps done.
    """
    progress = np.zeros(1, PROGRESS)
    progress[0].share, progress[0].loops = 1.0, AT_START
    if stage.error < np.inf and state.totals[LAST] > 0.0:
        progress[0].share = state.totals[LAST] / stage.dt
    near = find_near(state.x, terms, friction.none(), 0.0)
    room = make_room(terms, near)
    while True:
        outcome, rows = _go(
            terms, unknowns, tolerance, stage, state, out, control, near, room, progress[0]
        )
        if outcome != OUTGROWN:
            return outcome, rows
        near = renew(near, state.x, terms, room.grips, progress[0].far)  # a factor is kept, unless
        # the matrix lacked room: then it is known to be of no use
        wider = friction.room(near.pairs, terms.contact, terms.friction)
        if wider.load.size > room.grips.load.size:
            grips = friction.moved(room.grips, wider)
            room = Room(room.before, room.at, room.work, grips, room.way)
