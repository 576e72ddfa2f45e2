"""Newton's method for one step: a descent to a minimum, with the proof that it is one.

The exact Hessian is used wherever it is positive definite (all pivots positive); elsewhere the
projected one, or the direction of the negative pivot if that promises a greater fall. The step is
cut to its admissible share and backtracked until the energy falls (Armijo). Converged means: scaled
residual and Newton decrement below tolerance *and* an exact Hessian without a negative pivot.
"""

from typing import NamedTuple

import numpy as np

from kernels import sparse
from kernels.jit import jit, jit_exact, jit_owning
from kernels.step import covers, energy, find_near, gradient, hessian, step_limit

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

    row (n,): row of each coordinate or -1. scale (rows,): length that turns a row's unit into m,
    1 for a coordinate in m. free: rows solved for (a driven row comes last). driven: coordinate
    that is led to a target, -1 if none. cap: longest move in one iteration, m. leap: first move
    along a direction of negative curvature, m.
    """

    row: np.ndarray
    scale: np.ndarray
    free: int
    driven: int
    cap: float
    leap: float


class Work(NamedTuple):
    """Scratch arrays: g, dx, trial (n,) by coordinate; residual, direction, escape (rows,)."""

    g: np.ndarray
    dx: np.ndarray
    trial: np.ndarray
    residual: np.ndarray
    direction: np.ndarray
    escape: np.ndarray


@jit
def reduce(g, row, residual):
    """Fill ``residual`` (rows,) with ``g`` (n,) gathered by row."""
    residual[:] = 0.0
    for i in range(g.size):
        if row[i] >= 0:
            residual[row[i]] += g[i]


@jit_exact
def largest(residual, unknowns):
    """Return the largest residual of the free rows in N; NaN if any is."""
    most = 0.0
    for i in range(unknowns.free):
        size = abs(residual[i]) / unknowns.scale[i]
        if not size <= most:
            most = size
            if size != size:
                return size
    return most


@jit_exact
def _spread(direction, unknowns, dx):
    """Fill ``dx`` (n,) from rows; return the largest move in m."""
    for i in range(dx.size):
        r = unknowns.row[i]
        dx[i] = direction[r] if r >= 0 else 0.0
    most = 0.0
    for i in range(unknowns.free):
        most = max(most, abs(direction[i]) * unknowns.scale[i])
    return most


@jit_exact
def _factored(x, terms, step, near, unknowns, projected):
    """Assemble and factor; return the first row with a negative pivot (-1: none) and the pivot."""
    hessian(x, terms, step, near, projected)
    matrix = near.matrix
    scale = 0.0
    for i in range(unknowns.free):
        scale = max(scale, abs(matrix.values[matrix.offset[i] + i]))
    return sparse.factor(matrix, unknowns.free, scale)


@jit
def _pull_of_driven(matrix, unknowns, remaining, direction):
    """Subtract the force that the driven row's move ``remaining`` exerts on the free rows."""
    s = unknowns.free
    for j in range(matrix.first[s], s):
        direction[j] -= matrix.values[matrix.offset[s] + j] * remaining


@jit_exact
def _dot(a, b, n):
    total = 0.0
    for i in range(n):
        total += a[i] * b[i]
    return total


@jit_exact
def _search(x, terms, step, near, work, noise, model, share):
    """Backtrack from ``share`` of dx until the energy falls; return the share, 0 if never."""
    slope, curvature = model
    start = energy(x, terms, step, near)
    noise += RESOLVED * abs(start)
    for _ in range(HALVINGS):
        for i in range(x.size):
            work.trial[i] = x[i] + share * work.dx[i]
        reached = energy(work.trial, terms, step, near)
        expected = ARMIJO * share * (slope + 0.5 * share * curvature)
        if abs(expected) <= ARMIJO * noise:
            expected = noise
        if reached <= start + expected and reached < np.inf:
            return share
        share *= 0.5
    return 0.0


@jit_exact
def _solve(matrix, unknowns, work, remaining):
    """Point ``work.direction`` to where the quadratic model is stationary; return its slope there.

    A driven row that has ``remaining`` m to go takes the others along (no slope is defined then).
    """
    for i in range(work.residual.size):
        work.direction[i] = -work.residual[i]
    if remaining != 0.0:
        _pull_of_driven(matrix, unknowns, remaining, work.direction)
    sparse.solve(matrix, unknowns.free, work.direction)
    if unknowns.driven >= 0:
        work.direction[unknowns.free] = remaining
    return _dot(work.residual, work.direction, unknowns.free)


@jit_exact
def _aim_off(matrix, unknowns, work, failed, pivot):
    """Point ``work.escape`` downhill along the negative pivot, with a move of ``unknowns.leap``.

    Return slope and curvature of the energy along it.
    """
    sparse.descent(matrix, failed, work.escape)
    slope = _dot(work.residual, work.escape, unknowns.free)
    most = 0.0
    for i in range(unknowns.free):
        most = max(most, abs(work.escape[i]) * unknowns.scale[i])
    factor = unknowns.leap / most * (-1.0 if slope > 0.0 else 1.0)
    for i in range(work.escape.size):
        work.escape[i] *= factor
    return slope * factor, pivot * factor * factor


@jit_owning
def minimise(x, target, terms, step, near, unknowns, tolerance, work, control):
    """Descend from ``x`` (n,), in place, to a minimum with the driven coordinate at ``target``.

    Return (outcome, iterations, near). ``control[0]`` != 0 interrupts.
    """
    for iteration in range(tolerance.iterations):
        if control[0] != 0:
            return INTERRUPTED, iteration, near
        gradient(x, terms, step, near, work.g)
        reduce(work.g, unknowns.row, work.residual)
        size = largest(work.residual, unknowns)
        if not size < np.inf:
            return NOT_FINITE, iteration, near
        remaining = target - x[unknowns.driven] if unknowns.driven >= 0 else 0.0
        settled = remaining == 0.0 and size <= tolerance.force
        failed, stable, fall, curvature = 0, False, 0.0, 0.0
        for projected in (False, True):
            failed, pivot = _factored(x, terms, step, near, unknowns, projected)
            if failed < 0:
                stable = not projected
                break
            if projected:
                return SINGULAR, iteration, near
            fall, curvature = _aim_off(near.matrix, unknowns, work, failed, pivot)
            if settled:
                break
        slope = 0.0
        if failed < 0:
            slope = _solve(near.matrix, unknowns, work, remaining)
        if settled and stable and -0.5 * slope <= tolerance.decrement:
            return CONVERGED, iteration, near
        if remaining != 0.0 or stable or fall + 0.5 * curvature > 0.5 * slope:
            most = _spread(work.direction, unknowns, work.dx)
            curvature = 0.0
        else:
            most = _spread(work.escape, unknowns, work.dx)
            slope = fall
        cap = max(unknowns.cap, 5.0 * abs(remaining))
        if most > cap:
            for i in range(x.size):
                work.dx[i] *= cap / most
            slope *= cap / most
            most = cap
        if not covers(near, x, terms, most):
            near = find_near(x, terms, most)
        share = step_limit(x, work.dx, terms, near)
        if remaining == 0.0:
            model = slope, curvature
            share = _search(x, terms, step, near, work, tolerance.noise, model, share)
        if share < LEAST_SHARE:
            return STALLED, iteration, near
        for i in range(x.size):
            x[i] += share * work.dx[i]
        if remaining != 0.0 and share == 1.0 and most < cap:
            x[unknowns.driven] = target
    return ITERATIONS, tolerance.iterations, near
