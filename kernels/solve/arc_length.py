"""Follows a path of equilibria through its limit points: load factor and shape are one unknown.

A point of it balances the load and lies one arc from the point before (Crisfield 1981, Comput.
Struct. 13, 55; both linearised together, as Ramm 1981 and Wempner 1971):

    g(x) = lambda f,   |x - x0|_w = s,   |u|_w^2 = sum w u^2

w is the share of the structure that a coordinate bears, so that s does not depend on the mesh.
Newton:

    dx = r + dlambda v,   K r = -(g - lambda f),   K v = f,   dlambda = -(c + c_x . r) / (c_x . v)

No minimum is looked for: K may have negative pivots, as many as there are directions in which the
shape is unstable. Where the load would pass its full value, that takes the place of the arc.
"""

from typing import NamedTuple

import numpy as np

from kernels.arrays import copy, dot, zero
from kernels.compile.jit import jit_exact, jit_owning
from kernels.compile.reference import by_reference
from kernels.solve.energy_book import enter
from kernels.solve.integrators import Ahead
from kernels.solve.march import AT_START, SMALLEST
from kernels.solve.newton import CONVERGED, INTERRUPTED, ITERATIONS, NOT_FINITE, OUTGROWN, STALLED
from kernels.solve.problem import NO_ROOM, TIED, Step
from kernels.solve.residual import largest
from kernels.solve.workspace import make_workspace

PROGRESS = np.dtype(
    (
        np.record,  # for attributes in plain Python too
        [
            ("row", np.int64),  # the next one of the history; -1 at the start of the path
            ("done", np.float64),  # share of the row's arc that is done
            ("share", np.float64),  # share of the row's arc that is tried now
            ("length", np.float64),  # of what is tried, m; 0: straight to the load ``aim``
            ("aim", np.float64),  # load factor
            ("load", np.float64),  # load factor reached
            ("rise", np.float64),  # of the load factor in the next iteration
            ("move", np.float64),  # farthest of a coordinate in the next iteration, m
            ("far", np.float64),  # that a point goes of it at most, m
            ("spent", np.int64),  # Newton iterations for what is tried
        ],
    )
)
POINT = np.dtype((np.record, [("factor", np.float64), ("unstable", np.float64)]))
TRIES = 20  # Newton iterations of an arc
ON_ARC = 1e-6  # of the arc: farther off it is another one
BEND = 0.7  # cosine between an arc and its start, or the arc before: less is another path
MOST_LOAD = 0.05  # of the full load: no arc sets out for more


class Arc(NamedTuple):
    """weight (n,) of a coordinate, zero for rotations; length of an arc in m; path (steps + 1,) of
    `POINT`: load factor and number of unstable directions, at the start and at the end of every
    arc.
    """

    weight: np.ndarray
    length: float
    path: np.ndarray


class Trail(NamedTuple):
    """way (n,): last move. tangent (n,): that of a unit of load from its end."""

    way: np.ndarray
    tangent: np.ndarray


@jit_exact
def _inner(a, b, weight):
    """Return the product of two moves (n,) of which each coordinate has its weight."""
    value = 0.0
    for i in range(a.size):
        value += weight[i] * a[i] * b[i]
    return value


@jit_exact
def _cosine(a, b, weight):
    """Return that of the angle between two moves; 1 where one of them is none."""
    size = np.sqrt(_inner(a, a, weight) * _inner(b, b, weight))
    return _inner(a, b, weight) / size if size > 0.0 else 1.0


@jit_exact
def _combine(r, share, v, coordinates, dx):
    """Fill dx with r + share v; return its longest move of a coordinate, m."""
    most = 0.0
    for i in range(dx.size):
        dx[i] = r[i] + share * v[i]
        if coordinates.role[i] >= TIED:
            most = max(most, abs(dx[i]) * coordinates.scale[i])
    return most


@jit_exact
def _off(u, r, v, arc, progress):
    """Return the rise of the load that the constraint asks for, and whether it is met."""
    if progress.length == 0.0:
        return progress.aim - progress.load, progress.aim == progress.load
    square = progress.length * progress.length
    gap = _inner(u, u, arc.weight) - square
    rise = -(0.5 * gap + _inner(u, r, arc.weight)) / _inner(u, v, arc.weight)
    return rise, abs(gap) <= ON_ARC * square


@jit_exact
def _step(space, stage, progress, factor):
    """Return the static `Step` of an arc that ends at a load ``factor``: a shorter arc takes less
    time, the start of the path none.
    """
    duration = stage.duration * progress.share if progress.row >= 0 else 0.0
    return Step(space.x0, space.y, space.x_pred, duration, duration, False, factor, 0.5)


@jit_exact
def _balance(x, problem, tolerance, stage, space, arc, progress):
    """Move ``x`` (n,) on by ``work.dx`` and the load by its rise until both are in balance."""
    found, work, coordinates = space.found, space.work, problem.scene.coordinates
    r, v = work.direction, work.escape
    while True:
        if not progress.move < np.inf:
            return NOT_FINITE
        cut = coordinates.cap / max(progress.move, coordinates.cap)
        progress.far = cut * problem.travel(work.dx)
        if not problem.covers(x, progress.far):
            return OUTGROWN
        share = min(cut, problem.step_limit(x, work.dx, progress.far))
        for i in range(x.size):
            x[i] += share * work.dx[i]
        arrives = share == 1.0 and progress.length == 0.0
        progress.load = progress.aim if arrives else progress.load + share * progress.rise
        zero(work.dx)
        progress.rise, progress.move, progress.spent = 0.0, 0.0, progress.spent + 1
        step = _step(space, stage, progress, progress.load)
        problem.evaluate(x, step, found, False)
        problem.reduce(found.g, work.residual)
        size = largest(work.residual, coordinates)
        if not size < np.inf:
            return NOT_FINITE
        met, _ = problem.factor(x, step, found, False, True)
        if met == NO_ROOM:
            return OUTGROWN
        for i in range(x.size):
            r[i], v[i] = -found.g[i], coordinates.load[i]
        problem.solve(r)
        problem.solve(v)
        rise, close = _off(found.u, r, v, arc, progress)
        if close and size <= tolerance.force:
            if abs(0.5 * dot(found.g, r)) <= tolerance.decrement:
                return CONVERGED
        if progress.spent > min(TRIES, tolerance.iterations):
            return ITERATIONS
        progress.rise, progress.move = rise, _combine(r, rise, v, coordinates, work.dx)


@jit_exact
def _set_out(problem, stage, state, space, arc, trail, progress):
    """Point dx along the path, for an arc or for what the load lacks, whichever is shorter."""
    work, factor, coordinates = space.work, state.totals[0].factor, problem.scene.coordinates
    copy(state.x, space.x0)
    copy(state.x, space.y)
    rates = Ahead(0.0, 0.0, state.rates.position, work.dx)
    problem.begin(_step(space, stage, progress, factor), rates, work.trial)
    tangent, way = trail.tangent, trail.way
    progress.spent, progress.load, progress.aim = 0, factor, factor
    progress.length, progress.rise = 0.0, 0.0
    if progress.row >= 0:
        size = np.sqrt(_inner(tangent, tangent, arc.weight))
        length = progress.share * min(arc.length, MOST_LOAD * size)
        progress.rise = length / size * (-1.0 if _inner(tangent, way, arc.weight) < 0.0 else 1.0)
        progress.length = length
        if progress.rise >= 1.0 - progress.load:
            progress.rise, progress.length, progress.aim = 1.0 - progress.load, 0.0, 1.0
    zero(work.residual)
    progress.move = _combine(work.residual, progress.rise, tangent, coordinates, work.dx)


@jit_exact
def _return(problem, stage, state, space, progress):
    """Set out from the last point for the full load instead, as an arc has passed it."""
    work, totals, coordinates = space.work, state.totals[0], problem.scene.coordinates
    share = (1.0 - totals.factor) / (progress.load - totals.factor)
    copy(space.x0, state.x)
    problem.roll_back(_step(space, stage, progress, totals.factor))
    zero(work.residual)
    progress.move = _combine(work.residual, share, space.found.u, coordinates, work.dx)
    progress.load, progress.rise = totals.factor, 1.0 - totals.factor
    totals.iterations += progress.spent
    progress.length, progress.aim, progress.spent = 0.0, 1.0, 0


@jit_exact
def _go(problem, tolerance, stage, state, out, control, space, arc, trail, progress):
    """Follow the path from where ``progress`` says, to its end or until room is lacking.

    Return the outcome and the rows written.
    """
    found, work, totals = space.found, space.work, state.totals[0]
    while progress.row < stage.steps:
        if progress.spent == AT_START:
            progress.share = min(progress.share, 1.0 - progress.done)
            _set_out(problem, stage, state, space, arc, trail, progress)
        outcome = _balance(state.x, problem, tolerance, stage, space, arc, progress)
        if outcome == OUTGROWN and progress.spent <= 2 * TRIES:
            return outcome, progress.row
        if control[0] != 0:
            outcome = INTERRUPTED
        if outcome == CONVERGED and progress.row >= 0:
            if progress.length > 0.0 and progress.load > 1.0:
                _return(problem, stage, state, space, progress)
                continue
            side = -1.0 if _inner(trail.tangent, trail.way, arc.weight) < 0.0 else 1.0
            if side * _cosine(found.u, trail.tangent, arc.weight) < BEND:
                outcome = STALLED
        totals.iterations += progress.spent
        progress.spent = AT_START
        step = _step(space, stage, progress, progress.load)
        if outcome != CONVERGED:
            copy(space.x0, state.x)
            problem.roll_back(step)
            progress.share *= 0.5
            if outcome == INTERRUPTED or progress.share < SMALLEST or progress.row < 0:
                return (ITERATIONS if outcome == OUTGROWN else outcome), progress.row
            continue
        problem.commit(state.x, step, found)
        enter(problem, step, state, found, work)
        copy(work.escape, trail.tangent)
        if progress.row >= 0:
            copy(found.u, trail.way)
            progress.done += progress.share
            totals.steps += 1
            if progress.done < 1.0 and progress.load != 1.0:
                progress.share *= 2.0
                continue
            totals.time += stage.duration
            problem.write(out, progress.row, state, found)
            control[1] += 1
        progress.row, progress.done, progress.share = progress.row + 1, 0.0, 1.0
        arc.path[progress.row].factor = progress.load
        arc.path[progress.row].unstable = problem.unstable()
        if progress.load == 1.0:
            break
    return CONVERGED, progress.row


@jit_owning
def follow(scene, tolerance, stage, state, out, control, arc):
    """Follow the path from ``state`` (changed in place) for the arcs of ``stage``, or until the
    load is full; fill ``out`` and ``arc.path``.

    scene: as in `march`. Return (outcome, rows written). ``control`` (2,): [0] != 0 interrupts, [1]
    counts arcs done.
    """
    progress, n = np.zeros(1, PROGRESS), state.x.size
    trail = Trail(np.zeros(n), np.zeros(n))
    progress[0].row, progress[0].share, progress[0].spent = -1, 1.0, AT_START
    near, room = scene.find_near(state.x), scene.make_room(state.memory)
    space = make_workspace(n, state.stored.size)
    while True:
        now = progress[0]
        problem = by_reference(scene).assemble(by_reference(near), by_reference(room))
        outcome, rows = _go(
            problem, tolerance, stage, by_reference(state), out, control,
            by_reference(space), arc, trail, now,
        )  # fmt: skip
        if outcome != OUTGROWN:
            return outcome, max(rows, 0)
        near = scene.renew_near(near, state.x, now.far)
