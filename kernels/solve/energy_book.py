"""The energy book of a march, in J.

Every force g works along dx with theta g' + (1 - theta) g, of the end and of the start of a step.
What the integrator loses is what inertia and the stored energy are booked with less what they gain,
of backward Euler (theta = 1) 1/2 |v' - v|_M^2 + [grad U' . dx - dU]. The others and static steps go
by the trapezoidal rule (theta = 1/2): what they lose is of the third order in a step where all is
smooth, of either sign. The trapezoidal integrator loses no kinetic energy.
"""

import numpy as np

from kernels.terms import inertia, position_based as project
from kernels.solve.residual import reduce
from kernels.compile.jit import jit_exact
from kernels.arrays import copy, dot
from kernels.solve.integrators import DAMPING, ELASTIC, RUBBING
from kernels.planar.potential import store

WORK, KINETIC, STRETCH, BEND, CONTACT, MATERIAL, FRICTION, INTEGRATOR = range(8)
INJECTED, RESIDUAL = 8, 9
LEFT = 1e-3  # of all energy: more must not be left over in a step


@jit_exact
def _work(force, past, u, theta):
    """Return the work of a force (n,) along ``u``, which is then the ``past`` one."""
    value = 0.0
    for i in range(u.size):
        value += (theta * force[i] + (1.0 - theta) * past[i]) * u[i]
        past[i] = force[i]
    return value


@jit_exact
def strike(state, layout, mass, speed):
    """Give what is led its ``speed`` (m/s) at once, an inelastic blow: half of its work is lost."""
    for i in range(mass.size):
        if layout.leader[i] == layout.driven:
            after = layout.ratio[i] * speed
            change = after - state.v[i]
            state.book[WORK] += mass[i] * change * after
            state.book[INTEGRATOR] += 0.5 * mass[i] * change * change
            state.v[i] = after


@jit_exact
def made(state, at, mass, dt):
    """Return the energy that a step of backward Euler makes, and all there is, in J.

    Where the potential is not convex its loss may be negative, the more the longer the step.
    """
    loss, there = 0.0, state.book[KINETIC]
    for i in range(mass.size):
        change = at.u[i] / dt - state.v[i]
        loss += at.elastic[i] * at.u[i] + 0.5 * mass[i] * change * change
    for k in range(at.stored.size):
        loss -= at.stored[k] - state.stored[k]
        there += max(at.stored[k], state.stored[k])
    return -loss, max(there, abs(state.book[WORK]))


@jit_exact
def unbalanced(x0, unknowns, tolerance, state, at, work):
    """Return whether what a step from ``x0`` leaves out of balance does work that counts.

    Where elements or openings are so small that positions cannot resolve them, the forces that
    count as none (`balance.allowed`) know no bound.
    """
    left, noise, there = 0.0, 0.0, 0.0
    reduce(at.g, unknowns, work.residual)
    for i in range(x0.size):
        if unknowns.leader[i] == i and i != unknowns.driven:
            move = state.x[i] - x0[i]
            left += work.residual[i] * move
            noise += tolerance.force * abs(move) * unknowns.scale[i]
    for energy in state.book[:RESIDUAL]:
        there = max(there, abs(energy))
    for energy in at.stored:
        there = max(there, energy)
    return abs(left) > LEFT * there + noise


@jit_exact
def enter(terms, step, unknowns, state, at, work):
    """Add one converged step, found by the last `evaluate`, to the energy book."""
    book, past, theta = state.book, state.past, step.theta
    held, lead = 0.0, 0.0
    if unknowns.driven >= 0:
        reduce(at.g, unknowns, work.residual)
        held, lead = work.residual[unknowns.driven], at.u[unknowns.driven]
    factor = theta * step.factor + (1.0 - theta) * state.held[1]
    book[WORK] += factor * dot(terms.load, at.u)
    book[WORK] += (theta * held + (1.0 - theta) * state.held[0]) * lead
    book[MATERIAL] += _work(at.material, past[DAMPING], at.u, theta)
    book[FRICTION] += _work(at.rubbing, past[RUBBING], at.u, theta)
    loss = _work(at.elastic, past[ELASTIC], at.u, theta)
    total = 0.0
    for k in range(at.stored.size):
        loss -= at.stored[k] - state.stored[k]
        total += at.stored[k]
        book[STRETCH + k] = at.stored[k]
        state.stored[k] = at.stored[k]
    book[INTEGRATOR] += loss
    state.held[0], state.held[1] = held, step.factor
    book[RESIDUAL] = book[WORK] + book[INJECTED] - book[KINETIC] - total
    book[RESIDUAL] -= book[MATERIAL] + book[FRICTION] + book[INTEGRATOR]


@jit_exact
def move_apart(terms, step, state, near, at, work):
    """Move apart what is too near after a step, and book what that adds to the energy."""
    x, book = state.x, state.book
    copy(x, work.trial)
    if not project.move_apart(x, terms.project, near.crowd):
        return
    store(x, terms, step, at, True)
    work.kept[0] = np.inf
    gained = -book[KINETIC] - book[STRETCH] - book[BEND]
    way = step.factor * project.hasten(x, work.trial, step.dt, terms.load, state.v)
    book[KINETIC] = inertia.kinetic(state.v, terms.mass)
    book[STRETCH], book[BEND] = at.stored[0], at.stored[1]
    copy(at.stored, state.stored)
    book[WORK] += way
    book[INJECTED] += gained + book[KINETIC] + book[STRETCH] + book[BEND] - way
