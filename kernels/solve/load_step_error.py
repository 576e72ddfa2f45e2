"""Error of a static step of a driven coordinate, in the work of that step.

With F the reaction at the driven coordinate, d its move in the step, and d0 in the previous step:

    work = (F0 + F1) d / 2,
    error = |F'' d^3 / 12| + |(r1 - r0) . u| / 2 + 4 sum |(a1' - a0') a1'| d^2

The first part is the error of the trapezoidal rule, with the second derivative F'' of the quadratic
through the last three reactions, 2 (s1 - s0) / (d + d0) with slopes s = dF / d. The second part
bounds the error of friction, whose normal forces are estimated before the step (`march`): its
forces r are off by no more than their change in a step, in which the coordinates move by u.

The third part is the error of walls that relax, whose stress is exact if strains change evenly in a
step (`laws.relaxation`). Where walls begin to buckle they do not, and in a step that is too long
they buckle too early, against the stiffness of a wall that has relaxed meanwhile. A stored energy
a^2 belongs to a shape with the amplitude a, whose force is 2 a; with a' the change of a in a step /
d, half of the unexpected change (a1' - a0') d is the error of the amplitude, as in backward Euler,
and the energy errs by the force times the change a1' d. It counts fourfold, as it grows with the
shape: with less weight some re-entrant cells and diamonds take other folds (docs/accuracy.md).
"""

import math

from kernels.compile.jit import jit_exact

WEIGHT = 4.0  # of the error of walls that relax


@jit_exact
def _of_friction(state, evaluation):
    """Return |(r1 - r0) . u| / 2 in J, with the gradients r of friction after two steps."""
    before, work = state.gradients.friction, 0.0
    for i in range(evaluation.u.size):
        work += (evaluation.friction[i] - before[i]) * evaluation.u[i]
    return 0.5 * abs(work)


@jit_exact
def _growth(state, evaluation, k):
    """Return the change of the amplitude of stored energy ``k`` in a step, J^0.5."""
    return math.sqrt(max(evaluation.stored[k], 0.0)) - math.sqrt(max(state.stored[k], 0.0))


@jit_exact
def measure_growth(state, evaluation, move, growing):
    """Fill ``growing`` (k,) with a' of each stored energy in a step, J^0.5 / m."""
    for k in range(growing.size):
        growing[k] = _growth(state, evaluation, k) / move


@jit_exact
def of_relaxation(state, evaluation, move, growing):
    """Return sum |(a1' - a0') a1'| d^2 in J. growing (k,): a0' of each stored energy."""
    error = 0.0
    for k in range(growing.size):
        growth = _growth(state, evaluation, k)
        error += abs((growth - growing[k] * move) * growth)
    return error


@jit_exact
def _driven(problem, evaluation, work):
    """Return the move of the driven coordinate in a step, and the reaction after it; 0 without."""
    driven = problem.scene.coordinates.driven
    if driven < 0:
        return 0.0, 0.0
    problem.reduce(evaluation.g, work.residual)
    return evaluation.u[driven], work.residual[driven]


@jit_exact
def ratio(problem, stage, state, evaluation, work, progress, growing):
    """Return the error of the work in a step as a share of that work, 0 where nothing is driven.

    evaluation: at the end of the step, before `Problem.commit`. progress, growing: see `keep`.
    """
    move, after = _driven(problem, evaluation, work)
    if move == 0.0:
        return 0.0
    before, error = state.totals[0].reaction, _of_friction(state, evaluation)
    if progress.move != 0.0:
        bend = ((after - before) / move - progress.slope) / (move + progress.move)
        error += abs(bend * move**3) / 6.0
        if stage.relaxes:
            error += WEIGHT * of_relaxation(state, evaluation, move, growing)
    done = 0.5 * abs((before + after) * move)
    if done > 0.0:
        return error / done
    return math.inf if error > 0.0 else 0.0


@jit_exact
def keep(problem, state, evaluation, work, progress, growing):
    """Keep the move of a step that is accepted, the slope of its reaction in ``progress``, and a'
    of each stored energy in ``growing`` (k,), J^0.5 / m. Before `Problem.commit`.
    """
    move, after = _driven(problem, evaluation, work)
    progress.move, progress.slope = move, 0.0
    if move != 0.0:
        progress.slope = (after - state.totals[0].reaction) / move
        measure_growth(state, evaluation, move, growing)
