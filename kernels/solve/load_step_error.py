"""Error of a static step of a driven coordinate, in the work of that step.

With F the reaction at the driven coordinate, d its move in the step, and d0 in the previous step:

    work = (F0 + F1) d / 2
    error = |F''| d^3 / 12  +  |(r1 - r0) . u| / 2  +  4 sum |(a1' - a0') a1'| d^2

The first part is the error of the trapezoidal rule, with the second derivative F'' of the quadratic
through the last three reactions, 2 (s1 - s0) / (d + d0) with slopes s = dF / d. The second part
bounds the error of friction, whose normal forces are estimated before the step (`march`): its
forces r are off by no more than their change in a step, in which the coordinates move by u.

The third part is the error of walls that relax, whose stress is exact if strains change evenly in a
step (`laws.relaxation`). Where walls begin to buckle they do not, and in a step that is too long
they buckle too early, against the stiffness of a wall that has relaxed meanwhile. A stored energy
U = a^2 belongs to a shape of amplitude a. With a' the change of a in a step / d:

    error of the amplitude        e = |a1' - a0'| d / 2, as in backward Euler
    change of its force 2 a       f = 2 |a1'| d
    error of the energy           e f = |(a1' - a0') a1'| d^2

It grows with the shape, and so counts fourfold (`WEIGHT`): with less, some re-entrant cells and
diamonds take other folds (docs/accuracy.md).
"""

import math

from kernels.compile.jit import jit_exact

WEIGHT = 4.0  # of the error of walls that relax
LEAST = 0.1  # reaction / the largest one so far, below which work is too little to compare with


@jit_exact
def _of_friction(state, evaluation):
    """Return |(r1 - r0) . u| / 2 in J, with the gradients r of friction after two steps."""
    before, work = state.gradients.friction, 0.0
    for i in range(evaluation.u.size):
        work += (evaluation.friction[i] - before[i]) * evaluation.u[i]
    return 0.5 * abs(work)


@jit_exact
def _amplitude_change(state, evaluation, k):
    """Return the change of the amplitude of stored energy ``k`` in a step, J^0.5."""
    return math.sqrt(max(evaluation.stored[k], 0.0)) - math.sqrt(max(state.stored[k], 0.0))


@jit_exact
def measure_amplitude_rates(state, evaluation, move, amplitude_rate):
    """Fill ``amplitude_rate`` (k,) with a' of each stored energy in a step, J^0.5 / m."""
    for k in range(amplitude_rate.size):
        amplitude_rate[k] = _amplitude_change(state, evaluation, k) / move


@jit_exact
def of_relaxation(state, evaluation, move, amplitude_rate):
    """Return sum |(a1' - a0') a1'| d^2 in J. amplitude_rate (k,): a0' of each stored energy."""
    error = 0.0
    for k in range(amplitude_rate.size):
        change = _amplitude_change(state, evaluation, k)
        error += abs((change - amplitude_rate[k] * move) * change)
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
def relative_error(problem, stage, state, evaluation, work, progress, amplitude_rate):
    """Return the error of the work in a step as a share of that work, 0 where nothing is driven.

    The reaction counts as no less than `LEAST` of the largest one so far. Else the error would be
    compared with next to no work where a platen is lifted from walls that recover slowly.

    evaluation: at the end of the step, before `Problem.commit`. progress, amplitude_rate: see
    `keep`.
    """
    move, after = _driven(problem, evaluation, work)
    if move == 0.0:
        return 0.0
    before, error = state.totals[0].reaction, _of_friction(state, evaluation)
    if progress.move != 0.0:
        slope = (after - before) / move
        second_derivative = 2.0 * (slope - progress.slope) / (move + progress.move)
        error += abs(second_derivative * move**3) / 12.0
        if stage.relaxes:
            error += WEIGHT * of_relaxation(state, evaluation, move, amplitude_rate)
    least = LEAST * state.totals[0].largest_reaction
    step_work = max(0.5 * abs(before + after), least) * abs(move)
    if step_work > 0.0:
        return error / step_work
    return math.inf if error > 0.0 else 0.0


@jit_exact
def keep(problem, state, evaluation, work, progress, amplitude_rate):
    """Keep the move of a step that is accepted and the slope of its reaction in ``progress``, and
    a' of each stored energy in ``amplitude_rate`` (k,), J^0.5 / m. Before `Problem.commit`.
    """
    move, after = _driven(problem, evaluation, work)
    progress.move, progress.slope = move, 0.0
    if move != 0.0:
        progress.slope = (after - state.totals[0].reaction) / move
        measure_amplitude_rates(state, evaluation, move, amplitude_rate)
