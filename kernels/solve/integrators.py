"""Integrators in time: each step is one of backward Euler, of length h, from a place dt - h ahead.

    v1 = (x1 - y) / h,   M (v1 - w) / h = F(x1, v1),   y = x0 + (dt - h) x',   w = v0 + (dt - h) v'

    backward Euler    h = dt
    BDF2              h = dt (1 + r) / (1 + 2 r), r = dt / last dt;  x', v': last change / last dt
    trapezoidal rule  h = dt / 2 (r infinite);  x' = v0, v' = a0, the balance at x0

What changes at once has no x', v' to go by: a first step, of backward Euler, is `FIRST` of the
others. What has no mass has no v' either, what is led has a constant speed: ``heavy`` (n,) is 0
there, else 1.
"""

from typing import NamedTuple

import numpy as np

from kernels.compile.jit import jit_exact

BACKWARD_EULER, BDF2, TRAPEZOIDAL = range(3)
FIRST = 2.0**-4  # share of a step: its loss of energy, of first order, is the square of that


class Ahead(NamedTuple):
    """Where the rates of a step are measured, for damping that is of second order.

    time: how far y is ahead of x0, s. last: duration of the last step, s, 0 if ``rate`` (n,) is the
    velocity at x0. move (n,): where the step is expected to end.
    """

    time: float
    last: float
    rate: np.ndarray
    move: np.ndarray


@jit_exact
def length(scheme, dt, last):
    """Return h of a step of ``dt`` after one of ``last``, 0 where it starts anew."""
    if scheme == BACKWARD_EULER or last == 0.0:
        return dt
    return 0.5 * dt if scheme == TRAPEZOIDAL else dt * (last + dt) / (last + 2.0 * dt)


@jit_exact
def _expected(state, i, dt, ahead, heavy):
    """Return how far coordinate ``i`` goes in ``dt`` at its rates."""
    if ahead > 0.0 and heavy[i] == 0.0:
        return dt * state.rates.change[i]
    return dt * (state.v[i] + (0.5 * dt * state.rates.velocity[i] if ahead > 0.0 else 0.0))


@jit_exact
def set_out(state, dt, h, heavy, y, x_pred, dx):
    """Fill y, x~ = y + h w and the move (n,) to begin with."""
    ahead, rates = dt - h, state.rates
    for i in range(y.size):
        y[i] = state.x[i] + ahead * rates.position[i]
        x_pred[i] = y[i] + h * (state.v[i] + ahead * rates.velocity[i])
        dx[i] = _expected(state, i, dt, ahead, heavy)


@jit_exact
def error(state, step, heavy):
    """Return the largest error in m that a step has made by itself: a third of what its end has
    been off the move to begin with; a half, of a first step.
    """
    most, ahead = 0.0, step.duration - step.h
    for i in range(state.x.size):
        if heavy[i] > 0.0:
            expected = _expected(state, i, step.duration, ahead, heavy)
            most = max(most, abs(state.x[i] - step.x0[i] - expected))
    return most / (3.0 if ahead > 0.0 else 2.0)


@jit_exact
def _tie(state, problem):
    """Let what follows another coordinate have its velocity and rates to the last digit.

    No force would damp a difference, which the schemes let grow.
    """
    rates = state.rates
    for vector in (state.v, rates.position, rates.velocity, rates.change):
        problem.tie(vector)


@jit_exact
def arrive(scheme, state, step, problem, u):
    """Exchange ``u`` = x - y for x - x0, renew v and the rates; return what inertia lost, in J:

    theta a1 + (1 - theta) a0 times M (x - x0), less the gain of kinetic energy.
    """
    by_h, ahead, theta, lost = 1.0 / step.h, step.duration - step.h, step.theta, 0.0
    rates, v, x0 = state.rates, state.v, step.x0
    mass, heavy = problem.scene.coordinates.mass, problem.scene.coordinates.heavy
    for i in range(u.size):
        before, after = v[i], by_h * u[i]
        v[i], u[i] = after, state.x[i] - x0[i]
        if scheme == BACKWARD_EULER:
            lost += 0.5 * mass[i] * (after - before) ** 2
            continue
        a = by_h * (after - before - ahead * rates.velocity[i])
        mean = theta * a + (1.0 - theta) * rates.change[i] if heavy[i] > 0.0 else 0.0
        lost += mass[i] * (mean * u[i] - 0.5 * (after - before) * (after + before))
        rates.change[i] = a if heavy[i] > 0.0 else u[i] / step.duration
        rates.position[i], rates.velocity[i] = after, heavy[i] * a
        if scheme == BDF2:
            rates.position[i] = u[i] / step.duration
            rates.velocity[i] = heavy[i] * (after - before) / step.duration
    if scheme != BACKWARD_EULER:
        _tie(state, problem)
    return lost


@jit_exact
def weight(h, duration, dynamic):
    """Return theta, the share of the forces at the end of a step in its `energy_book`."""
    return 1.0 if dynamic and h == duration else 0.5
