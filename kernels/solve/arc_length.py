"""Follows a path of equilibria through its limit points: load factor and shape are one unknown.

A point of it balances the load and lies one arc from the point before (Crisfield 1981, Comput.
Struct. 13, 55; both linearised together, as Ramm 1981 and Wempner 1971):

    g(x) = lambda f,   |x - x0|_w = s,   |u|_w^2 = sum w u^2

w is the share of the walls that a node bears, so that s does not depend on the mesh. Newton:

    dx = r + dlambda v,   K r = -(g - lambda f),   K v = f,   dlambda = -(c + c_x . r) / (c_x . v)

No minimum is looked for: K may have negative pivots, as many as there are directions in which the
shape is unstable. Where the load would pass its full value, that takes the place of the arc.
"""

from typing import NamedTuple

import numpy as np

from kernels.terms import bend, friction
from kernels.linear import system
from kernels.solve.residual import largest, reduce
from kernels.solve.energy_book import enter
from kernels.compile.jit import jit_exact, jit_owning
from kernels.solve.march import AT_START, SMALLEST
from kernels.solve.newton import CONVERGED, INTERRUPTED, ITERATIONS, NOT_FINITE, OUTGROWN, STALLED
from kernels.solve.workspace import PREDICTED, make_room
from kernels.arrays import copy, dot, zero
from kernels.planar.potential import Step, covers, evaluate, factor, find_near, renew, step_limit, travel
from kernels.planar.rows import NOW, SPENT, STEPS, write

FACTOR, UNSTABLE = range(2)  # columns of a path
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
            ("far", np.float64),  # that a node goes of it at most, m
            ("spent", np.int64),  # Newton iterations for what is tried
        ],
    )
)
WAY, TANGENT = range(2)  # last move, and that of a unit of load from its end
TRIES = 20  # Newton iterations of an arc
ON_ARC = 1e-6  # of the arc: farther off it is another one
BEND = 0.7  # cosine between an arc and its start, or the arc before: less is another path
MOST_LOAD = 0.05  # of the full load: no arc sets out for more


class Arc(NamedTuple):
    """weight (n,) of a coordinate, zero for rotations; length of an arc in m; path (steps + 1, 2):
    load factor and number of unstable directions, at the start and at the end of every arc.
    """

    weight: np.ndarray
    length: float
    path: np.ndarray


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
def _combine(r, share, v, unknowns, dx):
    """Fill dx with r + share v; return its longest move of a coordinate, m."""
    most = 0.0
    for i in range(dx.size):
        dx[i] = r[i] + share * v[i]
        if unknowns.leader[i] >= 0:
            most = max(most, abs(dx[i]) * unknowns.scale[i])
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
def _balance(x, terms, before, near, unknowns, tolerance, room, arc, progress):
    """Move ``x`` (n,) on by ``work.dx`` and the load by its rise until both are in balance."""
    _, at, work, grips, way = room
    r, v = work.direction, work.escape
    while True:
        if not progress.move < np.inf:
            return NOT_FINITE
        cut = unknowns.cap / max(progress.move, unknowns.cap)
        progress.far = cut * travel(work.dx, terms)
        if not covers(near, x, terms, progress.far):
            return OUTGROWN
        share = min(cut, step_limit(x, work.dx, progress.far, terms, near, at))
        for i in range(x.size):
            x[i] += share * work.dx[i]
        arrives = share == 1.0 and progress.length == 0.0
        progress.load = progress.aim if arrives else progress.load + share * progress.rise
        zero(work.dx)
        progress.rise, progress.move, progress.spent = 0.0, 0.0, progress.spent + 1
        step = Step(before, way[PREDICTED], np.inf, progress.load, grips, terms.friction.slip, 0.5)
        evaluate(x, terms, step, near, at, False)
        reduce(at.g, unknowns, work.residual)
        size = largest(work.residual, unknowns)
        if not size < np.inf:
            return NOT_FINITE
        factor(x, terms, step, near, at, False, True)
        if near.system.matrix.missing[0] != 0:
            return OUTGROWN
        for i in range(x.size):
            r[i], v[i] = -at.g[i], terms.load[i]
        system.solve(near.system, terms.layout, r)
        system.solve(near.system, terms.layout, v)
        rise, met = _off(at.u, r, v, arc, progress)
        if met and size <= tolerance.force and abs(0.5 * dot(at.g, r)) <= tolerance.decrement:
            return CONVERGED
        if progress.spent > min(TRIES, tolerance.iterations):
            return ITERATIONS
        progress.rise, progress.move = rise, _combine(r, rise, v, unknowns, work.dx)


@jit_exact
def _set_out(terms, unknowns, state, room, arc, trail, progress):
    """Point dx along the path, for an arc or for what the load lacks, whichever is shorter."""
    before, _, work, _, _ = room
    copy(state.x, before.x0)
    copy(state.x, before.y)
    bend.aim(state.x, terms.walls, terms.bend, before.frame)
    tangent, way = trail[TANGENT], trail[WAY]
    progress.spent, progress.load, progress.aim = 0, state.held[1], state.held[1]
    progress.length, progress.rise = 0.0, 0.0
    if progress.row >= 0:
        size = np.sqrt(_inner(tangent, tangent, arc.weight))
        length = progress.share * min(arc.length, MOST_LOAD * size)
        progress.rise = length / size * (-1.0 if _inner(tangent, way, arc.weight) < 0.0 else 1.0)
        progress.length = length
        if progress.rise >= 1.0 - progress.load:
            progress.rise, progress.length, progress.aim = 1.0 - progress.load, 0.0, 1.0
    zero(work.residual)
    progress.move = _combine(work.residual, progress.rise, tangent, unknowns, work.dx)


@jit_exact
def _return(before, at, state, unknowns, work, progress):
    """Set out from the last point for the full load instead, as an arc has passed it."""
    share = (1.0 - state.held[1]) / (progress.load - state.held[1])
    copy(before.x0, state.x)
    zero(at.least)  # what was found last was found elsewhere
    zero(work.residual)
    progress.move = _combine(work.residual, share, at.u, unknowns, work.dx)
    progress.load, progress.rise = state.held[1], 1.0 - state.held[1]
    state.totals[SPENT] += progress.spent
    progress.length, progress.aim, progress.spent = 0.0, 1.0, 0


@jit_exact
def _go(terms, unknowns, tolerance, stage, state, out, control, near, room, arc, trail, progress):
    """Follow the path from where ``progress`` says, to its end or until room is lacking.

    Return the outcome and the rows written.
    """
    before, at, work, grips, way = room
    while progress.row < stage.steps:
        if progress.spent == AT_START:
            progress.share = min(progress.share, 1.0 - progress.done)
            _set_out(terms, unknowns, state, room, arc, trail, progress)
        outcome = _balance(state.x, terms, before, near, unknowns, tolerance, room, arc, progress)
        if outcome == OUTGROWN and progress.spent <= 2 * TRIES:
            return outcome, progress.row
        if control[0] != 0:
            outcome = INTERRUPTED
        if outcome == CONVERGED and progress.row >= 0:
            if progress.length > 0.0 and progress.load > 1.0:
                _return(before, at, state, unknowns, work, progress)
                continue
            side = -1.0 if _inner(trail[TANGENT], trail[WAY], arc.weight) < 0.0 else 1.0
            if side * _cosine(at.u, trail[TANGENT], arc.weight) < BEND:
                outcome = STALLED
        state.totals[SPENT] += progress.spent
        progress.spent = AT_START
        if outcome != CONVERGED:
            copy(before.x0, state.x)
            zero(at.least)
            progress.share *= 0.5
            if outcome == INTERRUPTED or progress.share < SMALLEST or progress.row < 0:
                return (ITERATIONS if outcome == OUTGROWN else outcome), progress.row
            continue
        step = Step(before, way[PREDICTED], np.inf, progress.load, grips, terms.friction.slip, 0.5)
        enter(terms, step, unknowns, state, at, work)
        copy(work.escape, trail[TANGENT])
        if progress.row >= 0:
            copy(at.u, trail[WAY])
            progress.done += progress.share
            state.totals[STEPS] += 1
            if progress.done < 1.0 and progress.load != 1.0:
                progress.share *= 2.0
                continue
            state.totals[NOW] += stage.pace
            write(out, progress.row, state, terms, near, unknowns, at)
            control[1] += 1
        progress.row, progress.done, progress.share = progress.row + 1, 0.0, 1.0
        arc.path[progress.row, FACTOR] = progress.load
        arc.path[progress.row, UNSTABLE] = system.negatives(near.system)
        if progress.load == 1.0:
            break
    return CONVERGED, progress.row


@jit_owning
def follow(terms, unknowns, tolerance, stage, state, out, control, arc):
    """Follow the path from ``state`` (changed in place) for the arcs of ``stage``, or until the
    load is full; fill ``out`` and ``arc.path``.

    Return (outcome, rows written). ``control`` (2,): [0] != 0 interrupts, [1] counts arcs done.
    """
    progress, trail = np.zeros(1, PROGRESS), np.zeros((2, state.x.size))
    progress[0].row, progress[0].share, progress[0].spent = -1, 1.0, AT_START
    near = find_near(state.x, terms, friction.none(), 0.0)
    room = make_room(terms, near)
    while True:
        now = progress[0]
        outcome, rows = _go(
            terms, unknowns, tolerance, stage, state, out, control, near, room, arc, trail, now
        )
        if outcome != OUTGROWN:
            return outcome, max(rows, 0)
        near = renew(near, state.x, terms, room.grips, progress[0].far)
