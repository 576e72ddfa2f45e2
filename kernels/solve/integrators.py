"""Time integrators: each step of length dt is one of backward Euler, of length h, from a point y.

    v1 = (x1 - y) / h,   M (v1 - w) / h = F(x1, v1),   y = x0 + (dt - h) x',   w = v0 + (dt - h) v'

    backward Euler    h = dt
    BDF2              h = dt (1 + r) / (1 + 2 r), r = dt / last dt;  x', v': last change / last dt
    trapezoidal rule  h = dt / 2 (r infinite);  x' = v0, v' = a0, the balance at x0

The trapezoidal rule is `newmark` in configs. A first step has no rates x', v': it is one of
backward Euler, and its length is `FIRST_SHARE` of dt. Coordinates without mass have no v', and
driven ones have a constant speed: ``heavy`` (n,) is 0 for both, else 1.
"""

from typing import NamedTuple

import numpy as np

from kernels.compile.jit import jit_exact

BACKWARD_EULER, BDF2, TRAPEZOIDAL = range(3)
FIRST_SHARE = 2.0**-4  # share of a step; the energy loss of a first step grows with its square


class Ahead(NamedTuple):
    """Data of y for damping of second order.

    time: dt - h, by which y is ahead of x0, s. last: duration of the last step, s; 0 if ``rate``
    (n,) is the velocity at x0. rate: x'. move (n,): expected x - x0 at the end of the step.
    """

    time: float
    last: float
    rate: np.ndarray
    move: np.ndarray


@jit_exact
def length(scheme, dt, last):
    """Return h of a step of ``dt`` after a step of ``last`` (s); last = 0: a first step."""
    if scheme == BACKWARD_EULER or last == 0.0:
        return dt
    return 0.5 * dt if scheme == TRAPEZOIDAL else dt * (last + dt) / (last + 2.0 * dt)


@jit_exact
def corrections(scheme):
    """Return how often lagged forces are lagged again at the end of a step, which is then repeated.

    With the forces at the start of a step the error is of first order, as in backward Euler; with
    the forces at its first solution it is of second order.
    """
    return 0 if scheme == BACKWARD_EULER else 1


@jit_exact
def _expected(state, i, dt, ahead, heavy):
    """Return the expected move of coordinate ``i`` in ``dt`` at its present rates."""
    if ahead > 0.0 and heavy[i] == 0.0:
        return dt * state.rates.change[i]
    return dt * (state.v[i] + (0.5 * dt * state.rates.velocity[i] if ahead > 0.0 else 0.0))


@jit_exact
def predict(state, dt, h, heavy, y, x_pred, dx):
    """Fill y, x~ = y + h w and the first guess ``dx`` (n,) of the move x - x0."""
    ahead, rates = dt - h, state.rates
    for i in range(y.size):
        y[i] = state.x[i] + ahead * rates.position[i]
        x_pred[i] = y[i] + h * (state.v[i] + ahead * rates.velocity[i])
        dx[i] = _expected(state, i, dt, ahead, heavy)


@jit_exact
def error(state, step, heavy):
    """Return the largest local error of a step in m.

    The estimate is a third of the difference between the end of the step and the expected end; a
    half of it for backward Euler.
    """
    largest, ahead = 0.0, step.duration - step.h
    for i in range(state.x.size):
        if heavy[i] > 0.0:
            expected = _expected(state, i, step.duration, ahead, heavy)
            largest = max(largest, abs(state.x[i] - step.x0[i] - expected))
    return largest / (3.0 if ahead > 0.0 else 2.0)


@jit_exact
def _tie(state, problem):
    """Set velocity and rates of tied coordinates from their leaders.

    No force damps a difference due to round-off, and the schemes amplify it.
    """
    rates = state.rates
    for vector in (state.v, rates.position, rates.velocity, rates.change):
        problem.tie(vector)


@jit_exact
def _acceleration(state, step, i, after):
    """Return the acceleration of coordinate ``i`` at the end of a step of second order; after: its
    velocity there.
    """
    ahead = step.duration - step.h
    return (after - state.v[i] - ahead * state.rates.velocity[i]) / step.h


@jit_exact
def kinetic_loss(scheme, state, step, coordinates, u):
    """Return the integrator's loss of kinetic energy in a step, before `update`, in J.

    That is (theta a1 + (1 - theta) a0) . M (x - x0) less the gain of kinetic energy. u (n,): x - y.
    """
    by_h, theta, loss = 1.0 / step.h, step.theta, 0.0
    for i in range(u.size):
        before, after, mass = state.v[i], by_h * u[i], coordinates.mass[i]
        if scheme == BACKWARD_EULER:
            loss += 0.5 * mass * (after - before) ** 2
            continue
        mean = 0.0
        if coordinates.heavy[i] > 0.0:
            a = _acceleration(state, step, i, after)
            mean = theta * a + (1.0 - theta) * state.rates.change[i]
        move = state.x[i] - step.x0[i]
        loss += mass * (mean * move - 0.5 * (after - before) * (after + before))
    return loss


@jit_exact
def update(scheme, state, step, problem, u):
    """Update v and the rates after a step; replace ``u`` = x - y by x - x0."""
    by_h, rates, v, heavy = 1.0 / step.h, state.rates, state.v, problem.scene.coordinates.heavy
    for i in range(u.size):
        before, after, move = v[i], by_h * u[i], state.x[i] - step.x0[i]
        if scheme == BACKWARD_EULER:
            v[i], u[i] = after, move
            continue
        a = _acceleration(state, step, i, after)
        v[i], u[i] = after, move
        rates.change[i] = a if heavy[i] > 0.0 else move / step.duration
        rates.position[i], rates.velocity[i] = after, heavy[i] * a
        if scheme == BDF2:
            rates.position[i] = move / step.duration
            rates.velocity[i] = heavy[i] * (after - before) / step.duration
    if scheme != BACKWARD_EULER:
        _tie(state, problem)


@jit_exact
def weight(h, duration, dynamic):
    """Return theta, the weight of the forces at the end of a step in the `energy_book`."""
    return 1.0 if dynamic and h == duration else 0.5
