"""The fixed-point loop of forces that lag, as friction does: taken anew until a step ends there
(`Problem.lag`; of a lattice, `terms.friction.lag`).

How far off they still are tells how well the next minimum need be found: each brings it nearer by
about as much. The first mostly decides which way a lattice folds, and is found to the end; so is
the last.
"""

import numpy as np

from kernels.arrays import copy, zero
from kernels.compile.jit import jit_exact
from kernels.solve.aitken import approach
from kernels.solve.residual import allowed, largest

MOST = 30  # loops
STUCK = 8  # of them without coming nearer: it goes round in circles
CAREFUL = 6  # after so many every minimum is found to the end
ROUGHLY = 0.1  # of what lagged forces are off by: what the next minimum may leave
UNSETTLED = 8  # an outcome, beside those of `newton` and `march`


@jit_exact
def begin(progress):
    """Set out on the loop of a step; ``progress``: as in `march`."""
    progress.loops, progress.relaxed, progress.rough = 0, 0.0, 1.0
    progress.nearest, progress.circles = np.inf, 0


@jit_exact
def agrees(x, problem, step, tolerance, space, progress):
    """Lag forces anew; return whether ``x`` is still in balance: then ``space.found`` is as it was.

    Otherwise it, and ``space.work.trial``, tell of ``x`` with the forces that are lagged now.
    """
    found, work, coordinates = space.found, space.work, problem.scene.coordinates
    sums = found.sums[0]
    potential, rubbed = sums.potential, sums.friction
    copy(found.g, work.trial)
    copy(found.friction, work.escape)
    progress.relaxed = approach(x, space.lagged, space.drift, coordinates, progress.relaxed)
    if not problem.lag(space.lagged) and progress.rough == 1.0:
        return True
    problem.exchange(step, found)
    problem.reduce(found.g, work.residual)
    off = largest(work.residual, coordinates)
    enough = max(tolerance.friction, tolerance.grip * largest(found.friction, coordinates))
    enough = max(enough, allowed(problem.stiffest(), tolerance)[0])
    agree = off <= enough and progress.rough == 1.0
    if agree:
        copy(work.trial, found.g)
        copy(work.escape, found.friction)
        sums.potential, sums.friction = potential, rubbed
    _count(off, enough, tolerance.force, progress)
    copy(x, work.trial)
    zero(work.dx)
    return agree


@jit_exact
def _count(off, enough, force, progress):
    """Note how far ``off`` forces were, and how well the next minimum is to be found."""
    progress.loops, progress.tried = progress.loops + 1, 0
    progress.circles = 0 if off < progress.nearest else progress.circles + 1
    progress.nearest, progress.rough = min(off, progress.nearest), 1.0
    left = ROUGHLY * off
    if enough < left < np.inf and progress.loops <= CAREFUL:
        progress.rough = left / force


@jit_exact
def in_vain(progress):
    """Return whether the loop had better be given up."""
    return progress.loops >= MOST or progress.circles >= STUCK
