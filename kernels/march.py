"""Steps through a stage of loading, shorter ones where one fails or errs, and keeps the book."""

from typing import NamedTuple

import numpy as np

from kernels import damp, friction, inertia, scheme
from kernels.balance import allowed, largest, reduce
from kernels.book import INTEGRATOR, KINETIC, enter, made, move_apart, strike
from kernels.caliper import height
from kernels.jit import jit_exact, jit_inlined, jit_owning
from kernels.newton import CONVERGED, INTERRUPTED, ITERATIONS, OUTGROWN, minimise
from kernels.relax import approach
from kernels.room import CHANGE, HEAVY, LAGGED, PREDICTED, make_room
from kernels.rows import copy, total, zero
from kernels.scheme import BACKWARD_EULER, BDF2, POSITION
from kernels.step import Step, drift, find_near, holds_crowd, least_gap, rub

TIME, HEIGHT, REACTION_TOP, REACTION_BOTTOM, ITERATIONS_DONE, GAP, SPEED = range(10, 17)
N_COLUMNS = 17
SMALLEST = 2.0**-24  # share of a step
LONGER = 0.1  # of the error that is allowed: the next step may be twice as long
FURTHER = 2.0  # times the last step: a longer one is not extrapolated
GRIP_LOOPS = 30  # fixed-point iterations of friction
EASY_LOOPS = 10  # after more of them the next step is no longer
GIFT = 2e-3  # of all energy: what backward Euler may make, and once more in all further steps
SHORT = 2.0**-12  # share of a step that may make more: the run is judged at its end
# Of what is to be done: see `_go`. SPENT, EFFORT, TRIED: iterations for a row, a share, a minimum.
ROW, DONE, SHARE, FAILED, SPENT, EFFORT, TRIED, LOOPS, MOVE, RELAXED, LENGTH = range(11)
LAST = 3  # of the totals
INACCURATE = 7  # an outcome, beside those of `newton`


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


class State(NamedTuple):
    """Where the march is. x, v (n,): position and velocity. book (10,): energy book in J.

    rates (2, n), past (4, n): of position and velocity, gradients at the last step (`scheme`).
    stored (3,), held (2,): energies, driven reaction (N) and load factor at the last step. totals
    (4,): iterations, steps, time in s, duration of the last step, 0 to set out anew.
    """

    x: np.ndarray
    v: np.ndarray
    book: np.ndarray
    rates: np.ndarray
    past: np.ndarray
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
    x, dt, last, more = state.x, stage.dt * todo[SHARE], state.totals[LAST], 0.0
    if driven >= 0:
        remaining = target - x[driven]
        if remaining * at.u[driven] > 0.0 and abs(remaining) <= FURTHER * abs(at.u[driven]):
            more = remaining / at.u[driven]
    h = scheme.length(stage.scheme, dt, last)
    if h != todo[LENGTH]:  # the next Hessian is another
        todo[LENGTH], work.kept[0] = h, np.inf
    copy(x, before.x0)
    copy(x, way[LAGGED])
    if dt == np.inf:
        copy(x, before.y)
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
    todo[LOOPS], todo[RELAXED], todo[EFFORT], todo[TRIED] = 0.0, 0.0, 0.0, 0.0


@jit_inlined
def _grips_agree(x, terms, step, near, unknowns, tolerance, room, todo):
    """Lag friction anew; return whether ``x`` is still in balance (then nothing is changed)."""
    _, at, work, grips, way = room
    held = grips.count[0]
    copy(at.g, work.trial)
    copy(at.rubbing, work.escape)
    y = way[LAGGED]
    todo[RELAXED] = approach(x, y, way[CHANGE], unknowns, todo[RELAXED])
    friction.lag(y, terms.contact, near.pairs, drift(y, terms, near), terms.friction, grips)
    if held + grips.count[0] == 0:
        return True
    rub(terms, step, at)
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
def _invents(terms, stage, state, at, share, noise):
    """Return whether a step of backward Euler makes energy that none was lost for before."""
    gain, there = made(state, at, terms.mass, stage.dt * share)
    enough = GIFT * there + noise
    return gain - state.book[INTEGRATOR] > enough and gain > enough * share / stage.steps


@jit_exact
def _go(terms, unknowns, tolerance, stage, state, out, control, near, room, todo):
    """March on from where ``todo`` (11,) says, until the stage ends or something must be done."""
    before, at, work, grips, way = room
    while todo[ROW] < stage.steps:
        if stage.scheme != BACKWARD_EULER and state.totals[LAST] == 0.0:
            todo[SHARE] = min(todo[SHARE], scheme.FIRST)
        part = (todo[ROW] + todo[DONE] + todo[SHARE]) / stage.steps
        factor = stage.factor0 + (stage.factor1 - stage.factor0) * part
        target = stage.driven0 + (stage.driven1 - stage.driven0) * part
        if todo[LOOPS] < 0.0:
            _begin(terms, stage, target, unknowns.driven, state, near, room, todo)
        dt, slip = stage.dt * todo[SHARE], terms.friction.slip
        if dt < np.inf:
            slip *= todo[LENGTH]
        theta = scheme.weight(todo[LENGTH], dt)
        step = Step(before, way[PREDICTED], todo[LENGTH], factor, grips, slip, theta)
        outcome, spent, todo[MOVE] = minimise(
            state.x, target, terms, step, near, unknowns, tolerance, at, work, control
        )
        todo[SPENT], todo[EFFORT] = todo[SPENT] + spent, todo[EFFORT] + spent
        todo[TRIED] += max(spent, 1)
        if outcome == OUTGROWN and todo[TRIED] <= tolerance.iterations:
            zero(work.dx)
            return outcome
        if outcome == CONVERGED and terms.friction.mu > 0.0:
            if not _grips_agree(state.x, terms, step, near, unknowns, tolerance, room, todo):
                if todo[LOOPS] < GRIP_LOOPS:
                    continue
                outcome = ITERATIONS
        if outcome == CONVERGED and not holds_crowd(near, state.x, terms):
            zero(work.dx)
            return OUTGROWN
        loops, todo[LOOPS], strayed = todo[LOOPS], -1.0, 0.0
        if outcome == CONVERGED and stage.error < np.inf:
            strayed = scheme.error(state, before.x0, dt, step.dt, way[HEAVY]) / stage.error
            outcome = INACCURATE if strayed > 1.0 else CONVERGED
        if outcome == CONVERGED and step.dt == dt < np.inf and todo[SHARE] > SHORT:
            if _invents(terms, stage, state, at, todo[SHARE], tolerance.noise):
                outcome = INACCURATE
        if outcome != CONVERGED:
            copy(before.x0, state.x)
            zero(at.least)  # what was found last was found elsewhere
            zero(at.u)
            todo[FAILED] += 1.0 if outcome != INACCURATE else 0.0
            todo[SHARE] *= 0.5 ** max(todo[FAILED], 1.0)  # the oftener, the more boldly
            work.kept[0] = np.inf
            if outcome == INTERRUPTED or todo[SHARE] < SMALLEST:
                return ITERATIONS if outcome == OUTGROWN else outcome
            continue
        if dt < np.inf:
            lost = scheme.arrive(stage.scheme, state, step, dt, terms, way[HEAVY], at.u)
            state.book[INTEGRATOR] += lost
            state.book[KINETIC] = inertia.kinetic(state.v, terms.mass)
            state.totals[LAST] = dt
        enter(terms, step, unknowns, state, at, work)
        move_apart(terms, step, state, near, at, work)
        todo[DONE], todo[FAILED] = todo[DONE] + todo[SHARE], 0.0
        if todo[SHARE] < 1.0:  # the next Hessian is another
            work.kept[0] = np.inf
        easy = strayed < LONGER and todo[EFFORT] <= tolerance.iterations and loops <= EASY_LOOPS
        if easy and todo[DONE] % (2.0 * todo[SHARE]) == 0.0:
            todo[SHARE] *= 2.0
        state.totals[1] += 1
        if todo[DONE] == 1.0:
            state.totals[0] += todo[SPENT]
            state.totals[2] += stage.pace
            write(out, int(todo[ROW]), state, terms, near, unknowns, at)
            control[1] += 1
            todo[ROW], todo[DONE], todo[SPENT] = todo[ROW] + 1.0, 0.0, 0.0
    return CONVERGED


@jit_owning
def march(terms, unknowns, tolerance, stage, state, out, control):
    """March through ``stage`` from ``state`` (changed in place); fill ``out``.

    Return (outcome, rows written). ``control`` (2,): [0] != 0 interrupts, [1] counts steps done.
    """
    todo = np.zeros(11)
    todo[SHARE], todo[LOOPS] = 1.0, -1.0
    if stage.error < np.inf and state.totals[LAST] > 0.0:
        todo[SHARE] = state.totals[LAST] / stage.dt
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
