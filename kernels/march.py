"""Steps through a stage of loading, with halved steps where one fails, and keeps the energy book.

Backward Euler: v' = (x' - x) / dt, loss 1/2 |v' - v|_M^2 + [grad U(x') . dx - dU].
Static: no inertia; work and loss by the trapezoidal rule, loss = 1/2 (grad U + grad U') . dx - dU.
"""

from typing import NamedTuple

import numpy as np

from kernels import damp, friction, inertia, project
from kernels.balance import allowed, largest, reduce
from kernels.caliper import height
from kernels.jit import jit_exact, jit_inlined, jit_owning
from kernels.newton import CONVERGED, INTERRUPTED, ITERATIONS, OUTGROWN, minimise
from kernels.relax import approach
from kernels.room import CHANGE, LAGGED, PREDICTED, make_room
from kernels.rows import copy, dot, total, zero
from kernels.step import Step, drift, find_near, holds_crowd, least_gap, rub, store

WORK, KINETIC, STRETCH, BEND, CONTACT, MATERIAL, FRICTION, INTEGRATOR = range(8)
INJECTED, RESIDUAL = 8, 9
TIME, HEIGHT, REACTION_TOP, REACTION_BOTTOM, ITERATIONS_DONE, GAP, SPEED = range(10, 17)
N_COLUMNS = 17
SMALLEST = 2.0**-21  # share of a step
FURTHER = 2.0  # times the last step: a longer one is not extrapolated
GRIP_LOOPS = 30  # fixed-point iterations of friction
# Of what is to be done: see `_go`. SPENT, EFFORT, TRIED: iterations for a row, a share, a minimum.
ROW, DONE, SHARE, FAILED, SPENT, EFFORT, TRIED, LOOPS, MOVE, RELAXED = range(10)


class Stage(NamedTuple):
    """Linear ramps of the load factor and of the driven coordinate (m) from ``*0`` to ``*1``.

    steps: number. dt: duration of one in s, infinite if static. pace: time of one in s.
    """

    steps: int
    dt: float
    pace: float
    factor0: float
    factor1: float
    driven0: float
    driven1: float


class State(NamedTuple):
    """Where the march is. x, v (n,): position and velocity. book (10,): energy book in J.

    elastic, rubbing (n,), stored (3,), held (2,): gradients of the stored energy and of friction,
    stored energies, driven reaction (N) and load factor at the last step. totals (3,): iterations,
    steps, time in s.
    """

    x: np.ndarray
    v: np.ndarray
    book: np.ndarray
    elastic: np.ndarray
    rubbing: np.ndarray
    stored: np.ndarray
    held: np.ndarray
    totals: np.ndarray


class Output(NamedTuple):
    """rows (steps, N_COLUMNS); frame_of (steps,): slot of a step in frames (f, n) or -1.

    bottom: coordinates whose supports make the lower reaction. top, base: see `height`. probed
    (steps, 2, k): value and reaction of the coordinates ``probes`` (k,).
    """

    rows: np.ndarray
    frame_of: np.ndarray
    frames: np.ndarray
    bottom: np.ndarray
    top: np.ndarray
    base: np.ndarray
    probes: np.ndarray
    probed: np.ndarray


@jit_inlined
def enter(terms, step, unknowns, state, at, work):
    """Add one converged step, found by the last `evaluate`, to the energy book."""
    book, dynamic = state.book, step.dt < np.inf
    theta = 1.0 if dynamic else 0.5
    held, lead = 0.0, 0.0
    if unknowns.driven >= 0:
        reduce(at.g, unknowns, work.residual)
        held, lead = work.residual[unknowns.driven], at.u[unknowns.driven]
    factor = theta * step.factor + (1.0 - theta) * state.held[1]
    book[WORK] += factor * dot(terms.load, at.u)
    book[WORK] += (theta * held + (1.0 - theta) * state.held[0]) * lead
    book[MATERIAL] += dot(at.material, at.u)
    book[FRICTION] += theta * dot(at.rubbing, at.u) + (1.0 - theta) * dot(state.rubbing, at.u)
    loss = theta * dot(at.elastic, at.u) + (1.0 - theta) * dot(state.elastic, at.u)
    total = 0.0
    for k in range(at.stored.size):
        loss -= at.stored[k] - state.stored[k]
        total += at.stored[k]
        book[STRETCH + k] = at.stored[k]
        state.stored[k] = at.stored[k]
    if dynamic:
        for i in range(at.u.size):
            change = at.u[i] / step.dt - state.v[i]
            loss += 0.5 * terms.mass[i] * change * change
            state.v[i] += change
        book[KINETIC] = inertia.kinetic(state.v, terms.mass)
    book[INTEGRATOR] += loss
    copy(at.elastic, state.elastic)
    copy(at.rubbing, state.rubbing)
    state.held[0], state.held[1] = held, step.factor
    book[RESIDUAL] = book[WORK] + book[INJECTED] - book[KINETIC] - total
    book[RESIDUAL] -= book[MATERIAL] + book[FRICTION] + book[INTEGRATOR]


@jit_inlined
def _move_apart(terms, step, state, near, at, work):
    """Move apart what is too near after a step, and book what that adds to the energy."""
    x, book = state.x, state.book
    copy(x, work.trial)
    if not project.move_apart(x, terms.project, near.crowd):
        return
    store(x, terms, step, at, True)
    work.kept[0] = np.inf
    gained = -book[KINETIC] - book[STRETCH] - book[BEND]
    way = step.factor * project.hasten(x, work.trial, step.dt, terms.load, state.v)
    book[KINETIC] = inertia.kinetic(state.v, terms.mass)
    book[STRETCH], book[BEND] = at.stored[0], at.stored[1]
    copy(at.stored, state.stored)
    book[WORK] += way
    book[INJECTED] += gained + book[KINETIC] + book[STRETCH] + book[BEND] - way


@jit_inlined
def write(out, k, state, terms, near, unknowns, at):
    """Write row ``k`` of the history and its frame."""
    row = out.rows[k]
    for c in range(TIME):
        row[c] = state.book[c]
    row[TIME] = state.totals[2]
    row[HEIGHT] = height(state.x, out.top, out.base)
    row[REACTION_BOTTOM] = 0.0
    for c in out.bottom:
        row[REACTION_BOTTOM] += at.g[c]
    row[REACTION_TOP] = -state.held[0]
    if unknowns.driven < 0:
        row[REACTION_TOP] = -state.held[1] * total(terms.load)
    for p in range(out.probes.size):
        out.probed[k, 0, p] = state.x[out.probes[p]]
        out.probed[k, 1, p] = at.g[out.probes[p]]
    row[ITERATIONS_DONE] = state.totals[0]
    row[SPEED] = state.v[terms.contact.high]
    row[GAP] = least_gap(state.x, terms, near)
    if out.frame_of[k] >= 0:
        for i in range(state.x.size):
            out.frames[out.frame_of[k], i] = state.x[i]


@jit_inlined
def _begin(terms, stage, target, driven, state, near, room, todo):
    """Set out on the next step, from where the last one ended and on as that went."""
    before, at, work, grips, way = room
    x, dt, more = state.x, stage.dt * todo[SHARE], 0.0
    if driven >= 0:
        remaining = target - x[driven]
        if remaining * at.u[driven] > 0.0 and abs(remaining) <= FURTHER * abs(at.u[driven]):
            more = remaining / at.u[driven]
    copy(x, before.x0)
    damp.prepare(terms, before)
    for i in range(x.size):
        work.dx[i] = dt * state.v[i] if dt < np.inf else more * at.u[i]
        way[PREDICTED, i] = x[i] + work.dx[i]
        way[LAGGED, i] = x[i]
    if more > 0.0:
        work.dx[driven] = remaining
    if terms.friction.mu > 0.0:
        friction.lag(x, terms.contact, near.pairs, drift(x, terms, near), terms.friction, grips)
    todo[LOOPS], todo[RELAXED], todo[EFFORT], todo[TRIED] = 0.0, 0.0, 0.0, 0.0


@jit_inlined
def _grips_agree(x, terms, near, unknowns, tolerance, room, todo):
    """Lag friction anew; return whether ``x`` is still in balance (then nothing is changed)."""
    _, at, work, grips, way = room
    copy(at.g, work.trial)
    copy(at.rubbing, work.escape)
    y = way[LAGGED]
    todo[RELAXED] = approach(x, y, way[CHANGE], unknowns, todo[RELAXED])
    friction.lag(y, terms.contact, near.pairs, drift(y, terms, near), terms.friction, grips)
    rub(terms, grips, at)
    reduce(at.g, unknowns, work.residual)
    enough = max(tolerance.friction, tolerance.grip * largest(at.rubbing, unknowns))
    enough = max(enough, allowed(near.system.matrix, tolerance)[0])
    agree = largest(work.residual, unknowns) <= enough
    if agree:
        copy(work.trial, at.g)
        copy(work.escape, at.rubbing)
    todo[LOOPS], todo[TRIED] = todo[LOOPS] + 1.0, 0.0
    zero(work.dx)
    return agree


@jit_exact
def _go(terms, unknowns, tolerance, stage, state, out, control, near, room, todo):
    """March on from where ``todo`` (10,) says, until the stage ends or something must be done."""
    before, at, work, grips, way = room
    while todo[ROW] < stage.steps:
        if todo[LOOPS] < 0.0:
            todo[SHARE] = min(todo[SHARE], 1.0 - todo[DONE])
        part = (todo[ROW] + todo[DONE] + todo[SHARE]) / stage.steps
        factor = stage.factor0 + (stage.factor1 - stage.factor0) * part
        target = stage.driven0 + (stage.driven1 - stage.driven0) * part
        if todo[LOOPS] < 0.0:
            _begin(terms, stage, target, unknowns.driven, state, near, room, todo)
        step = Step(before, way[PREDICTED], stage.dt * todo[SHARE], factor, grips)
        outcome, spent, todo[MOVE] = minimise(
            state.x, target, terms, step, near, unknowns, tolerance, at, work, control
        )
        todo[SPENT], todo[EFFORT] = todo[SPENT] + spent, todo[EFFORT] + spent
        todo[TRIED] += max(spent, 1)
        if outcome == OUTGROWN and todo[TRIED] <= tolerance.iterations:
            zero(work.dx)
            return outcome
        if outcome == CONVERGED and terms.friction.mu > 0.0:
            if not _grips_agree(state.x, terms, near, unknowns, tolerance, room, todo):
                if todo[LOOPS] < GRIP_LOOPS:
                    continue
                outcome = ITERATIONS
        if outcome == CONVERGED and not holds_crowd(near, state.x, terms):
            zero(work.dx)
            return OUTGROWN
        todo[LOOPS] = -1.0
        if outcome != CONVERGED:
            copy(before.x0, state.x)
            zero(at.least)  # what was found last was found elsewhere
            zero(at.u)
            todo[FAILED] += 1.0
            todo[SHARE] *= 0.5 ** todo[FAILED]  # the oftener, the more boldly
            work.kept[0] = np.inf
            if outcome == INTERRUPTED or todo[SHARE] < SMALLEST:
                return ITERATIONS if outcome == OUTGROWN else outcome
            continue
        enter(terms, step, unknowns, state, at, work)
        _move_apart(terms, step, state, near, at, work)
        todo[DONE], todo[FAILED] = todo[DONE] + todo[SHARE], 0.0
        if todo[SHARE] < 1.0 or terms.friction.mu > 0.0:  # the next Hessian is another
            todo[SHARE] *= 2.0 if todo[EFFORT] <= tolerance.iterations else 1.0
            work.kept[0] = np.inf
        state.totals[1] += 1
        if todo[DONE] == 1.0:
            state.totals[0] += todo[SPENT]
            state.totals[2] += stage.pace
            write(out, int(todo[ROW]), state, terms, near, unknowns, at)
            control[1] += 1
            todo[ROW], todo[DONE], todo[SPENT] = todo[ROW] + 1.0, 0.0, 0.0
            todo[SHARE] = min(todo[SHARE], 1.0)
    return CONVERGED


@jit_owning
def march(terms, unknowns, tolerance, stage, state, out, control):
    """March through ``stage`` from ``state`` (changed in place); fill ``out``.

    Return (outcome, rows written). ``control`` (2,): [0] != 0 interrupts, [1] counts steps done.
    """
    todo = np.zeros(10)
    todo[SHARE], todo[LOOPS] = 1.0, -1.0
    near = find_near(state.x, terms, friction.none(), 0.0)
    room = make_room(terms, near)
    while True:
        outcome = _go(terms, unknowns, tolerance, stage, state, out, control, near, room, todo)
        if outcome != OUTGROWN:
            return outcome, int(todo[ROW])
        near = find_near(state.x, terms, room[3], todo[MOVE])
        room[2].kept[0] = np.inf
        wider = friction.room(near.pairs, terms.contact, terms.friction)
        if wider.load.size > room[3].load.size:
            room = room[0], room[1], room[2], friction.moved(room[3], wider), room[4]
