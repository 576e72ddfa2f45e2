"""Newton's method for one step: a descent to a minimum.

The exact Hessian is used wherever it is positive definite (all pivots positive); elsewhere the
projected one, or the direction of the negative pivot if that promises a greater fall. The step is
cut to its admissible share and backtracked until the energy falls (Armijo); what is evaluated there
serves the next iteration. Converged means: scaled residual and Newton decrement below tolerance
*and* no negative pivot in the exact Hessian, here or one step shorter than `Unknowns.close` before.
"""

from typing import NamedTuple

import numpy as np

from kernels import chain, system
from kernels.jit import jit, jit_exact, jit_inlined
from kernels.rows import copy
from kernels.step import covers, evaluate, factor, find_near, step_limit

CONVERGED, ITERATIONS, STALLED, INTERRUPTED, SINGULAR, NOT_FINITE = range(6)
ARMIJO = 1e-4
HALVINGS = 40
LEAST_SHARE = 1e-12  # of a step: less is standing still
RESOLVED = 1e-11  # an energy change below this share of the energy is lost in round-off


class Tolerance(NamedTuple):
    """What counts as converged.

    force: largest residual in N. decrement: largest Newton decrement in J. friction: largest change
    of a lagged friction force in N. noise: energy changes below it are round-off, J. iterations:
    most for one minimum.
    """

    force: float
    decrement: float
    friction: float
    noise: float
    iterations: int


class Unknowns(NamedTuple):
    """Which coordinates move, and how far at once.

    leader (n,): as in `system.Layout`. scale (n,): length that turns a coordinate into m, 1 for one
    in m. driven: coordinate that is led to a target, -1 if none. cap: longest move in one
    iteration, m. leap: first move along a direction of negative curvature, m. close: a move so
    short that stability cannot have been lost on it, m.
    """

    leader: np.ndarray
    scale: np.ndarray
    driven: int
    cap: float
    leap: float
    close: float


class Work(NamedTuple):
    """Scratch arrays by coordinate."""

    dx: np.ndarray
    trial: np.ndarray
    residual: np.ndarray
    direction: np.ndarray
    escape: np.ndarray


@jit
def reduce(g, leader, residual):
    """Fill ``residual`` (n,) with ``g``, what is tied added to its leader, zero where held."""
    residual[:] = 0.0
    for i in range(g.size):
        if leader[i] >= 0:
            residual[leader[i]] += g[i]


@jit_exact
def largest(residual, unknowns):
    """Return the largest residual of the free coordinates in N; NaN if any is."""
    most = 0.0
    for i in range(residual.size):
        size = abs(residual[i]) / unknowns.scale[i] if i != unknowns.driven else 0.0
        if not size <= most:
            most = size
            if size != size:
                return size
    return most


@jit_exact
def _longest(direction, unknowns):
    """Return the largest move in m of a coordinate that is not led."""
    most = 0.0
    for i in range(direction.size):
        if unknowns.leader[i] >= 0 and unknowns.leader[i] != unknowns.driven:
            most = max(most, abs(direction[i]) * unknowns.scale[i])
    return most


@jit_exact
def _dot(a, b):
    total = 0.0
    for i in range(a.size):
        total += a[i] * b[i]
    return total


@jit_exact
def _solve(terms, near, unknowns, at, work, remaining):
    """Point ``work.direction`` to where the quadratic model is stationary; return its slope there.

    A driven coordinate that has ``remaining`` m to go takes the others along.
    """
    direction, matrix = work.direction, near.system.matrix
    if remaining != 0.0:
        for i in range(direction.size):
            direction[i] = remaining if unknowns.leader[i] == unknowns.driven else 0.0
        at.shape.slope[:] = 0.0
        at.shape.moment[:] = 0.0
        chain.product(terms.walls, at.stiffness, direction, at.shape)
        direction[:] = 0.0
        chain.gather(terms.walls, at.shape, direction)
        for i in range(direction.size):
            direction[i] += matrix.pull[i] * remaining
    else:
        direction[:] = 0.0
    for i in range(direction.size):
        direction[i] = -at.g[i] - direction[i]
    system.solve(near.system, terms.layout, direction)
    if remaining != 0.0:
        for i in range(direction.size):
            if unknowns.leader[i] == unknowns.driven:
                direction[i] = remaining
    return _dot(at.g, direction)


@jit_exact
def _aim_off(terms, near, unknowns, at, work, place):
    """Point ``work.escape`` downhill along the negative pivot, with a move of ``unknowns.leap``.

    Return slope and curvature of the energy along it.
    """
    wall, failed, pivot = place
    system.descend(near.system, terms.layout, wall, failed, work.escape)
    slope = _dot(at.g, work.escape)
    factor = unknowns.leap / _longest(work.escape, unknowns) * (-1.0 if slope > 0.0 else 1.0)
    for i in range(work.escape.size):
        work.escape[i] *= factor
    return slope * factor, pivot * factor * factor


@jit_inlined
def _factored(x, terms, step, near, at, projected):
    """Factor at ``x``; where contact outgrew the system, find a new one first."""
    place = factor(x, terms, step, near, at, projected)
    while near.system.matrix.missing[0] != 0:
        near = find_near(x, terms, step.grips, 0.0)
        evaluate(x, terms, step, near, at, projected)
        place = factor(x, terms, step, near, at, projected)
    return place, near


@jit_inlined
def _search(x, terms, step, near, at, work, noise, model, led):
    """Backtrack from the share of dx in ``model`` until the energy falls; move ``x`` there.

    ``model``: share, energy at x, slope and curvature along dx. ``led``: any energy will do.
    Return (share, energy), share 0 if it never falls.
    """
    share, start, slope, curvature = model
    noise += RESOLVED * abs(start)
    for _ in range(HALVINGS):
        for i in range(x.size):
            work.trial[i] = x[i] + share * work.dx[i]
        reached = evaluate(work.trial, terms, step, near, at, False)
        expected = ARMIJO * share * (slope + 0.5 * share * curvature)
        if abs(expected) <= ARMIJO * noise:
            expected = noise
        if reached < np.inf and (led or reached <= start + expected):
            copy(work.trial, x)
            return share, reached
        share *= 0.5
    return 0.0, start


@jit_inlined
def minimise(x, target, terms, step, near, unknowns, tolerance, at, work, control):
    """Descend from ``x`` (n,), in place, to a minimum with the driven coordinate at ``target``.

    Return (outcome, iterations, near); ``at`` holds what `evaluate` finds at the end.
    ``control[0]`` != 0 interrupts.
    """
    value = evaluate(x, terms, step, near, at, False)
    moved = np.inf  # since the last exact and positive factor, which is kept
    for iteration in range(tolerance.iterations):
        if control[0] != 0:
            return INTERRUPTED, iteration, near
        reduce(at.g, unknowns.leader, work.residual)
        size = largest(work.residual, unknowns)
        if not size < np.inf:
            return NOT_FINITE, iteration, near
        remaining = target - x[unknowns.driven] if unknowns.driven >= 0 else 0.0
        settled = remaining == 0.0 and size <= tolerance.force
        stable, fall, curvature = True, 0.0, 0.0
        if not (settled and moved <= unknowns.close):
            place, near = _factored(x, terms, step, near, at, False)
            stable = place[1] < 0
        if not stable:
            fall, curvature = _aim_off(terms, near, unknowns, at, work, place)
            if not settled:
                evaluate(x, terms, step, near, at, True)
                place, near = _factored(x, terms, step, near, at, True)
                if place[1] >= 0:
                    return SINGULAR, iteration, near
        slope = 0.0
        if stable or not settled:
            slope = _solve(terms, near, unknowns, at, work, remaining)
        if settled and stable and -0.5 * slope <= tolerance.decrement:
            return CONVERGED, iteration, near
        if remaining != 0.0 or stable or fall + 0.5 * curvature > 0.5 * slope:
            copy(work.direction, work.dx)
            curvature = 0.0
        else:
            copy(work.escape, work.dx)
            slope = fall
        most = _longest(work.dx, unknowns)
        cap = max(unknowns.cap, 5.0 * abs(remaining))
        if most > cap:
            for i in range(x.size):
                work.dx[i] *= cap / most
            slope *= cap / most
            most = cap
        moved = most if stable else np.inf
        farthest = max(most, abs(remaining))
        if not covers(near, x, terms, farthest):
            near = find_near(x, terms, step.grips, farthest)
            moved = np.inf
        share = step_limit(x, work.dx, farthest, terms, near, at)
        model = share, value, slope, curvature
        led = remaining != 0.0
        share, value = _search(x, terms, step, near, at, work, tolerance.noise, model, led)
        if share < LEAST_SHARE:
            return STALLED, iteration, near
        if led and share == 1.0 and most < cap:
            x[unknowns.driven] = target
    return ITERATIONS, tolerance.iterations, near
