"""Error of a static step of a driven coordinate, in the work of that step.

With F the reaction at the driven coordinate, d its move in the step, and d0 in the previous step:

    work = (F0 + F1) d / 2,    error = |F'' d^3 / 12| + |(r1 - r0) . u| / 2

The first part is the error of the trapezoidal rule, with the second derivative F'' of the quadratic
through the last three reactions, 2 (s1 - s0) / (d + d0) with slopes s = dF / d. The second part
bounds the error of friction, whose normal forces are estimated before the step (`march`): its
forces r are off by no more than their change in a step, in which the coordinates move by u.
"""

import numpy as np

from kernels.compile.jit import jit_exact


@jit_exact
def _of_friction(state, evaluation):
    """Return |(r1 - r0) . u| / 2 in J, with the gradients r of friction after two steps."""
    before, work = state.gradients.friction, 0.0
    for i in range(evaluation.u.size):
        work += (evaluation.friction[i] - before[i]) * evaluation.u[i]
    return 0.5 * abs(work)


@jit_exact
def ratio(problem, state, evaluation, work, progress):
    """Return the error of the work in a step as a share of that work, 0 where nothing is driven.

    evaluation: at the end of the step, before `energy_book.enter_step`. progress: see `keep`.
    """
    driven = problem.scene.coordinates.driven
    move = evaluation.u[driven] if driven >= 0 else 0.0
    if move == 0.0:
        return 0.0
    problem.reduce(evaluation.g, work.residual)
    before, after = state.totals[0].reaction, work.residual[driven]
    error = _of_friction(state, evaluation)
    if progress.move != 0.0:
        bend = ((after - before) / move - progress.slope) / (move + progress.move)
        error += abs(bend * move**3) / 6.0
    done = 0.5 * abs((before + after) * move)
    if done > 0.0:
        return error / done
    return np.inf if error > 0.0 else 0.0


@jit_exact
def keep(problem, evaluation, change, progress):
    """Keep the move of an accepted step and the slope of the reaction. change: change of the
    reaction, N.
    """
    driven = problem.scene.coordinates.driven
    progress.move = evaluation.u[driven] if driven >= 0 else 0.0
    progress.slope = change / progress.move if progress.move != 0.0 else 0.0
