"""Integrators in time: each step is one of backward Euler, of length h, from a place dt - h ahead.

    v1 = (x1 - y) / h,   M (v1 - w) / h = F(x1, v1),   y = x0 + (dt - h) x',   w = v0 + (dt - h) v'

    backward Euler    h = dt
    BDF2              h = dt (1 + r) / (1 + 2 r), r = dt / last dt;  x', v': last change / last dt
    trapezoidal rule  h = dt / 2 (r infinite);  x' = v0, v' = a0, the balance at x0

What changes at once has no x', v' to go by: a first step, of backward Euler, is `FIRST` of the
others. What has no mass has no v' either, what is led has a constant speed: ``heavy`` (n,) is 0
there, else 1.
"""

import numpy as np

from kernels.compile.jit import jit_exact

BACKWARD_EULER, BDF2, TRAPEZOIDAL = range(3)
FIRST = 2.0**-4  # share of a step: its loss of energy, of first order, is the square of that
POSITION, VELOCITY = range(2)  # rates
ELASTIC, DAMPING, RUBBING = range(3)  # of the past: gradients at the last step
CHANGE = 3  # of the past: last acceleration; where not ``heavy``, mean velocity in the last step


@jit_exact
def length(scheme, dt, last):
    """Return h of a step of ``dt`` after one of ``last``, 0 where it starts anew."""
    if scheme == BACKWARD_EULER or last == 0.0 or dt == np.inf:
        return dt
    return 0.5 * dt if scheme == TRAPEZOIDAL else dt * (last + dt) / (last + 2.0 * dt)


@jit_exact
def _expected(state, i, dt, ahead, heavy):
    """Return how far coordinate ``i`` goes in ``dt`` at its rates."""
    if ahead > 0.0 and heavy[i] == 0.0:
        return dt * state.past[CHANGE, i]
    return dt * (state.v[i] + (0.5 * dt * state.rates[VELOCITY, i] if ahead > 0.0 else 0.0))


@jit_exact
def set_out(state, dt, h, heavy, y, x_pred, dx):
    """Fill y, x~ = y + h w and the move (n,) to begin with."""
    ahead = dt - h
    for i in range(y.size):
        y[i] = state.x[i] + ahead * state.rates[POSITION, i]
        x_pred[i] = y[i] + h * (state.v[i] + ahead * state.rates[VELOCITY, i])
        dx[i] = _expected(state, i, dt, ahead, heavy)


@jit_exact
def error(state, x0, dt, h, heavy):
    """Return the largest error in m that a step has made by itself: a third of what its end has
    been off the move to begin with; a half, of a first step.
    """
    most = 0.0
    for i in range(x0.size):
        if heavy[i] > 0.0:
            missed = state.x[i] - x0[i] - _expected(state, i, dt, dt - h, heavy)
            most = max(most, abs(missed))
    return most / (3.0 if h < dt else 2.0)


@jit_exact
def _tie(state, layout):
    """Let what follows another coordinate have its velocity and rates to the last digit.

    No force would damp a difference, which the schemes let grow.
    """
    for i in range(layout.leader.size):
        leader = layout.leader[i]
        if leader >= 0 and leader != i:
            state.v[i] = layout.ratio[i] * state.v[leader]
            for k in range(2):
                state.rates[k, i] = layout.ratio[i] * state.rates[k, leader]
            state.past[CHANGE, i] = layout.ratio[i] * state.past[CHANGE, leader]


@jit_exact
def arrive(scheme, state, step, dt, terms, heavy, u):
    """Exchange ``u`` = x - y for x - x0, renew v and the rates; return what inertia lost, in J:

    theta a1 + (1 - theta) a0 times M (x - x0), less the gain of kinetic energy.
    """
    by_h, ahead, theta, lost = 1.0 / step.dt, dt - step.dt, step.theta, 0.0
    past, rates, v, x0, mass = state.past, state.rates, state.v, step.before.x0, terms.mass
    for i in range(u.size):
        before, after = v[i], by_h * u[i]
        v[i], u[i] = after, state.x[i] - x0[i]
        if scheme == BACKWARD_EULER:
            lost += 0.5 * mass[i] * (after - before) ** 2
            continue
        a = by_h * (after - before - ahead * rates[VELOCITY, i])
        mean = theta * a + (1.0 - theta) * past[CHANGE, i] if heavy[i] > 0.0 else 0.0
        lost += mass[i] * (mean * u[i] - 0.5 * (after - before) * (after + before))
        past[CHANGE, i] = a if heavy[i] > 0.0 else u[i] / dt
        rates[POSITION, i], rates[VELOCITY, i] = after, heavy[i] * a
        if scheme == BDF2:
            rates[POSITION, i], rates[VELOCITY, i] = u[i] / dt, heavy[i] * (after - before) / dt
    if scheme != BACKWARD_EULER:
        _tie(state, terms.layout)
    return lost


@jit_exact
def weight(h, dt):
    """Return theta, the share of the forces at the end of a step in its energy book (`book`)."""
    return 1.0 if h == dt < np.inf else 0.5
