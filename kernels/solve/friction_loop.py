"""The fixed-point loop of a step for lagged forces, such as friction.

Minimise with the lagged forces fixed, lag them again at the minimum, and repeat until the minimum
remains an equilibrium. The loop is inexact: a minimum is found to a share of the present error of
the lagged forces, as each iteration reduces that error by about a constant factor. The first
minimum, which mostly decides which way a lattice folds, and the last one are found to the full
tolerance. Forces are lagged by `Problem.lag`; for the lattice see `terms.friction.lag`.
"""

import numpy as np

from kernels.arrays import copy, zero
from kernels.compile.jit import jit_exact
from kernels.solve.anderson import extrapolate
from kernels.solve.residual import allowed, largest_residual
from kernels.solve.resolution import LARGEST_RESIDUAL

MAX_LOOPS = 30
STAGNATION = 8  # loops without a new least error after which the loop fails
INEXACT_LOOPS = 6  # later minima are found to the full tolerance
FORCING_TERM = 0.1  # residual of the next minimum as a share of the error of the lagged forces


@jit_exact
def begin(progress):
    """Reset the loop for a step. progress: `march.PROGRESS`."""
    progress.loops, progress.loosening = 0, 1.0
    progress.least_error, progress.stagnant = np.inf, 0


@jit_exact
def is_converged(x, problem, step, tolerance, space, progress):
    """Lag the forces again; return whether ``x`` (n,) is still an equilibrium.

    If so, ``space.found`` is unchanged. Otherwise ``space.found`` holds the evaluation at ``x``
    with the new lagged forces, and ``space.work.trial`` is ``x``.
    """
    found, work, coordinates = space.found, space.work, problem.scene.coordinates
    sums = found.sums[0]
    potential, friction = sums.potential, sums.friction
    copy(found.g, work.trial)
    copy(found.friction, work.escape)
    extrapolate(x, space.lagged, coordinates, progress.loops, space.past)
    if not problem.lag(space.lagged) and progress.loosening == 1.0:
        return True
    error = _error(problem, step, found, work)
    limit = _admissible(
        largest_residual(found.friction, coordinates), problem.stiffest(), tolerance
    )
    converged = error <= limit and progress.loosening == 1.0
    if converged:  # also with the forces at ``x``, which may be far from the extrapolated place
        problem.lag(x)
        converged = _error(problem, step, found, work) <= limit
        if not converged:
            problem.lag(space.lagged)
            problem.exchange(step, found)
    if converged:
        copy(work.trial, found.g)
        copy(work.escape, found.friction)
        sums.potential, sums.friction = potential, friction
    _update(error, limit, tolerance.force, progress)
    copy(x, work.trial)
    zero(work.dx)
    return converged


@jit_exact
def _error(problem, step, found, work):
    """Return the largest residual in N with the present lagged forces, which ``found`` then has."""
    problem.exchange(step, found)
    problem.reduce(found.g, work.residual)
    return largest_residual(work.residual, problem.scene.coordinates)


@jit_exact
def _admissible(force, stiffest, tolerance):
    """Return the admissible error of lagged forces in N. force: the largest of them, N.

    The round-off of the ``stiffest`` contact (N/m) is no error, but it has no bound: what is more
    than `LARGEST_RESIDUAL` of the force is not resolved.
    """
    rounded = min(allowed(stiffest, tolerance), LARGEST_RESIDUAL * force)
    return max(tolerance.friction, tolerance.friction_share * force, rounded)


@jit_exact
def _update(error, limit, force, progress):
    """Count a loop in which the lagged forces had an ``error`` (N); loosen the next tolerance.

    limit: error that is admissible, N. force: full tolerance of the residual, N.
    """
    progress.loops, progress.minimum_iterations = progress.loops + 1, 0
    progress.stagnant = 0 if error < progress.least_error else progress.stagnant + 1
    progress.least_error, progress.loosening = min(error, progress.least_error), 1.0
    next_error = FORCING_TERM * error
    if limit < next_error < np.inf and progress.loops <= INEXACT_LOOPS:
        progress.loosening = next_error / force


@jit_exact
def fails(progress):
    """Return whether the loop has too many iterations or stagnates."""
    return progress.loops >= MAX_LOOPS or progress.stagnant >= STAGNATION
