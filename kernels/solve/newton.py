"""Newton's method with a line search: minimises the potential of one step.

The Hessian H is used where it is positive definite (all pivots positive). Elsewhere H + sigma W
replaces it, W being the square of `Coordinates.scale`. The shift sigma, in N/m, slows soft moves
alone: where a part of a lattice snaps, the rest of it goes on by Newton steps. (A Hessian that is
projected element by element is too stiff everywhere.) It is raised from twice the curvature along
the direction of the first negative pivot until all pivots are positive. At an equilibrium, that
direction itself is the search direction. The line search starts from the admissible share of the
move and backtracks to sufficient decrease (Armijo); predictors and moves that drive the problem are
accepted at any finite energy. Converged means: scaled residual and Newton decrement below tolerance
*and* no negative pivot of the exact Hessian at a point within `Coordinates.close`. A factor is
reused within that distance. A residual above the tolerance is round-off where positions do not
resolve the move that it led to.

Exact means not shifted. Lagged forces have a primal-dual matrix, which is the second derivative
where the duals agree (`Problem.follow`), and `solver.hessian` of configs may leave a part out. In
both cases, a point without a negative pivot need not be a minimum.
"""

from typing import NamedTuple

import numpy as np

from kernels.arrays import copy, dot, zero
from kernels.compile.jit import jit_exact
from kernels.solve.outcomes import (
    CONVERGED,
    INTERRUPTED,
    ITERATIONS,
    NOT_FINITE,
    OUTGROWN,
    SINGULAR,
    STALLED,
    UNFINISHED,
)
from kernels.solve.problem import NEGATIVE, NO_ROOM, POSITIVE, TIED
from kernels.solve.residual import allowed, allowed_decrement, largest_residual

ARMIJO = 1e-4  # share of the predicted decrease that is sufficient
HALVINGS = 40  # greatest number in a line search
DUAL_HALVINGS = 3  # after more halvings the duals of lagged forces are reset
SLOW_REDUCTION = 0.1  # a reused factor is renewed if the ratio of two residuals is larger
LEAST_SHARE = 1e-12  # share of a move: a shorter one is a stall
FIRST_SHIFT = 2.0  # first shift, as a multiple of the negative curvature, which it must exceed
RAISED = 4.0  # ratio of a shift to the previous one, which was too small
RAISES = 32  # greatest number of shifts that are tried
RESOLVED = 1e-11  # relative energy changes below it are round-off
DRIVEN_CAP = 5.0  # least cap of a move, as a multiple of the driven move in it: with a
# smaller cap the driven coordinate would often not arrive
DESCENT = np.dtype(
    (
        np.record,  # fields are attributes in plain Python too
        [
            # Set before a minimisation.
            ("target", np.float64),  # of the driven coordinate, m
            ("evaluated", np.bool_),  # whether `Workspace.evaluation` is of x
            # Over the minimisations of a step.
            # bound of the move, m, since the last factor of an exact Hessian without a negative
            # pivot; infinite: there is no such factor, or it has to be renewed.
            ("since_factor", np.float64),
            ("cut_moves", np.int64),  # of the step, shortened by `Coordinates.cap` or a step limit
            # Of the last minimisation.
            ("iterations", np.int64),  # -1 before the predictor is accepted
            ("travel_bound", np.float64),  # move that the neighbour lists must cover, m
            ("decrement", np.float64),  # of Newton where it converged, J
            # At the present point.
            ("potential", np.float64),  # J
            ("remaining", np.float64),  # move of the driven coordinate to its target, m
            ("residual", np.float64),  # the largest, N; infinite before it is known
            ("balanced", np.bool_),  # whether residual and remaining move are admissible
            ("stable", np.bool_),  # whether the last exact factor has no negative pivot
            ("duals_fit", np.bool_),  # whether the duals of lagged forces allow a factor to be kept
        ],
    )
)


class Move(NamedTuple):
    """The next move, ``work.dx``.

    slope, curvature: the predicted change of energy in a share s of the move is s slope + s^2
    curvature / 2, J; curvature is 0 for a Newton move. longest: of a coordinate, m. arrives: the
    whole move brings the driven coordinate to its target. shortened: by `Coordinates.cap`.
    any_energy: the move is accepted if the energy is finite: it is a predictor, or drives the
    problem.
    """

    slope: float
    curvature: float
    longest: float
    arrives: bool
    shortened: bool
    any_energy: bool


@jit_exact
def _longest(direction, coordinates):
    """Return the largest move of a free or tied coordinate, m."""
    longest = 0.0
    for i in range(direction.size):
        if coordinates.role[i] >= TIED:
            longest = max(longest, abs(direction[i]) * coordinates.scale[i])
    return longest


@jit_exact
def _newton_direction(problem, evaluation, work, remaining):
    """Fill ``work.direction`` with the Newton direction, in which the driven coordinate moves by
    ``remaining`` m; return the slope g . direction in J.
    """
    direction = work.direction
    zero(direction)
    if remaining != 0.0:
        problem.pull(remaining, direction)
    for i in range(direction.size):
        direction[i] = -evaluation.g[i] - direction[i]
    problem.solve(direction)
    if remaining != 0.0:
        problem.lead(remaining, direction)
    return dot(evaluation.g, direction)


@jit_exact
def _escape_direction(problem, evaluation, work, pivot):
    """Make ``work.escape``, of `Problem.descend`, a descent direction, `Coordinates.leap` long.

    ``pivot``: d . H d of `Problem.descend`. Return slope and curvature along the direction, J.
    """
    coordinates = problem.scene.coordinates
    slope = dot(evaluation.g, work.escape)
    factor = coordinates.leap / _longest(work.escape, coordinates) * (-1.0 if slope > 0.0 else 1.0)
    for i in range(work.escape.size):
        work.escape[i] *= factor
    return slope * factor, pivot * factor * factor


@jit_exact
def _decreases(reached, start, share, model, noise):
    """Return whether the decrease from ``start`` to ``reached`` is sufficient (Armijo).

    model: slope and curvature, the predicted change is share slope + share^2 curvature / 2. Changes
    below ``noise`` are round-off.
    """
    slope, curvature = model
    noise += RESOLVED * abs(start)
    expected = ARMIJO * share * (slope + 0.5 * share * curvature)
    if abs(expected) <= ARMIJO * noise:
        expected = noise
    return reached <= start + expected


@jit_exact
def _cap(dx, longest, cap):
    """Scale ``dx`` so that its ``longest`` move is at most ``cap`` (m); return the factor."""
    factor = min(1.0, cap / longest) if longest > 0.0 else 1.0
    if factor < 1.0:
        for i in range(dx.size):
            dx[i] *= factor
    return factor


@jit_exact
def _predictor(x, dx, coordinates, target):
    """Return the `Move` from which a minimisation starts: ``dx``, whatever the energy there."""
    arrives = coordinates.driven >= 0 and dx[coordinates.driven] == target - x[coordinates.driven]
    return Move(0.0, 0.0, _longest(dx, coordinates), arrives, False, True)


@jit_exact
def _choose_move(slope, escape, coordinates, work, descent):
    """Fill dx with the Newton direction or, at an equilibrium that is not stable, with the escape
    direction; cap its length, and return it as a `Move`.

    slope: of the Newton direction. escape: slope and curvature of the other one.
    """
    drives, remaining = descent.remaining != 0.0, abs(descent.remaining)
    fall, curvature = escape
    if descent.stable or not descent.balanced:
        copy(work.direction, work.dx)
        fall, curvature = slope, 0.0
    else:
        copy(work.escape, work.dx)
    longest = _longest(work.dx, coordinates)
    cut = _cap(work.dx, longest, max(coordinates.cap, DRIVEN_CAP * remaining))
    shortened = cut != 1.0
    return Move(
        fall * cut,
        curvature * cut * cut,
        max(longest * cut, remaining),  # `_longest` leaves out the driven coordinate
        drives and not shortened,
        shortened,
        drives,
    )


@jit_exact
def _start_move(x, problem, step, tolerance, work, descent, move):
    """Return an outcome, `UNFINISHED` if the move may begin, and the share of the move to begin
    with.
    """
    descent.travel_bound = problem.travel(work.dx)
    if not problem.covers(x, descent.travel_bound):
        return OUTGROWN, 0.0
    share = problem.step_limit(x, work.dx, descent.travel_bound)
    if share < LEAST_SHARE:
        return STALLED, share
    descent.cut_moves += share < 1.0 or move.shortened
    if step.dynamic and descent.cut_moves > tolerance.cut_moves:
        return ITERATIONS, share
    return UNFINISHED, share


@jit_exact
def _accept(x, problem, step, evaluation, work, descent, move, share, halvings):
    """Copy the trial point, a ``share`` of the move, to ``x``.

    The duals of lagged forces follow a Newton step, but not a predictor. After many halvings they
    are unreliable, and are reset.
    """
    copy(work.trial, x)
    descent.duals_fit = True
    if halvings > DUAL_HALVINGS:
        problem.forget()
    elif descent.iterations >= 0:
        descent.duals_fit = problem.follow(work.dx, share, step, evaluation)
    descent.since_factor += share * move.longest
    if move.arrives and share == 1.0:
        x[problem.scene.coordinates.driven] = descent.target
    descent.iterations += 1


@jit_exact
def _search(x, problem, step, noise, evaluation, work, descent, move, share):
    """Halve the ``share`` of the move until the energy decreases enough, and accept that share.

    Return the outcome, `UNFINISHED` if a share is accepted.
    """
    reached, halvings, model = np.inf, 0, (move.slope, move.curvature)
    while halvings < HALVINGS and share >= LEAST_SHARE:
        for i in range(x.size):
            work.trial[i] = x[i] + share * work.dx[i]
        problem.evaluate(work.trial, step, evaluation)
        reached = evaluation.sums[0].potential
        sufficient = move.any_energy or _decreases(reached, descent.potential, share, model, noise)
        if sufficient and reached < np.inf:
            _accept(x, problem, step, evaluation, work, descent, move, share, halvings)
            return UNFINISHED
        halvings, share = halvings + 1, 0.5 * share
    return STALLED if reached < np.inf else NOT_FINITE


@jit_exact
def _balance(x, problem, tolerance, evaluation, work, descent):
    """Measure the residual at ``x``; if it has fallen too slowly, the factor is to be renewed."""
    coordinates, before = problem.scene.coordinates, descent.residual
    descent.potential = evaluation.sums[0].potential
    problem.reduce(evaluation.g, work.residual)
    descent.residual = largest_residual(work.residual, coordinates)
    descent.remaining = 0.0
    if coordinates.driven >= 0:
        descent.remaining = descent.target - x[coordinates.driven]
    limit = allowed(problem.stiffest(), tolerance)
    descent.balanced = descent.remaining == 0.0 and descent.residual <= limit
    if not descent.balanced and descent.residual > SLOW_REDUCTION * before:
        descent.since_factor = np.inf


@jit_exact
def _factor_shifted(x, problem, step, evaluation, work, pivot):
    """Factor H + sigma W; return the result of `Problem.factor`.

    ``pivot``: d . H d, d = ``work.escape``, which bounds the least sigma.
    """
    size, scale = 0.0, problem.scene.coordinates.scale
    for i in range(scale.size):
        size += (scale[i] * work.escape[i]) ** 2
    shift = -FIRST_SHIFT * pivot / size
    for _ in range(RAISES):
        result, _ = problem.factor(x, step, evaluation, shift, False)
        if result != NEGATIVE:
            return result
        shift *= RAISED
    return NEGATIVE


@jit_exact
def _renew_factor(x, problem, step, tolerance, evaluation, work, descent):
    """Factor the Hessian and, if it has a negative pivot away from an equilibrium, a shifted one.

    Return the outcome, `UNFINISHED` if the factor can be used; and slope and curvature along
    ``work.escape``, J, both 0 but at an equilibrium with a negative pivot.
    """
    escape = (0.0, 0.0)
    result, pivot = problem.factor(x, step, evaluation, 0.0, False)
    if result != NO_ROOM:
        limit = allowed(problem.stiffest(), tolerance)
        descent.balanced = descent.balanced and descent.residual <= limit
        descent.stable = result == POSITIVE
        descent.since_factor = 0.0 if descent.stable and descent.duals_fit else np.inf
        if descent.stable:
            return UNFINISHED, escape
        problem.descend(work.escape)
        if descent.balanced:
            return UNFINISHED, _escape_direction(problem, evaluation, work, pivot)
        result = _factor_shifted(x, problem, step, evaluation, work, pivot)
    if result == NO_ROOM:
        descent.since_factor = np.inf
        return OUTGROWN, escape
    return (SINGULAR if result == NEGATIVE else UNFINISHED), escape


@jit_exact
def _is_settled(step, move, tolerance, descent):
    """Return whether the residual is admissible, or the last move was too short for positions to
    resolve: the remaining residual is then round-off, though larger than for the stiffest
    coordinate.

    The predictor of a motion is not accepted: forces that slow the motion, such as damping, may be
    below the admissible residual for thousands of steps, and would be booked without having acted.
    """
    if descent.iterations == 0:
        return descent.balanced and (not step.dynamic or descent.residual == 0.0)
    unresolved = descent.remaining == 0.0 and move.longest <= tolerance.resolution
    return descent.balanced or unresolved


@jit_exact
def _descend(x, problem, step, tolerance, workspace, descent, control):
    """Iterate as described in `minimise`; return the outcome."""
    evaluation, work, coordinates = workspace.evaluation, workspace.work, problem.scene.coordinates
    move, escape = _predictor(x, work.dx, coordinates, descent.target), (0.0, 0.0)
    while True:
        if not descent.evaluated:
            outcome, share = _start_move(x, problem, step, tolerance, work, descent, move)
            if outcome == UNFINISHED:
                outcome = _search(
                    x, problem, step, tolerance.noise, evaluation, work, descent, move, share
                )
            if outcome != UNFINISHED:
                return outcome
        descent.evaluated = False
        _balance(x, problem, tolerance, evaluation, work, descent)
        if control[0] != 0:
            return INTERRUPTED
        if not descent.residual < np.inf:
            return NOT_FINITE
        if descent.since_factor > coordinates.close:
            outcome, escape = _renew_factor(x, problem, step, tolerance, evaluation, work, descent)
            if outcome != UNFINISHED:
                return outcome
        slope = 0.0
        if descent.stable or not descent.balanced:
            slope = _newton_direction(problem, evaluation, work, descent.remaining)
        if descent.stable and _is_settled(step, move, tolerance, descent):
            descent.decrement = -0.5 * slope
            if descent.decrement <= allowed_decrement(problem.stiffest(), tolerance, x.size):
                return CONVERGED
        if descent.iterations == tolerance.iterations:
            return ITERATIONS
        move = _choose_move(slope, escape, coordinates, work, descent)


@jit_exact
def minimise(x, problem, step, tolerance, workspace, descent, control):
    """Minimise over ``x`` (n,), in place, with the driven coordinate at ``descent.target``.

    Start from the admissible share of ``x`` + ``work.dx`` or, if ``descent.evaluated``, from ``x``,
    at which ``workspace.evaluation`` is up to date. Return the outcome and fill ``descent``.
    OUTGROWN: the neighbour lists do not cover a move of ``descent.travel_bound`` m, or the matrix
    lacks an entry: renew them and call again. control[0] != 0 interrupts.
    """
    descent.iterations = 0 if descent.evaluated else -1
    descent.residual, descent.travel_bound = np.inf, 0.0
    descent.stable, descent.duals_fit = True, True
    outcome = _descend(x, problem, step, tolerance, workspace, descent, control)
    if outcome == OUTGROWN and descent.iterations >= 0:
        zero(workspace.work.dx)
    descent.iterations = max(descent.iterations, 0)
    return outcome
