"""The energy book of a march, in J.

Every force g works along dx with theta g' + (1 - theta) g, of the end and of the start of a step.
What the integrator loses is what inertia and the stored energy are booked with less what they gain,
of backward Euler (theta = 1) 1/2 |v' - v|_M^2 + [grad U' . dx - dU]. The others and static steps go
by the trapezoidal rule (theta = 1/2): what they lose is of the third order in a step where all is
smooth, of either sign. The trapezoidal integrator loses no kinetic energy.

What the material itself dissipates in a step is part of the work along dx of what is stored; the
law tells it when the step is committed, and the integrator's loss is less by that.
"""

from kernels.arrays import copy, dot, zero
from kernels.compile.jit import jit_exact
from kernels.solve.problem import FREE, LED

LEFT = 1e-3  # of all energy: more must not be left over in a step


@jit_exact
def kinetic(v, mass):
    """Return 1/2 |v|_M^2 in J."""
    total = 0.0
    for i in range(mass.size):
        total += mass[i] * v[i] * v[i]
    return 0.5 * total


@jit_exact
def _work(force, past, u, theta):
    """Return the work of a force (n,) along ``u``, which is then the ``past`` one."""
    value = 0.0
    for i in range(u.size):
        value += (theta * force[i] + (1.0 - theta) * past[i]) * u[i]
        past[i] = force[i]
    return value


@jit_exact
def strike(state, problem, speed, led):
    """Give what is led its ``speed`` (m/s) at once, an inelastic blow: half of its work is lost.

    led (n,): scratch.
    """
    coordinates, book = problem.scene.coordinates, state.book[0]
    zero(led)
    problem.lead(speed, led)
    for i in range(led.size):
        if coordinates.role[i] == LED:
            change = led[i] - state.v[i]
            book.work += coordinates.mass[i] * change * led[i]
            book.integrator += 0.5 * coordinates.mass[i] * change * change
            state.v[i] = led[i]


@jit_exact
def made(state, found, mass, dt):
    """Return the energy that a step of backward Euler makes, and all there is, in J.

    Where the potential is not convex its loss may be negative, the more the longer the step.
    """
    loss, there = 0.0, state.book[0].kinetic
    for i in range(mass.size):
        change = found.u[i] / dt - state.v[i]
        loss += found.elastic[i] * found.u[i] + 0.5 * mass[i] * change * change
    for k in range(found.stored.size):
        loss -= found.stored[k] - state.stored[k]
        there += max(found.stored[k], state.stored[k])
    return -loss, max(there, abs(state.book[0].work))


@jit_exact
def _largest(state):
    """Return the greatest energy in the book, J."""
    book = state.book[0]
    most = max(abs(book.work), abs(book.kinetic), abs(book.material), abs(book.friction))
    most = max(most, abs(book.integrator), abs(book.injected))
    for energy in state.stored:
        most = max(most, abs(energy))
    return most


@jit_exact
def unbalanced(x0, problem, tolerance, state, found, work):
    """Return whether what a step from ``x0`` leaves out of balance does work that counts.

    Where elements or openings are so small that positions cannot resolve them, the forces that
    count as none (`residual.allowed`) know no bound.
    """
    left, noise, there, coordinates = 0.0, 0.0, _largest(state), problem.scene.coordinates
    problem.reduce(found.g, work.residual)
    for i in range(x0.size):
        if coordinates.role[i] == FREE:
            move = state.x[i] - x0[i]
            left += work.residual[i] * move
            noise += tolerance.force * abs(move) * coordinates.scale[i]
    for energy in found.stored:
        there = max(there, energy)
    return abs(left) > LEFT * there + noise


@jit_exact
def enter(problem, step, state, found, work):
    """Add one converged step, found by the last `evaluate`, to the energy book."""
    book, past, totals, theta = state.book[0], state.past, state.totals[0], step.theta
    held, lead, driven = 0.0, 0.0, problem.scene.coordinates.driven
    if driven >= 0:
        problem.reduce(found.g, work.residual)
        held, lead = work.residual[driven], found.u[driven]
    factor = theta * step.factor + (1.0 - theta) * totals.factor
    book.work += factor * dot(problem.scene.coordinates.load, found.u)
    book.work += (theta * held + (1.0 - theta) * totals.reaction) * lead
    dissipated = found.sums[0].dissipated
    book.material += _work(found.material, past.material, found.u, theta) + dissipated
    book.friction += _work(found.friction, past.friction, found.u, theta)
    loss = _work(found.elastic, past.elastic, found.u, theta) - dissipated
    total = 0.0
    for k in range(found.stored.size):
        loss -= found.stored[k] - state.stored[k]
        total += found.stored[k]
        state.stored[k] = found.stored[k]
    book.integrator += loss
    totals.reaction, totals.factor = held, step.factor
    book.residual = book.work + book.injected - book.kinetic - total
    book.residual -= book.material + book.friction + book.integrator


@jit_exact
def _hasten(x, start, h, load, v):
    """Add to ``v`` the speed of a move from ``start`` to ``x`` in ``h``; return the work of
    ``load`` on it, J.
    """
    work = 0.0
    for i in range(x.size):
        moved = x[i] - start[i]
        v[i] += moved / h
        work += load[i] * moved
    return work


@jit_exact
def project(problem, step, state, found, start):
    """Move apart what is too near after a step, and book what that adds to the energy.

    Return whether anything has moved. start (n,): scratch.
    """
    book, coordinates = state.book[0], problem.scene.coordinates
    copy(state.x, start)
    if not problem.project(state.x):
        return False
    problem.store(state.x, step, found)
    gained = -book.kinetic
    for energy in state.stored:
        gained -= energy
    way = step.factor * _hasten(state.x, start, step.h, coordinates.load, state.v)
    book.kinetic = kinetic(state.v, coordinates.mass)
    copy(found.stored, state.stored)
    gained += book.kinetic
    for energy in state.stored:
        gained += energy
    book.work += way
    book.injected += gained - way
    return True
