"""The fixed-point loop of friction: lag the normal forces anew until a step ends where they are.

How far off friction still is tells how well the next minimum need be found: each brings it nearer
by about as much. The first mostly decides which way a lattice folds, and is found to the end; so is
the last.
"""

import numpy as np

from kernels.terms import friction
from kernels.solve.residual import allowed, largest, reduce
from kernels.compile.jit import jit_exact
from kernels.solve.aitken import approach
from kernels.solve.workspace import CHANGE, LAGGED
from kernels.arrays import copy, zero
from kernels.planar.potential import RUBBED, WHOLE, drift, rub

MOST = 30  # loops
STUCK = 8  # of them without coming nearer: it goes round in circles
CAREFUL = 6  # after so many every minimum is found to the end
ROUGHLY = 0.1  # of what friction is off by: what the next minimum may leave
UNSETTLED = 8  # an outcome, beside those of `newton` and `march`


@jit_exact
def begin(progress):
    """Set out on the loop of a step; ``progress``: as in `march`."""
    progress.loops, progress.relaxed, progress.rough = 0, 0.0, 1.0
    progress.nearest, progress.circles = np.inf, 0


@jit_exact
def agrees(x, terms, step, near, unknowns, tolerance, room, progress):
    """Lag friction anew; return whether ``x`` is still in balance: then ``room.at`` is as it was.

    Otherwise it, and ``room.work.trial``, tell of ``x`` with the friction that is lagged now.
    """
    _, at, work, grips, way = room
    held, whole, rubbed = grips.count[0], at.sum[WHOLE], at.sum[RUBBED]
    copy(at.g, work.trial)
    copy(at.rubbing, work.escape)
    y = way[LAGGED]
    progress.relaxed = approach(x, y, way[CHANGE], unknowns, progress.relaxed)
    friction.lag(y, terms.contact, near.pairs, drift(y, terms, near), terms.friction, grips)
    if held + grips.count[0] == 0 and progress.rough == 1.0:
        return True
    rub(terms, step, at)
    reduce(at.g, unknowns, work.residual)
    off = largest(work.residual, unknowns)
    enough = max(tolerance.friction, tolerance.grip * largest(at.rubbing, unknowns))
    enough = max(enough, allowed(near.system.matrix, tolerance)[0])
    agree = off <= enough and progress.rough == 1.0
    if agree:
        copy(work.trial, at.g)
        copy(work.escape, at.rubbing)
        at.sum[WHOLE], at.sum[RUBBED] = whole, rubbed
    _count(off, enough, tolerance.force, progress)
    copy(x, work.trial)
    zero(work.dx)
    return agree


@jit_exact
def _count(off, enough, force, progress):
    """Note how far ``off`` friction was, and how well the next minimum is to be found."""
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
