"""Newton's method with a line search: minimises the potential of one step.

The exact Hessian is used where it is positive definite (all pivots positive). Elsewhere the search
direction is that of the projected Hessian, or the direction of negative curvature of the first
negative pivot, whichever has the larger predicted decrease. The line search starts from the
admissible share of the move and backtracks to sufficient decrease (Armijo). Converged means: scaled
residual and Newton decrement below tolerance *and* no negative pivot of the exact Hessian at a
point within `Coordinates.close`. A factor is reused within that distance.
"""

import numpy as np

from kernels.arrays import copy, dot, zero
from kernels.compile.jit import jit_exact, separate
from kernels.solve.outcomes import (
    CONVERGED,
    INTERRUPTED,
    ITERATIONS,
    NOT_FINITE,
    OUTGROWN,
    SINGULAR,
    STALLED,
)
from kernels.solve.problem import NEGATIVE, NO_ROOM, POSITIVE, TIED
from kernels.solve.residual import allowed, allowed_decrement, largest

ARMIJO = 1e-4  # share of the predicted decrease that is sufficient
HALVINGS = 40  # of a line search, at most
DUAL_HALVINGS = 3  # after more halvings the duals of lagged forces are reset
SLOW_REDUCTION = 0.1  # a reused factor is renewed if the ratio of two residuals is larger
LEAST_SHARE = 1e-12  # of a move: a shorter one is a stall
RESOLVED = 1e-11  # relative energy changes below it are round-off
MOST_CUT_MOVES = 20  # of a dynamic step: more do not pay, as a shorter step is easier
DESCENT = np.dtype(
    (
        np.record,  # for attributes in plain Python too
        [
            # bound of the move, m, since the last factor of an exact Hessian without a negative
            # pivot; infinite: there is none. Lagged forces may have changed since.
            ("since_factor", np.float64),
            ("travel_bound", np.float64),  # move that the neighbour lists must cover, m
            ("iterations", np.int64),  # of the last minimisation
            ("decrement", np.float64),  # of Newton where it converged, J
            ("cut_moves", np.int64),  # of the step, shortened by `Coordinates.cap` or a step limit
        ],
    )
)


@jit_exact
def _longest(direction, coordinates):
    """Return the largest move of a free or tied coordinate, m."""
    longest = 0.0
    for i in range(direction.size):
        if coordinates.role[i] >= TIED:
            longest = max(longest, abs(direction[i]) * coordinates.scale[i])
    return longest


@jit_exact
def _newton_direction(problem, found, work, remaining):
    """Fill ``work.direction`` with the Newton direction; return the slope g . direction in J.

    The driven coordinate moves by ``remaining`` m in it.
    """
    direction = work.direction
    zero(direction)
    if remaining != 0.0:
        problem.pull(remaining, direction)
    for i in range(direction.size):
        direction[i] = -found.g[i] - direction[i]
    problem.solve(direction)
    if remaining != 0.0:
        problem.lead(remaining, direction)
    return dot(found.g, direction)


@jit_exact
def _escape_direction(problem, found, work, pivot):
    """Fill ``work.escape`` with a descent direction of negative curvature, `Coordinates.leap` long.

    ``pivot``: d . H d of `Problem.descend`. Return slope and curvature along the direction, J.
    """
    coordinates = problem.scene.coordinates
    problem.descend(work.escape)
    slope = dot(found.g, work.escape)
    factor = coordinates.leap / _longest(work.escape, coordinates) * (-1.0 if slope > 0.0 else 1.0)
    for i in range(work.escape.size):
        work.escape[i] *= factor
    return slope * factor, pivot * factor * factor


@jit_exact
def _set_trial(x, work, share):
    """Fill ``work.trial`` with x + share dx."""
    for i in range(x.size):
        work.trial[i] = x[i] + share * work.dx[i]


@jit_exact
def _accept_trial(x, problem, step, found, work, share, predicted, halvings):
    """Copy the trial point, a ``share`` of dx, to ``x``; return whether its factor may be reused.

    predicted: dx is a predictor instead of a Newton step, so that the duals of lagged forces are
    not updated. After many halvings the duals are unreliable, and are reset.
    """
    copy(work.trial, x)
    if halvings > DUAL_HALVINGS:
        problem.forget()
        return True
    return predicted or problem.follow(work.dx, share, step, found)


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
def _reaches_target(x, dx, target, driven):
    """Return whether ``dx`` moves the driven coordinate exactly to its target."""
    return driven >= 0 and dx[driven] == target - x[driven]


@jit_exact
def _choose_move(slope, stable, to_target, escape, coordinates, remaining, work):
    """Fill dx with the Newton direction, or with the escape direction if its predicted decrease is
    larger; cap its length.

    Return the model (slope, curvature) along dx, its longest move in m, and whether it is uncapped.
    to_target: the driven coordinate is not at its target yet.
    """
    fall, curvature = escape
    if to_target or stable or fall + 0.5 * curvature > 0.5 * slope:
        copy(work.direction, work.dx)
        fall, curvature = slope, 0.0
    else:
        copy(work.escape, work.dx)
    longest = _longest(work.dx, coordinates)
    cut = _cap(work.dx, longest, max(coordinates.cap, 5.0 * abs(remaining)))
    return (fall * cut, curvature * cut * cut), max(longest * cut, abs(remaining)), cut == 1.0


@jit_exact
def _residual(x, target, problem, tolerance, found, work):
    """Return the remaining move of the driven coordinate in m, the largest residual in N, and the
    admissible residual (`residual.allowed`).
    """
    coordinates = problem.scene.coordinates
    problem.reduce(found.g, work.residual)
    remaining = target - x[coordinates.driven] if coordinates.driven >= 0 else 0.0
    return (
        remaining,
        largest(work.residual, coordinates),
        allowed(problem.stiffest(), tolerance),
    )


@separate
@jit_exact
def minimise(x, target, problem, step, tolerance, workspace, descent, control, evaluated):
    """Minimise over ``x`` (n,), in place, with the driven coordinate at ``target`` (m).

    Start from the admissible share of ``x`` + ``work.dx`` or, if ``evaluated``, from ``x``, whose
    evaluation is in ``workspace.found``. Return the outcome and fill ``descent``. OUTGROWN: the
    neighbour lists do not cover a move of ``descent.travel_bound`` m, or the matrix lacks an entry:
    renew them and call again. control[0] != 0 interrupts.
    """
    found, work, coordinates = workspace.found, workspace.work, problem.scene.coordinates
    outcome, iteration, halvings = ITERATIONS, 0 if evaluated else -1, 0
    new_direction, line_search, accepted, accept_any = not evaluated, not evaluated, evaluated, True
    shortened, uncapped = False, _reaches_target(x, work.dx, target, coordinates.driven)
    projected, balanced = False, False
    value, remaining, share, size, duals_fit = 0.0, 0.0, 0.0, 0.0, True
    model, escape = (0.0, 0.0), (0.0, 0.0)
    limit, stable = 0.0, True  # stable: of the last exact factor
    longest, previous_size, descent.travel_bound = _longest(work.dx, coordinates), np.inf, 0.0
    while True:  # each turn evaluates a trial point, or the same point for the projected Hessian
        if new_direction:
            descent.travel_bound = problem.travel(work.dx)
            if not problem.covers(x, descent.travel_bound):
                outcome = OUTGROWN
                break
            share = problem.step_limit(x, work.dx, descent.travel_bound)
            if share < LEAST_SHARE:
                outcome = STALLED
                break
            descent.cut_moves += share < 1.0 or shortened
            if step.dynamic and descent.cut_moves > MOST_CUT_MOVES:
                break
            new_direction, line_search, halvings = False, True, 0
            _set_trial(x, work, share)
        if not evaluated:
            problem.evaluate(work.trial, step, found, projected)
        reached, evaluated = found.sums[0].potential, False
        if line_search:
            sufficient = accept_any or _decreases(reached, value, share, model, tolerance.noise)
            if not (sufficient and reached < np.inf):
                halvings, share = halvings + 1, 0.5 * share
                if halvings == HALVINGS or share < LEAST_SHARE:
                    outcome = STALLED if reached < np.inf else NOT_FINITE
                    break
                _set_trial(x, work, share)
                continue
            duals_fit = _accept_trial(x, problem, step, found, work, share, iteration < 0, halvings)
            descent.since_factor += share * longest
            if accept_any and uncapped and share == 1.0:
                x[coordinates.driven] = target
            iteration, line_search, accepted = iteration + 1, False, True
        if accepted:
            value, accepted = reached, False
            remaining, size, limit = _residual(x, target, problem, tolerance, found, work)
            if control[0] != 0 or not size < np.inf:
                outcome = INTERRUPTED if control[0] != 0 else NOT_FINITE
                break
            balanced = remaining == 0.0 and size <= limit
            if not balanced and size > SLOW_REDUCTION * previous_size:
                descent.since_factor = np.inf
            previous_size = size
        if descent.since_factor > coordinates.close:
            met, pivot = problem.factor(x, step, found, projected, False)
            if met == NO_ROOM:
                outcome, descent.since_factor = OUTGROWN, np.inf
                break
            if projected and met == NEGATIVE:
                outcome = SINGULAR
                break
            if not projected:
                limit = allowed(problem.stiffest(), tolerance)
                balanced, stable = balanced and size <= limit, met == POSITIVE
                descent.since_factor = 0.0 if stable and duals_fit else np.inf
                if not stable:
                    escape = _escape_direction(problem, found, work, pivot)
                    projected = not balanced
                    if projected:
                        continue
        has_direction = stable or projected
        slope = _newton_direction(problem, found, work, remaining) if has_direction else 0.0
        if balanced and stable:
            descent.decrement = -0.5 * slope
            if descent.decrement <= allowed_decrement(problem.stiffest(), tolerance, x.size):
                outcome = CONVERGED
                break
        if iteration == tolerance.iterations:
            break
        accept_any, projected = remaining != 0.0, False
        model, longest, uncapped = _choose_move(
            slope, stable, accept_any, escape, coordinates, remaining, work
        )
        shortened, new_direction = not uncapped, True
    if outcome == OUTGROWN and iteration >= 0:
        zero(work.dx)
    descent.iterations = max(iteration, 0)
    return outcome
