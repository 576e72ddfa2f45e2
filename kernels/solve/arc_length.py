"""Arc-length continuation: follows an equilibrium path through its limit points.

Positions and the load factor lambda are both unknowns. Every point of the path is an equilibrium at
a fixed arc length s from the previous point (Crisfield 1981, Comput. Struct. 13, 55; both equations
are linearised together, as in Ramm 1981 and Wempner 1971):

    g(x) = lambda f,   |x - x0|_w = s,   |u|_w^2 = sum w u^2

The weight w of a coordinate is its share of the structure, so that s does not depend on the mesh.
Newton's method:

    dx = r + dlambda v,   K r = -(g - lambda f),   K v = f,   dlambda = -(c + c_x . r) / (c_x . v)

An equilibrium need not be a minimum: K has as many negative pivots as the equilibrium has unstable
directions. An arc that would end beyond the full load is replaced by a step to the full load.
"""

from typing import NamedTuple

import numpy as np

from kernels.arrays import copy, dot, zero
from kernels.compile.jit import jit_exact, jit_owning
from kernels.compile.reference import by_reference
from kernels.solve import resolution
from kernels.solve.energy_book import enter_step
from kernels.solve.integrators import Ahead
from kernels.solve.march import NOT_STARTED, SMALLEST_SHARE
from kernels.solve.outcomes import (
    CONVERGED,
    INTERRUPTED,
    ITERATIONS,
    NOT_FINITE,
    OUTGROWN,
    STALLED,
    UNRESOLVED,
)
from kernels.solve.problem import NO_ROOM, TIED, Step
from kernels.solve.residual import largest_residual
from kernels.solve.workspace import make_workspace

PATH_PROGRESS = np.dtype(
    (
        np.record,  # fields are attributes in plain Python too
        [
            ("row", np.int64),  # next row of the history; -1 before the first point of the path
            ("done", np.float64),  # completed share of the arc of the row
            ("share", np.float64),  # share of the arc of the row that is attempted
            ("length", np.float64),  # attempted arc length, m; 0: a step to ``target_load``
            ("target_load", np.float64),  # load factor at which a step of length 0 ends
            ("load", np.float64),  # present load factor
            ("increment", np.float64),  # of the load factor in the next iteration
            ("longest_move", np.float64),  # of a coordinate in the next iteration, m
            ("travel_bound", np.float64),  # of a point in the next iteration, m
            ("iterations", np.int64),  # Newton iterations of the attempt
            ("decrement", np.float64),  # of Newton where it converged, J
        ],
    )
)
POINT = np.dtype((np.record, [("factor", np.float64), ("unstable", np.float64)]))
CORRECTIONS = 20  # most Newton iterations of an arc
ARC_TOLERANCE = 1e-6  # tolerance of |u|_w^2 - s^2, relative to s^2
LEAST_COSINE = 0.7  # between an arc and the tangent at its start: less means another branch
LARGEST_LOAD_STEP = 0.05  # share of the full load: bounds the predicted load increment of an arc


class Arc(NamedTuple):
    """weight (n,): w of each coordinate, zero for rotations. length: of an arc, m. path (steps +
    1,) of `POINT`: load factor and number of unstable directions at the start and after every arc.
    """

    weight: np.ndarray
    length: float
    path: np.ndarray


class Heading(NamedTuple):
    """last_move (n,): of the last arc. tangent (n,): v = K^-1 f at its end, move per unit load."""

    last_move: np.ndarray
    tangent: np.ndarray


@jit_exact
def _inner(a, b, weight):
    """Return the weighted inner product sum w a b of two moves (n,)."""
    value = 0.0
    for i in range(a.size):
        value += weight[i] * a[i] * b[i]
    return value


@jit_exact
def _cosine(a, b, weight):
    """Return the cosine of the angle between two moves (n,); 1 if one of them is zero."""
    size = np.sqrt(_inner(a, a, weight) * _inner(b, b, weight))
    return _inner(a, b, weight) / size if size > 0.0 else 1.0


@jit_exact
def _combine(r, share, v, coordinates, dx):
    """Fill ``dx`` with r + share v; return the longest move of a coordinate in it, m."""
    longest = 0.0
    for i in range(dx.size):
        dx[i] = r[i] + share * v[i]
        if coordinates.role[i] >= TIED:
            longest = max(longest, abs(dx[i]) * coordinates.scale[i])
    return longest


@jit_exact
def _load_increment(u, r, v, arc, resolution, progress):
    """Return dlambda of the linearised constraint, and whether positions satisfy the constraint as
    far as their ``resolution`` (m) allows.
    """
    if progress.length == 0.0:
        return progress.target_load - progress.load, progress.target_load == progress.load
    square = progress.length * progress.length
    gap = _inner(u, u, arc.weight) - square
    increment = -(0.5 * gap + _inner(u, r, arc.weight)) / _inner(u, v, arc.weight)
    return increment, abs(gap) <= max(ARC_TOLERANCE * square, 2.0 * progress.length * resolution)


@jit_exact
def _step(workspace, stage, progress, factor):
    """Return the static `Step` of an arc that ends at the load ``factor``.

    Its duration is its share of the stage; the start of the path takes no time.
    """
    duration = stage.duration * progress.share if progress.row >= 0 else 0.0
    x0, y, x_pred = workspace.x0, workspace.y, workspace.x_pred
    return Step(x0, y, x_pred, duration, duration, False, factor, 0.5, 1.0, 0.0)


@jit_exact
def _correct(x, problem, tolerance, stage, workspace, arc, progress):
    """Correct ``x`` (n,) and the load factor by Newton's method; return the outcome.

    The first move is ``work.dx`` with ``progress.increment``, the predictor.
    """
    evaluation, work, coordinates = workspace.evaluation, workspace.work, problem.scene.coordinates
    r, v = work.direction, work.escape
    while True:
        if not progress.longest_move < np.inf:
            return NOT_FINITE
        cut = coordinates.cap / max(progress.longest_move, coordinates.cap)
        progress.travel_bound = cut * problem.travel(work.dx)
        if not problem.covers(x, progress.travel_bound):
            return OUTGROWN
        share = min(cut, problem.step_limit(x, work.dx, progress.travel_bound))
        for i in range(x.size):
            x[i] += share * work.dx[i]
        arrives = share == 1.0 and progress.length == 0.0
        progress.load = (
            progress.target_load if arrives else progress.load + share * progress.increment
        )
        zero(work.dx)
        progress.increment, progress.longest_move = 0.0, 0.0
        progress.iterations += 1
        step = _step(workspace, stage, progress, progress.load)
        problem.evaluate(x, step, evaluation)
        problem.reduce(evaluation.g, work.residual)
        size = largest_residual(work.residual, coordinates)
        if not size < np.inf:
            return NOT_FINITE
        result, _ = problem.factor(x, step, evaluation, 0.0, True)
        if result == NO_ROOM:
            return OUTGROWN
        for i in range(x.size):
            r[i], v[i] = -evaluation.g[i], coordinates.load[i]
        problem.solve(r)
        problem.solve(v)
        increment, on_constraint = _load_increment(
            evaluation.u, r, v, arc, tolerance.resolution, progress
        )
        if on_constraint and size <= tolerance.force:
            progress.decrement = abs(0.5 * dot(evaluation.g, r))
            if progress.decrement <= tolerance.decrement:
                return CONVERGED
        if progress.iterations > min(CORRECTIONS, tolerance.iterations):
            return ITERATIONS
        progress.increment = increment
        progress.longest_move = _combine(r, increment, v, coordinates, work.dx)


@jit_exact
def _predict(problem, stage, state, workspace, arc, heading, progress):
    """Fill ``work.dx`` with the predictor along the tangent, for an arc or up to the full load,
    whichever is shorter.
    """
    work, factor, coordinates = workspace.work, state.totals[0].factor, problem.scene.coordinates
    copy(state.x, workspace.x0)
    copy(state.x, workspace.y)
    rates = Ahead(0.0, 0.0, state.rates.position, work.dx)
    problem.begin(_step(workspace, stage, progress, factor), rates, work.trial)
    tangent, last_move = heading.tangent, heading.last_move
    progress.iterations, progress.load, progress.target_load = 0, factor, factor
    progress.length, progress.increment = 0.0, 0.0
    if progress.row >= 0:
        size = np.sqrt(_inner(tangent, tangent, arc.weight))
        length = progress.share * min(arc.length, LARGEST_LOAD_STEP * size)
        sign = -1.0 if _inner(tangent, last_move, arc.weight) < 0.0 else 1.0
        progress.length, progress.increment = length, length / size * sign
        if progress.increment >= 1.0 - progress.load:
            progress.increment = 1.0 - progress.load
            progress.length, progress.target_load = 0.0, 1.0
    zero(work.residual)
    progress.longest_move = _combine(
        work.residual, progress.increment, tangent, coordinates, work.dx
    )


@jit_exact
def _return_to_full_load(problem, stage, state, workspace, progress):
    """Replace an arc that has passed the full load by a step from its start to the full load."""
    work, totals, coordinates = workspace.work, state.totals[0], problem.scene.coordinates
    share = (1.0 - totals.factor) / (progress.load - totals.factor)
    copy(workspace.x0, state.x)
    problem.roll_back(_step(workspace, stage, progress, totals.factor))
    zero(work.residual)
    progress.longest_move = _combine(
        work.residual, share, workspace.evaluation.u, coordinates, work.dx
    )
    progress.load, progress.increment = totals.factor, 1.0 - totals.factor
    totals.iterations += progress.iterations
    progress.length, progress.target_load, progress.iterations = 0.0, 1.0, 0


@jit_exact
def _judge(problem, tolerance, state, step, load, workspace, arc, heading, progress):
    """Return the outcome of an arc after its equilibrium is found.

    load: `resolution.largest_load` of the step.
    """
    evaluation, tangent = workspace.evaluation, heading.tangent
    if progress.row >= 0:
        sign = -1.0 if _inner(tangent, heading.last_move, arc.weight) < 0.0 else 1.0
        if sign * _cosine(evaluation.u, tangent, arc.weight) < LEAST_COSINE:
            return STALLED
    decrement = progress.decrement
    if not resolution.is_resolved(
        problem, step, tolerance, state, evaluation, workspace.work, load, decrement
    ):
        return UNRESOLVED
    return CONVERGED


@jit_exact
def _accept(problem, step, state, workspace, load, heading, progress):
    """Accept an arc: commit the material, enter the energy book, renew the heading.

    load: `resolution.largest_load` of the step.
    """
    evaluation, totals = workspace.evaluation, state.totals[0]
    problem.commit(state.x, step, evaluation)
    enter_step(problem, step, state, evaluation, workspace.work)
    totals.force = resolution.largest_force(problem.scene.coordinates, state, evaluation, load)
    copy(workspace.work.escape, heading.tangent)
    if progress.row >= 0:
        copy(evaluation.u, heading.last_move)
        progress.done += progress.share
        totals.steps += 1


@jit_exact
def _end_row(problem, stage, state, out, control, evaluation, arc, progress):
    """Write the row of a complete arc, and go on to the next one."""
    if progress.row >= 0:
        state.totals[0].time += stage.duration
        problem.write(out, progress.row, state, evaluation)
        control[1] += 1
    progress.row, progress.done, progress.share = progress.row + 1, 0.0, 1.0
    arc.path[progress.row].factor = progress.load
    arc.path[progress.row].unstable = problem.unstable()


@jit_exact
def _follow_path(problem, tolerance, stage, state, out, control, workspace, arc, heading, progress):
    """Continue the path at ``progress`` to its end, or until the neighbours must be renewed.

    Return (outcome, rows written).
    """
    while progress.row < stage.steps:
        if progress.iterations == NOT_STARTED:
            progress.share = min(progress.share, 1.0 - progress.done)
            _predict(problem, stage, state, workspace, arc, heading, progress)
        outcome = _correct(state.x, problem, tolerance, stage, workspace, arc, progress)
        if outcome == OUTGROWN and progress.iterations <= 2 * CORRECTIONS:
            return outcome, progress.row
        if control[0] != 0:
            outcome = INTERRUPTED
        passed = progress.row >= 0 and progress.length > 0.0 and progress.load > 1.0
        if outcome == CONVERGED and passed:
            _return_to_full_load(problem, stage, state, workspace, progress)
            continue
        state.totals[0].iterations += progress.iterations
        progress.iterations = NOT_STARTED
        step = _step(workspace, stage, progress, progress.load)
        load = resolution.largest_load(problem, step.factor, workspace.work)
        if outcome == CONVERGED:
            outcome = _judge(
                problem, tolerance, state, step, load, workspace, arc, heading, progress
            )
        if outcome != CONVERGED:
            copy(workspace.x0, state.x)
            problem.roll_back(step)
            progress.share *= 0.5
            if outcome == INTERRUPTED or progress.share < SMALLEST_SHARE or progress.row < 0:
                return (ITERATIONS if outcome == OUTGROWN else outcome), progress.row
            continue
        _accept(problem, step, state, workspace, load, heading, progress)
        if progress.row >= 0 and progress.done < 1.0 and progress.load != 1.0:
            progress.share *= 2.0
            continue
        _end_row(problem, stage, state, out, control, workspace.evaluation, arc, progress)
        if progress.load == 1.0:
            break
    return CONVERGED, progress.row


@jit_owning
def follow(scene, tolerance, stage, state, out, control, arc):
    """Follow the path from ``state`` (changed in place) for the arcs of ``stage``, or until the
    full load; fill ``out`` and ``arc.path``. Return (outcome, rows written).

    scene: `problem.Scene`. control (2,): [0] != 0 interrupts, [1] counts completed arcs.
    """
    progress, n = np.zeros(1, PATH_PROGRESS), state.x.size
    heading = Heading(np.zeros(n), np.zeros(n))
    progress[0].row, progress[0].share, progress[0].iterations = -1, 1.0, NOT_STARTED
    neighbours, buffers = scene.find_neighbours(state.x), scene.make_buffers(state.memory)
    workspace = make_workspace(n, state.stored.size)
    while True:
        record = progress[0]
        problem = by_reference(scene).assemble(by_reference(neighbours), by_reference(buffers))
        outcome, rows = _follow_path(
            problem, tolerance, stage, by_reference(state), out, control,
            by_reference(workspace), arc, heading, record,
        )  # fmt: skip
        if outcome != OUTGROWN:
            return outcome, max(rows, 0)
        neighbours = scene.renew_neighbours(neighbours, state.x, record.travel_bound)
