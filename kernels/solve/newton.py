"""Newton's method for one step: a descent to a minimum.

The exact Hessian is used wherever it is positive definite (all pivots positive); elsewhere the
projected one, or the direction of the negative pivot if that promises a greater fall. The step is
cut to its admissible share and backtracked until the energy falls (Armijo); what is evaluated there
serves the next iteration. Converged means: scaled residual and Newton decrement below tolerance
*and* no negative pivot in the exact Hessian, here or not farther than `Coordinates.close` away.
Within that distance a factor is used again.
"""

import numpy as np

from kernels.arrays import copy, dot, zero
from kernels.compile.jit import jit_exact, separate
from kernels.solve.problem import NEGATIVE, NO_ROOM, POSITIVE, TIED
from kernels.solve.residual import allowed, largest

CONVERGED, ITERATIONS, STALLED, INTERRUPTED, SINGULAR, NOT_FINITE, OUTGROWN = range(7)
ARMIJO = 1e-4
HALVINGS = 40
MISLED = 3  # halvings: after more, what lagged forces carry along is forgotten
SLOW = 0.1  # a kept factor that shrinks the residual by less is renewed
LEAST_SHARE = 1e-12  # of a step: less is standing still
RESOLVED = 1e-11  # an energy change below this share of the energy is lost in round-off
DESCENT = np.dtype(
    (
        np.record,  # for attributes in plain Python too
        [
            # how far x may have moved, m, since an exact Hessian was factored without a negative
            # pivot; infinite: no such factor is at hand. Forces may have been lagged anew since.
            ("kept", np.float64),
            ("far", np.float64),  # that a point goes in a move which neighbours must cover, m
            ("iterations", np.int64),  # of the last minimisation
        ],
    )
)


@jit_exact
def _longest(direction, coordinates):
    """Return the largest move in m of a coordinate that is free or tied."""
    most = 0.0
    for i in range(direction.size):
        if coordinates.role[i] >= TIED:
            most = max(most, abs(direction[i]) * coordinates.scale[i])
    return most


@jit_exact
def _solve(problem, found, work, remaining):
    """Point ``work.direction`` to where the quadratic model is stationary; return its slope there.

    A driven coordinate that has ``remaining`` m to go takes the others along.
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
def _aim_off(problem, found, work, pivot):
    """Point ``work.escape`` downhill along the negative pivot, with a move of `Coordinates.leap`.

    Return slope and curvature of the energy along it.
    """
    coordinates = problem.scene.coordinates
    problem.descend(work.escape)
    slope = dot(found.g, work.escape)
    factor = coordinates.leap / _longest(work.escape, coordinates) * (-1.0 if slope > 0.0 else 1.0)
    for i in range(work.escape.size):
        work.escape[i] *= factor
    return slope * factor, pivot * factor * factor


@jit_exact
def _advance(x, work, share):
    """Point ``work.trial`` to a share of dx."""
    for i in range(x.size):
        work.trial[i] = x[i] + share * work.dx[i]


@jit_exact
def _move(x, problem, step, found, work, share, guessed, halvings):
    """Go to the trial, a share of dx; return whether a factor from there may be kept.

    ``guessed``: dx is no step of Newton's, and tells nothing of lagged forces. What they carry
    along is forgotten where it has misled: the step fell far short.
    """
    copy(work.trial, x)
    if halvings > MISLED:
        problem.forget()
        return True
    return guessed or problem.follow(work.dx, share, step, found)


@jit_exact
def _falls(reached, start, share, model, noise):
    """Return whether the energy fell as the quadratic ``model`` (slope, curvature) lets expect."""
    slope, curvature = model
    noise += RESOLVED * abs(start)
    expected = ARMIJO * share * (slope + 0.5 * share * curvature)
    if abs(expected) <= ARMIJO * noise:
        expected = noise
    return reached <= start + expected


@jit_exact
def _capped(dx, most, cap):
    """Shorten ``dx`` so that no coordinate moves farther than ``cap``; return the factor."""
    factor = min(1.0, cap / most) if most > 0.0 else 1.0
    if factor < 1.0:
        for i in range(dx.size):
            dx[i] *= factor
    return factor


@jit_exact
def _arrives(x, dx, target, driven):
    """Return whether the first move leads the driven coordinate all the way."""
    return driven >= 0 and dx[driven] == target - x[driven]


@jit_exact
def _choose(slope, stable, led, escape, coordinates, remaining, work):
    """Fill dx with the Newton direction, or with the escape where that promises more.

    Return the model (slope, curvature) along it and its length in m, cut to the cap.
    """
    fall, curvature = escape
    if led or stable or fall + 0.5 * curvature > 0.5 * slope:
        copy(work.direction, work.dx)
        fall, curvature = slope, 0.0
    else:
        copy(work.escape, work.dx)
    most = _longest(work.dx, coordinates)
    cut = _capped(work.dx, most, max(coordinates.cap, 5.0 * abs(remaining)))
    return (fall * cut, curvature), max(most * cut, abs(remaining)), cut == 1.0


@jit_exact
def _weigh(x, target, problem, tolerance, found, work):
    """Return how far the driven coordinate has to go, m, the largest residual in N, and how much of
    that would count as none.
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
def minimise(x, target, problem, step, tolerance, space, descent, control, there):
    """Descend from ``x`` (n,), in place, to a minimum with the driven coordinate at ``target``.

    Start from ``x`` + ``work.dx`` as far as admissible or, if ``there``, from ``x``, of which
    ``space`` tells; return the outcome, with ``descent`` filled in. OUTGROWN: the
    problem does not know what a move by ``descent.far`` m could bring near, or its matrix has no
    room: renew it. ``control[0]`` != 0 interrupts.
    """
    found, work, coordinates = space.found, space.work, problem.scene.coordinates
    outcome, iteration, halvings = ITERATIONS, 0 if there else -1, 0
    setting_out, searching, arrived, free = not there, not there, there, True
    whole, projected, settled = _arrives(x, work.dx, target, coordinates.driven), False, False
    value, remaining, share, model, escape, fit = 0.0, 0.0, 0.0, (0.0, 0.0), (0.0, 0.0), True
    limit, stable = (0.0, 0.0), True  # what counts as none; of the last exact factor
    most, before, descent.far = _longest(work.dx, coordinates), np.inf, 0.0
    while True:  # each turn evaluates at one point, a trial or the same for another Hessian
        if setting_out:
            descent.far = problem.travel(work.dx)
            if not problem.covers(x, descent.far):
                outcome = OUTGROWN
                break
            share = problem.step_limit(x, work.dx, descent.far)
            if share < LEAST_SHARE:
                outcome = STALLED
                break
            setting_out, searching, halvings = False, True, 0
            _advance(x, work, share)
        if not there:
            problem.evaluate(work.trial, step, found, projected)
        reached, there = found.sums[0].potential, False
        if searching:
            fine = free or _falls(reached, value, share, model, tolerance.noise)
            if not (fine and reached < np.inf):
                halvings, share = halvings + 1, 0.5 * share
                if halvings == HALVINGS or share < LEAST_SHARE:
                    outcome = STALLED if reached < np.inf else NOT_FINITE
                    break
                _advance(x, work, share)
                continue
            fit = _move(x, problem, step, found, work, share, iteration < 0, halvings)
            descent.kept += share * most
            if free and whole and share == 1.0:
                x[coordinates.driven] = target
            iteration, searching, arrived = iteration + 1, False, True
        if arrived:
            value, arrived = reached, False
            remaining, size, limit = _weigh(x, target, problem, tolerance, found, work)
            if control[0] != 0 or not size < np.inf:
                outcome = INTERRUPTED if control[0] != 0 else NOT_FINITE
                break
            settled = remaining == 0.0 and size <= limit[0]
            if not settled and size > SLOW * before:
                descent.kept = np.inf
            before = size
        if descent.kept > coordinates.close:
            met, pivot = problem.factor(x, step, found, projected, False)
            if met == NO_ROOM:
                outcome, descent.kept = OUTGROWN, np.inf
                break
            if projected and met == NEGATIVE:
                outcome = SINGULAR
                break
            if not projected:
                stable = met == POSITIVE
                descent.kept = 0.0 if stable and fit else np.inf
                if not stable:
                    escape = _aim_off(problem, found, work, pivot)
                    projected = not settled
                    if projected:
                        continue
        aimed = stable or projected
        slope = _solve(problem, found, work, remaining) if aimed else 0.0
        if settled and stable and -0.5 * slope <= limit[1]:
            outcome = CONVERGED
            break
        if iteration == tolerance.iterations:
            break
        free, projected = remaining != 0.0, False
        model, most, whole = _choose(slope, stable, free, escape, coordinates, remaining, work)
        setting_out = True
    if outcome == OUTGROWN and iteration >= 0:
        zero(work.dx)
    descent.iterations = max(iteration, 0)
    return outcome
