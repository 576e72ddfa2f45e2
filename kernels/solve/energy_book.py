"""The energy book of a march, in J.

The work against a force of gradient g in a step dx is (theta g' + (1 - theta) g) . dx, with g at
the start and g' at the end of the step. The integrator's loss is the work against inertia and
elastic forces less the gain of kinetic and stored energy U. With backward Euler (theta = 1) it is
1/2 |v' - v|_M^2 + [grad U' . dx - dU]. The other integrators and static steps use the trapezoidal
rule (theta = 1/2); their loss has either sign and is of third order in the step where the motion is
smooth. The trapezoidal integrator loses no kinetic energy.

The dissipation of the material in a step is part of the work against elastic forces. The law
returns it at commit; it is booked under material, and subtracted from the integrator's loss.
"""

import numpy as np

from kernels.arrays import copy, dot, zero
from kernels.compile.jit import jit_exact
from kernels.solve import integrators
from kernels.solve.problem import FREE, LED

LARGEST_IMBALANCE = 1e-3  # work of the residual in a step, as a share of the largest energy


@jit_exact
def kinetic(v, mass):
    """Return 1/2 |v|_M^2 in J."""
    total = 0.0
    for i in range(mass.size):
        total += mass[i] * v[i] * v[i]
    return 0.5 * total


@jit_exact
def mean_speed(v, mass):
    """Return the root mean square of the velocity over all mass, m/s; 0 without mass."""
    total = 0.0
    for i in range(mass.size):
        total += mass[i]
    return np.sqrt(2.0 * kinetic(v, mass) / total) if total > 0.0 else 0.0


@jit_exact
def _works(evaluation, last, theta):
    """Return the work against elastic forces, damping and friction along ``evaluation.u``; replace
    their gradients of the last step in ``last`` by the present ones.
    """
    u, elastic, material, friction, before = evaluation.u, 0.0, 0.0, 0.0, 1.0 - theta
    for i in range(u.size):
        elastic += (theta * evaluation.elastic[i] + before * last.elastic[i]) * u[i]
        material += (theta * evaluation.material[i] + before * last.material[i]) * u[i]
        friction += (theta * evaluation.friction[i] + before * last.friction[i]) * u[i]
    copy(evaluation.elastic, last.elastic)
    copy(evaluation.material, last.material)
    copy(evaluation.friction, last.friction)
    return elastic, material, friction


@jit_exact
def impose_speed(state, problem, speed, led):
    """Set the velocity of the driven coordinate to ``speed`` (m/s), and the velocities of its
    followers.

    Inelastic impact: a change dv of velocity loses m dv^2 / 2, which from rest is half of the work.
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
def energy_gain(scheme, problem, step, state, evaluation):
    """Return the energy that the integrator generates in a step, and the largest energy, in J.

    The generated energy is the negative of the integrator's loss, which here includes the
    dissipation of the material. Where it is positive the step is too long: for backward Euler where
    the potential is not convex, for the trapezoidal rule where forces are not linear. evaluation:
    at the end of the step, before `integrators.update`.
    """
    loss, largest, coordinates = 0.0, state.book[0].kinetic, problem.scene.coordinates
    last, theta, before = state.gradients.elastic, step.theta, 1.0 - step.theta
    if step.dynamic:
        loss = integrators.kinetic_loss(scheme, state, step, coordinates, evaluation.u)
    for i in range(last.size):
        loss += (theta * evaluation.elastic[i] + before * last[i]) * (state.x[i] - step.x0[i])
    for k in range(evaluation.stored.size):
        loss -= evaluation.stored[k] - state.stored[k]
        largest += max(evaluation.stored[k], state.stored[k])
    return -loss, max(largest, abs(state.book[0].work))


@jit_exact
def largest_energy(problem, step, state, evaluation):
    """Return the largest energy in the book and in a step that is not entered yet, J."""
    book, coordinates = state.book[0], problem.scene.coordinates
    largest = max(abs(book.work), abs(book.kinetic), abs(book.material), abs(book.friction))
    largest = max(largest, abs(book.integrator), abs(book.injected))
    for k in range(evaluation.stored.size):
        largest = max(largest, abs(state.stored[k]), evaluation.stored[k])
    work = 0.0
    for i in range(coordinates.load.size):
        work += step.factor * coordinates.load[i] * (state.x[i] - step.x0[i])
    if step.dynamic:
        largest = max(largest, kinetic(evaluation.u, coordinates.mass) / step.h**2)
    return max(largest, abs(work))


@jit_exact
def unbalanced(problem, step, tolerance, state, evaluation, work):
    """Return whether the work of the residual in a step is too large.

    Where positions cannot resolve very small elements or openings, the admissible residual
    (`residual.allowed`) has no bound; this test bounds its work.
    """
    imbalance, noise, coordinates = 0.0, 0.0, problem.scene.coordinates
    problem.reduce(evaluation.g, work.residual)
    for i in range(state.x.size):
        if coordinates.role[i] == FREE:
            move = state.x[i] - step.x0[i]
            imbalance += work.residual[i] * move
            noise += tolerance.force * abs(move) * coordinates.scale[i]
    limit = LARGEST_IMBALANCE * largest_energy(problem, step, state, evaluation) + noise
    return not abs(imbalance) <= limit


@jit_exact
def enter_step(problem, step, state, evaluation, work):
    """Enter a converged step into the book. evaluation: at its end, after `Problem.commit`."""
    book, totals, theta = state.book[0], state.totals[0], step.theta
    reaction, move, driven = 0.0, 0.0, problem.scene.coordinates.driven
    if driven >= 0:
        problem.reduce(evaluation.g, work.residual)
        reaction, move = work.residual[driven], evaluation.u[driven]
    factor = theta * step.factor + (1.0 - theta) * totals.factor
    book.work += factor * dot(problem.scene.coordinates.load, evaluation.u)
    book.work += (theta * reaction + (1.0 - theta) * totals.reaction) * move
    dissipated = evaluation.sums[0].dissipated
    elastic, material, friction = _works(evaluation, state.gradients, theta)
    book.material += material + dissipated
    book.friction += friction
    loss, total = elastic - dissipated, 0.0
    for k in range(evaluation.stored.size):
        loss -= evaluation.stored[k] - state.stored[k]
        total += evaluation.stored[k]
        state.stored[k] = evaluation.stored[k]
    book.integrator += loss
    totals.reaction, totals.factor = reaction, step.factor
    totals.largest_reaction = max(totals.largest_reaction, abs(reaction))
    book.residual = book.work + book.injected - book.kinetic - total
    book.residual -= book.material + book.friction + book.integrator


@jit_exact
def _add_velocity(x, start, h, load, v):
    """Add (x - start) / h to ``v`` (n,); return the work of ``load`` (n,) on the move, J."""
    work = 0.0
    for i in range(x.size):
        moved = x[i] - start[i]
        v[i] += moved / h
        work += load[i] * moved
    return work


@jit_exact
def project(problem, step, state, evaluation, start):
    """Let the problem correct positions or data (`Problem.project`), and book the energy injected.

    Return whether it has corrected anything. start (n,): scratch.
    """
    book, coordinates = state.book[0], problem.scene.coordinates
    copy(state.x, start)
    if not problem.project(state.x):
        return False
    problem.store(state.x, step, evaluation)
    gained = -book.kinetic
    for energy in state.stored:
        gained -= energy
    load_work = step.factor * _add_velocity(state.x, start, step.h, coordinates.load, state.v)
    book.kinetic = kinetic(state.v, coordinates.mass)
    copy(evaluation.stored, state.stored)
    gained += book.kinetic
    for energy in state.stored:
        gained += energy
    book.work += load_work
    book.injected += gained - load_work
    return True
