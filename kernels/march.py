"""Steps through a stage of loading, with halved steps where one fails, and keeps the energy book.

Backward Euler: v' = (x' - x) / dt, loss 1/2 |v' - v|_M^2 + [grad U(x') . dx - dU].
Static: no inertia; work and loss by the trapezoidal rule, loss = 1/2 (grad U + grad U') . dx - dU.
"""

from typing import NamedTuple

import numpy as np

from kernels import contact, damp, friction, inertia
from kernels.jit import jit_exact, jit_owning
from kernels.newton import CONVERGED, INTERRUPTED, ITERATIONS, Work, largest, minimise, reduce
from kernels.step import Step, find_near, gradient, stored, stored_gradient

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

    elastic, rate (n,), held (2,): gradient of U, friction, driven reaction (N) and load factor at
    the last step, for the trapezoidal rule. totals (3,): iterations, steps, time in s.
    """

    x: np.ndarray
    v: np.ndarray
    book: np.ndarray
    elastic: np.ndarray
    rate: np.ndarray
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
def _solve_step(x, target, terms, step, near, unknowns, tolerance, work, control):
    """Minimise; with friction again and again until the lagged forces agree with the contacts."""
    total = 0
    for _ in range(GRIP_LOOPS):
        outcome, iterations, near = minimise(
            x, target, terms, step, near, unknowns, tolerance, work, control
        )
        total += iterations
        if outcome != CONVERGED or terms.friction.mu == 0.0:
            return outcome, total, near, step
        grips = friction.lag(x, terms.contact, near.pairs, terms.friction)
        renewed = Step(step.x0, step.x_pred, step.dt, step.factor, grips)
        gradient(x, terms, renewed, near, work.g)
        reduce(work.g, unknowns.row, work.residual)
        if largest(work.residual, unknowns) <= tolerance.friction:
            return CONVERGED, total, near, step
        step = renewed
    return ITERATIONS, total, near, step


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
def _rate_forces(x, terms, step, material, rubbing):
    """Fill the gradients of the dissipation potentials of material and friction."""
    material[:] = 0.0
    rubbing[:] = 0.0
    if step.dt < np.inf:
        damp.gradient(x, step.x0, terms, step.dt, material)
    friction.gradient(x, step.x0, step.grips, terms.friction.slip, rubbing)


@jit_owning
def _enter(book, before, x, terms, step, near, unknowns, state, work):
    """Add one converged step to the energy book; ``before``: stored energies at its start."""
    new = step.dt < np.inf
    theta = 1.0 if new else 0.5
    dx = x - step.x0
    after = stored(x, terms, near)
    material, rubbing = np.empty(x.size), np.empty(x.size)
    _rate_forces(x, terms, step, material, rubbing)
    elastic = np.zeros(x.size)
    stored_gradient(x, terms, near, elastic)
    gradient(x, terms, step, near, work.g)
    held = 0.0
    if unknowns.driven >= 0:
        reduce(work.g, unknowns.row, work.residual)
        held = work.residual[unknowns.free]
    pull = step.factor * _dot(terms.load, dx)
    if not new:
        pull = 0.5 * (step.factor + state.held[1]) * _dot(terms.load, dx)
    lead = dx[unknowns.driven] if unknowns.driven >= 0 else 0.0
    book[WORK] += pull + (theta * held + (1.0 - theta) * state.held[0]) * lead
    book[STRETCH], book[BEND], book[CONTACT] = after
    book[MATERIAL] += _dot(material, dx)
    book[FRICTION] += theta * _dot(rubbing, dx) + (1.0 - theta) * _dot(state.rate, dx)
    change = sum(after) - sum(before)
    loss = theta * _dot(elastic, dx) + (1.0 - theta) * _dot(state.elastic, dx) - change
    if new:
        v = dx / step.dt
        loss += inertia.kinetic(v - state.v, terms.mass)
        state.v[:] = v
        book[KINETIC] = inertia.kinetic(v, terms.mass)
    book[INTEGRATOR] += loss
    state.elastic[:] = elastic
    state.rate[:] = rubbing
    state.held[0] = held
    state.held[1] = step.factor
    book[RESIDUAL] = book[WORK] - book[KINETIC] - sum(after)
    book[RESIDUAL] -= book[MATERIAL] + book[FRICTION] + book[INTEGRATOR]


@jit_exact
def _write(out, k, state, terms, near, unknowns, work):
    """Write row ``k`` of the history and its frame."""
    row = out.rows[k]
    for c in range(TIME):
        row[c] = state.book[c]
    row[TIME] = state.totals[2]
    row[HEIGHT] = height(state.x, out.top, out.base)
    row[REACTION_BOTTOM] = 0.0
    for c in out.bottom:
        row[REACTION_BOTTOM] += work.g[c]
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
    n, rows = state.x.size, unknowns.scale.size
    work = Work(
        np.zeros(n), np.zeros(n), np.zeros(n), np.zeros(rows), np.zeros(rows), np.zeros(rows)
    )
    near = find_near(state.x, terms, 0.0)
    share = 1.0
    for k in range(stage.steps):
        done = 0.0
        iterations = 0
        while done < 1.0:
            share = min(share, 1.0 - done)
            part = (k + done + share) / stage.steps
            factor = stage.factor0 + (stage.factor1 - stage.factor0) * part
            target = stage.driven0 + (stage.driven1 - stage.driven0) * part
            dt = stage.dt * share
            x0 = state.x.copy()
            x_pred = x0 + dt * state.v if dt < np.inf else x0
            grips = friction.empty()
            if terms.friction.mu > 0.0:
                grips = friction.lag(x0, terms.contact, near.pairs, terms.friction)
            step = Step(x0, x_pred, dt, factor, grips)
            before = stored(x0, terms, near)
            outcome, spent, near, step = _solve_step(
                state.x, target, terms, step, near, unknowns, tolerance, work, control
            )
            iterations += spent
            if outcome == CONVERGED:
                _enter(state.book, before, state.x, terms, step, near, unknowns, state, work)
                done += share
                share = 2.0 * share
                state.totals[1] += 1
                continue
            state.x[:] = x0
            near = find_near(x0, terms, 0.0)
            share *= 0.5
            if outcome == INTERRUPTED or share < SMALLEST:
                return outcome, k
        share = min(share, 1.0)
        state.totals[0] += iterations
        state.totals[2] += stage.pace
        _write(out, k, state, terms, near, unknowns, work)
        control[1] += 1
    return CONVERGED, stage.steps
