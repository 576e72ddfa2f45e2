"""Integrators in time: each step is one of backward Euler, of length h, from a place dt - h ahead.

    v1 = (x1 - y) / h,   M (v1 - w) / h = F(x1, v1),   y = x0 + (dt - h) x',   w = v0 + (dt - h) v'

    backward Euler    h = dt
    BDF2              h = dt (1 + r) / (1 + 2 r), r = dt / last dt;  x', v': last change / last dt
    trapezoidal rule  h = dt / 2 (r infinite);  x' = v0, v' = a0, the balance at x0

What changes at once has no x', v' to go by: a first step, of backward Euler, is `FIRST` of the
others. v' is zero for what has no mass (its rate is no acceleration) and for what is led (at a
constant speed).
"""

import numpy as np

from kernels.jit import jit_exact

BACKWARD_EULER, BDF2, TRAPEZOIDAL = range(3)
FIRST = 2.0**-4  # share of a step: its loss of energy, of first order, is the square of that
POSITION, VELOCITY = range(2)  # rates
ELASTIC, DAMPING, RUBBING, INERTIA = range(4)  # gradients at the end of the last step


@jit_exact
def length(scheme, dt, last):
    """Return h of a step of ``dt`` after one of ``last``, 0 where it starts anew."""
    if scheme == BACKWARD_EULER or last == 0.0 or dt == np.inf:
        return dt
    return 0.5 * dt if scheme == TRAPEZOIDAL else dt * (last + dt) / (last + 2.0 * dt)


@jit_exact
def _expected(state, i, dt, ahead):
    """Return how far coordinate ``i`` goes in ``dt`` at its rates."""
    speed = state.v[i]
    if ahead > 0.0:
        speed += 0.5 * dt * state.rates[VELOCITY, i]
    return dt * speed


@jit_exact
def set_out(state, dt, h, y, x_pred, dx):
    """Fill y, x~ = y + h w and the move (n,) to begin with."""
    ahead = dt - h
    for i in range(y.size):
        y[i] = state.x[i] + ahead * state.rates[POSITION, i]
        x_pred[i] = y[i] + h * (state.v[i] + ahead * state.rates[VELOCITY, i])
        dx[i] = _expected(state, i, dt, ahead)


@jit_exact
def error(state, x0, dt, h, heavy):
    """Return the largest error in m that a step has made by itself: a third of what its end has
    been off the move to begin with; a half, of a first step.
    """
    most = 0.0
    for i in range(x0.size):
        if heavy[i] > 0.0:
            missed = state.x[i] - x0[i] - _expected(state, i, dt, dt - h)
            most = max(most, abs(missed))
    return most / (3.0 if h < dt else 2.0)


@jit_exact
def arrive(scheme, state, step, dt, mass, heavy, u):
    """Exchange ``u`` = x - y for x - x0, renew v and the rates; return what inertia lost, in J:

    theta a1 + (1 - theta) a0 times M (x - x0), less the gain of kinetic energy.
    """
    h, theta, lost = step.dt, step.theta, 0.0
    past, rates, v, x0 = state.past, state.rates, state.v, step.before.x0
    for i in range(u.size):
        before, v[i], u[i] = v[i], u[i] / h, state.x[i] - x0[i]
        a = (v[i] - before - (dt - h) * rates[VELOCITY, i]) / h
        mean = theta * mass[i] * a + (1.0 - theta) * past[INERTIA, i]
        lost += mean * u[i] - 0.5 * mass[i] * (v[i] - before) * (v[i] + before)
        past[INERTIA, i] = mass[i] * a
        rates[POSITION, i], rates[VELOCITY, i] = v[i], heavy[i] * a
        if scheme == BDF2:
            rates[POSITION, i], rates[VELOCITY, i] = u[i] / dt, heavy[i] * (v[i] - before) / dt
    return lost


@jit_exact
def weight(h, dt):
    """Return theta, the share of the forces at the end of a step in its energy book (`book`)."""
    return 1.0 if h == dt < np.inf else 0.5
