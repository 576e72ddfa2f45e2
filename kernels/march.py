"""Steps through a stage of loading, with halved steps where one fails, and keeps the energy book.

Backward Euler: v' = (x' - x) / dt, loss 1/2 |v' - v|_M^2 + [grad U(x') . dx - dU].
Static: no inertia; work and loss by the trapezoidal rule, loss = 1/2 (grad U + grad U') . dx - dU.
"""

from typing import NamedTuple

import numpy as np

from kernels import contact, damp, friction, inertia
from kernels.chain import Shape, Stiffness
from kernels.jit import jit_exact, jit_inlined, jit_owning
from kernels.newton import CONVERGED, INTERRUPTED, ITERATIONS, Work, largest, minimise, reduce
from kernels.rows import copy
from kernels.step import At, Step, find_near, rub

WORK, KINETIC, STRETCH, BEND, CONTACT, MATERIAL, FRICTION, INTEGRATOR, RESIDUAL = range(9)
TIME, HEIGHT, REACTION_TOP, REACTION_BOTTOM, ITERATIONS_DONE, GAP = range(9, 15)
N_COLUMNS = 15
SMALLEST = 2.0**-12  # share of a step
GRIP_LOOPS = 30  # fixed-point iterations of friction


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
    """Where the march is. x, v (n,): position and velocity. book (9,): energy book in J.

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

    bottom: coordinates whose supports make the lower reaction. top, base: see `height`.
    """

    rows: np.ndarray
    frame_of: np.ndarray
    frames: np.ndarray
    bottom: np.ndarray
    top: np.ndarray
    base: np.ndarray


@jit_owning
def _shape(terms):
    """Return room for the shape and the stiffness of all walls."""
    m, arms = terms.stretch.l0.size, terms.walls.rotation.size
    shape = Shape(
        np.zeros((2, m)), np.zeros(m), np.zeros(m), np.zeros(arms), np.zeros((2, m)), np.zeros(arms)
    )
    twist = np.zeros(arms // 2)
    return shape, Stiffness(np.zeros((3, m)), np.zeros((4, m)), np.zeros((3, arms)), twist)


@jit_owning
def _room(terms):
    """Return the arrays of all steps: `Before`, `At` and `Work`."""
    n = terms.mass.size
    shape, stiffness = _shape(terms)
    before = damp.Before(np.zeros(n), np.zeros((terms.walls.rotation.size, 3)), shape, stiffness)
    shape, stiffness = _shape(terms)
    five = np.zeros((5, n))
    at = At(
        five[0], five[1], five[2], five[3], five[4], np.zeros(3), np.zeros(2), shape, stiffness
    )
    more = np.zeros((5, n))
    return before, at, Work(more[0], more[1], more[2], more[3], more[4])


@jit_inlined
def _solve_step(x, target, terms, step, near, unknowns, tolerance, at, work, control):
    """Minimise; with friction again and again until the lagged forces agree with the contacts."""
    total = 0
    for _ in range(GRIP_LOOPS):
        outcome, iterations, near = minimise(
            x, target, terms, step, near, unknowns, tolerance, at, work, control
        )
        total += iterations
        if outcome != CONVERGED or terms.friction.mu == 0.0:
            return outcome, total, near
        grips = friction.lag(x, terms.contact, near.pairs, terms.friction)
        rub(terms, grips, at)
        reduce(at.g, unknowns.leader, work.residual)
        if largest(work.residual, unknowns) <= tolerance.friction:
            rub(terms, step.grips, at)  # those that x is in balance with
            return CONVERGED, total, near
        step = Step(step.before, step.x_pred, step.dt, step.factor, grips)
    return ITERATIONS, total, near


@jit_exact
def _dot(a, b):
    total = 0.0
    for i in range(a.size):
        total += a[i] * b[i]
    return total


@jit_exact
def height(x, top, base):
    """Return how far the mean of ``top`` is above that of ``base`` (coordinates).

    Where ``top`` is empty it is the extent of ``base``, what a caliper would read.
    """
    if top.size > 0:
        return _mean(x, top) - _mean(x, base)
    low, high = np.inf, -np.inf
    for c in base:
        low, high = min(low, x[c]), max(high, x[c])
    return high - low


@jit_exact
def _mean(x, coordinates):
    total = 0.0
    for c in coordinates:
        total += x[c]
    return total / coordinates.size


@jit_exact
def _enter(terms, step, unknowns, state, at, work):
    """Add one converged step, found by the last `evaluate`, to the energy book."""
    book, dynamic = state.book, step.dt < np.inf
    theta = 1.0 if dynamic else 0.5
    held, lead = 0.0, 0.0
    if unknowns.driven >= 0:
        reduce(at.g, unknowns.leader, work.residual)
        held, lead = work.residual[unknowns.driven], at.u[unknowns.driven]
    factor = theta * step.factor + (1.0 - theta) * state.held[1]
    book[WORK] += factor * _dot(terms.load, at.u)
    book[WORK] += (theta * held + (1.0 - theta) * state.held[0]) * lead
    book[MATERIAL] += _dot(at.material, at.u)
    book[FRICTION] += theta * _dot(at.rubbing, at.u) + (1.0 - theta) * _dot(state.rubbing, at.u)
    loss = theta * _dot(at.elastic, at.u) + (1.0 - theta) * _dot(state.elastic, at.u)
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
    book[RESIDUAL] = book[WORK] - book[KINETIC] - total
    book[RESIDUAL] -= book[MATERIAL] + book[FRICTION] + book[INTEGRATOR]


@jit_exact
def _write(out, k, state, terms, near, unknowns, at):
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
        row[REACTION_TOP] = -state.held[1] * terms.load.sum()
    row[ITERATIONS_DONE] = state.totals[0]
    row[GAP] = contact.least_gap(state.x, terms.contact, near.pairs)
    if out.frame_of[k] >= 0:
        for i in range(state.x.size):
            out.frames[out.frame_of[k], i] = state.x[i]


@jit_owning
def march(terms, unknowns, tolerance, stage, state, out, control):
    """March through ``stage`` from ``state`` (changed in place); fill ``out``.

    Return (outcome, rows written). ``control`` (2,): [0] != 0 interrupts, [1] counts steps done.
    """
    before, at, work = _room(terms)
    x, x_pred = state.x, np.zeros(state.x.size)
    near = find_near(x, terms, friction.empty(), 0.0)
    share = 1.0
    for k in range(stage.steps):
        done, iterations = 0.0, 0
        while done < 1.0:
            share = min(share, 1.0 - done)
            part = (k + done + share) / stage.steps
            factor = stage.factor0 + (stage.factor1 - stage.factor0) * part
            target = stage.driven0 + (stage.driven1 - stage.driven0) * part
            dt = stage.dt * share
            copy(x, before.x0)
            damp.prepare(terms, before)
            if dt < np.inf:
                for i in range(x.size):
                    x_pred[i] = x[i] + dt * state.v[i]
            grips = friction.empty()
            if terms.friction.mu > 0.0:
                grips = friction.lag(x, terms.contact, near.pairs, terms.friction)
            step = Step(before, x_pred, dt, factor, grips)
            outcome, spent, near = _solve_step(
                x, target, terms, step, near, unknowns, tolerance, at, work, control
            )
            iterations += spent
            if outcome == CONVERGED:
                _enter(terms, step, unknowns, state, at, work)
                done += share
                share = 2.0 * share
                state.totals[1] += 1
                continue
            copy(before.x0, x)
            near = find_near(x, terms, friction.empty(), 0.0)
            share *= 0.5
            if outcome == INTERRUPTED or share < SMALLEST:
                return outcome, k
        share = min(share, 1.0)
        state.totals[0] += iterations
        state.totals[2] += stage.pace
        _write(out, k, state, terms, near, unknowns, at)
        control[1] += 1
    return CONVERGED, stage.steps
