"""Newton's method for one step: a descent to a minimum.

The exact Hessian is used wherever it is positive definite (all pivots positive); elsewhere the
projected one, or the direction of the negative pivot if that promises a greater fall. The step is
cut to its admissible share and backtracked until the energy falls (Armijo); what is evaluated there
serves the next iteration. Converged means: scaled residual and Newton decrement below tolerance
*and* no negative pivot in the exact Hessian, here or not farther than `Unknowns.close` away. Within
that distance a factor is used again.
"""

from typing import NamedTuple

import numpy as np

from kernels.terms import elements as chain, friction
from kernels.linear import periodic_images as image, system
from kernels.solve.residual import allowed, largest, reduce
from kernels.compile.jit import jit_exact, separate
from kernels.arrays import copy, dot, zero, zero_rows
from kernels.planar.potential import WHOLE, covers, evaluate, factor, step_limit, travel

CONVERGED, ITERATIONS, STALLED, INTERRUPTED, SINGULAR, NOT_FINITE, OUTGROWN = range(7)
ARMIJO = 1e-4
HALVINGS = 40
MISLED = 3  # halvings: after more, the duals of friction are forgotten
SLOW = 0.1  # a kept factor that shrinks the residual by less is renewed
LEAST_SHARE = 1e-12  # of a step: less is standing still
RESOLVED = 1e-11  # an energy change below this share of the energy is lost in round-off


class Work(NamedTuple):
    """Scratch arrays by coordinate; kept (1,): how far x may have moved, m, since an exact Hessian
    was factored without a negative pivot (infinite: no such factor is at hand); friction may have
    been lagged anew since then.
    """

    dx: np.ndarray
    trial: np.ndarray
    residual: np.ndarray
    direction: np.ndarray
    escape: np.ndarray
    kept: np.ndarray


@jit_exact
def _longest(direction, unknowns):
    """Return the largest move in m of a coordinate that is not led."""
    most = 0.0
    for i in range(direction.size):
        if unknowns.leader[i] >= 0 and unknowns.leader[i] != unknowns.driven:
            most = max(most, abs(direction[i]) * unknowns.scale[i])
    return most


@jit_exact
def _lead(direction, unknowns, remaining):
    """Write the moves of all that is led when the driven coordinate goes ``remaining`` m."""
    for i in range(direction.size):
        if unknowns.leader[i] == unknowns.driven:
            direction[i] = unknowns.ratio[i] * remaining
    image.spread(unknowns.images, direction)


@jit_exact
def _solve(terms, near, unknowns, at, work, remaining):
    """Point ``work.direction`` to where the quadratic model is stationary; return its slope there.

    A driven coordinate that has ``remaining`` m to go takes the others along.
    """
    direction, matrix = work.direction, near.system.matrix
    if remaining != 0.0:
        zero(direction)
        _lead(direction, unknowns, remaining)
        zero_rows(at.shape.slope)
        zero(at.shape.moment)
        chain.product(terms.walls, at.stiffness, direction, at.shape)
        zero(direction)
        chain.gather(terms.walls, at.shape, direction)
        for i in range(direction.size):
            direction[i] += matrix.pull[i] * remaining
    else:
        zero(direction)
    for i in range(direction.size):
        direction[i] = -at.g[i] - direction[i]
    system.solve(near.system, terms.layout, direction)
    if remaining != 0.0:
        _lead(direction, unknowns, remaining)
    return dot(at.g, direction)


@jit_exact
def _aim_off(terms, near, unknowns, at, work, place):
    """Point ``work.escape`` downhill along the negative pivot, with a move of ``unknowns.leap``.

    Return slope and curvature of the energy along it.
    """
    wall, failed, pivot = place
    system.descend(near.system, terms.layout, wall, failed, work.escape)
    slope = dot(at.g, work.escape)
    factor = unknowns.leap / _longest(work.escape, unknowns) * (-1.0 if slope > 0.0 else 1.0)
    for i in range(work.escape.size):
        work.escape[i] *= factor
    return slope * factor, pivot * factor * factor


@jit_exact
def _advance(x, work, share):
    """Point ``work.trial`` to a share of dx."""
    for i in range(x.size):
        work.trial[i] = x[i] + share * work.dx[i]


@jit_exact
def _move(x, step, at, work, share, most, guessed, halvings):
    """Go to the trial, a share of dx, which is ``most`` m long; return whether a factor from there
    may be kept. ``guessed``: dx is no step of Newton's, and tells nothing of friction.

    The duals of friction are forgotten where they have misled: the step fell far short.
    """
    copy(work.trial, x)
    work.kept[0] += share * most
    if halvings > MISLED:
        friction.forget(step.grips)
        return True
    return guessed or friction.follow(at.u, work.dx, share, step.grips, step.slip)


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
def _choose(slope, stable, led, escape, unknowns, remaining, work):
    """Fill dx with the Newton direction, or with the escape where that promises more.

    Return the model (slope, curvature) along it and its length in m, cut to the cap.
    """
    fall, curvature = escape
    if led or stable or fall + 0.5 * curvature > 0.5 * slope:
        copy(work.direction, work.dx)
        fall, curvature = slope, 0.0
    else:
        copy(work.escape, work.dx)
    most = _longest(work.dx, unknowns)
    cut = _capped(work.dx, most, max(unknowns.cap, 5.0 * abs(remaining)))
    return (fall * cut, curvature), max(most * cut, abs(remaining)), cut == 1.0


@jit_exact
def _weigh(x, target, near, unknowns, tolerance, at, work):
    """Return how far the driven coordinate has to go, m, the largest residual in N, and how much of
    that would count as none.
    """
    reduce(at.g, unknowns, work.residual)
    remaining = target - x[unknowns.driven] if unknowns.driven >= 0 else 0.0
    size = largest(work.residual, unknowns)
    return remaining, size, allowed(near.system.matrix, tolerance)


@separate
@jit_exact
def minimise(x, target, terms, step, near, unknowns, tolerance, at, work, control, there):
    """Descend from ``x`` (n,), in place, to a minimum with the driven coordinate at ``target``.

    Start from ``x`` + ``work.dx`` as far as admissible or, if ``there``, from ``x``, of which at
    and work.trial tell; return (outcome, iterations, far). OUTGROWN: ``near`` lacks what a move by
    ``far`` m could bring near, or room in its matrix: renew it. ``control[0]`` != 0 interrupts.
    """
    outcome, iteration, halvings, kept = ITERATIONS, 0 if there else -1, 0, work.kept
    setting_out, searching, arrived, free = not there, not there, there, True
    whole, projected, settled = _arrives(x, work.dx, target, unknowns.driven), False, False
    value, remaining, share, model, escape, fit = 0.0, 0.0, 0.0, (0.0, 0.0), (0.0, 0.0), True
    limit, place = (0.0, 0.0), (-1, -1, 0.0)  # what counts as none; first negative exact pivot
    most, far, before = _longest(work.dx, unknowns), 0.0, np.inf
    while True:  # each turn evaluates at one point, a trial or the same for another Hessian
        if setting_out:
            far = travel(work.dx, terms)
            if not covers(near, x, terms, far):
                outcome = OUTGROWN
                break
            share = step_limit(x, work.dx, far, terms, near, at)
            if share < LEAST_SHARE:
                outcome = STALLED
                break
            setting_out, searching, halvings = False, True, 0
            _advance(x, work, share)
        if not there:
            evaluate(work.trial, terms, step, near, at, projected)
        reached, there = at.sum[WHOLE], False
        if searching:
            fine = free or _falls(reached, value, share, model, tolerance.noise)
            if not (fine and reached < np.inf):
                halvings, share = halvings + 1, 0.5 * share
                if halvings == HALVINGS or share < LEAST_SHARE:
                    outcome = STALLED if reached < np.inf else NOT_FINITE
                    break
                _advance(x, work, share)
                continue
            fit = _move(x, step, at, work, share, most, iteration < 0, halvings)
            if free and whole and share == 1.0:
                x[unknowns.driven] = target
            iteration, searching, arrived = iteration + 1, False, True
        if arrived:
            value, arrived = reached, False
            remaining, size, limit = _weigh(x, target, near, unknowns, tolerance, at, work)
            if control[0] != 0 or not size < np.inf:
                outcome = INTERRUPTED if control[0] != 0 else NOT_FINITE
                break
            settled = remaining == 0.0 and size <= limit[0]
            if not settled and size > SLOW * before:
                kept[0] = np.inf
            before = size
        if kept[0] > unknowns.close:
            found = factor(x, terms, step, near, at, projected, False)
            if near.system.matrix.missing[0] != 0:
                outcome, kept[0] = OUTGROWN, np.inf
                break
            if projected and found[1] >= 0:
                outcome = SINGULAR
                break
            if not projected:
                place = found
                kept[0] = 0.0 if found[1] < 0 and fit else np.inf
                if place[1] >= 0:
                    escape = _aim_off(terms, near, unknowns, at, work, place)
                    projected = not settled
                    if projected:
                        continue
        stable, aimed = place[1] < 0, place[1] < 0 or projected
        slope = _solve(terms, near, unknowns, at, work, remaining) if aimed else 0.0
        if settled and stable and -0.5 * slope <= limit[1]:
            outcome = CONVERGED
            break
        if iteration == tolerance.iterations:
            break
        free, projected = remaining != 0.0, False
        model, most, whole = _choose(slope, stable, free, escape, unknowns, remaining, work)
        setting_out = True
    if outcome == OUTGROWN and iteration >= 0:
        zero(work.dx)
    return outcome, max(iteration, 0), far
