"""Whether a point at which Newton has converged is resolved well enough to be a step.

The admissible residual is at least the force of the stiffest coordinate in the smallest move that
positions resolve (`residual.allowed`), and that force has no bound. In a very short step inertia
alone, m / h^2, makes any load admissible: the structure would stay where it is, and lose the
momentum that the load gives it. A point is therefore a step only if

    max |r| <= LARGEST_RESIDUAL F,   F: the largest force of this step and of all before,

or if two energies are small compared with the energies of the run: the energy that the residual can
still release (twice the Newton decrement), and the work of the residual. This is the case at a
stiff contact, a small element or a small opening. A residual above the limit is not accepted,
however, where the inertia of its own coordinate is not resolved: the momentum lost there adds up
from step to step.
"""

from kernels.arrays import total
from kernels.compile.jit import jit_exact
from kernels.solve.energy_book import LARGEST_IMBALANCE, largest_energy
from kernels.solve.integrators import FIRST_SHARE
from kernels.solve.problem import FREE
from kernels.solve.residual import largest_residual, scaled

LARGEST_RESIDUAL = 1e-2  # as a share of the largest force
TOLERATED = 1e-4  # residual that Newton may leave, as a share of the load, unless it is round-off
SHARPEST = 0.0625  # of `Tolerance.resolution`, which is about 20 times the round-off of positions


@jit_exact
def largest_load(problem, factor, work):
    """Return the largest dead load on a free coordinate, N."""
    coordinates = problem.scene.coordinates
    for i in range(work.trial.size):
        work.trial[i] = factor * coordinates.load[i]
    problem.reduce(work.trial, work.residual)
    return largest_residual(work.residual, coordinates)


@jit_exact
def _largest_mass(coordinates):
    """Return the largest mass of a free coordinate, kg."""
    mass = 0.0
    for i in range(coordinates.mass.size):
        if coordinates.role[i] == FREE:
            mass = max(mass, coordinates.mass[i])
    return mass


@jit_exact
def first_share(problem, tolerance, duration, factor, state, work):
    """Return the share of a first step of ``duration``: `integrators.FIRST_SHARE`, or a larger
    share if the next one, with half the length h, would not be resolved.
    """
    coordinates, momentum, share = problem.scene.coordinates, 0.0, FIRST_SHARE
    load = largest_load(problem, factor, work)
    for i in range(state.v.size):
        momentum = max(momentum, coordinates.mass[i] * abs(state.v[i]))
    unresolved = tolerance.resolution * _largest_mass(coordinates)
    while share < 1.0:
        h = 0.5 * share * duration
        force = max(load, momentum / h)
        if force == 0.0 or unresolved <= 0.5 * LARGEST_IMBALANCE * force * h * h:
            break
        share *= 2.0
    return share


@jit_exact
def fit(tolerance, step, coordinates, load):
    """Return the tolerance of a step, tightened to `TOLERATED` of the ``load`` (N).

    Where inertia alone makes a larger residual than `LARGEST_RESIDUAL` admissible, the resolution
    is tightened too, as far as the round-off of positions allows.
    """
    if load == 0.0:
        return tolerance
    limit, sharpness = 0.5 * LARGEST_RESIDUAL * load, 1.0
    if step.dynamic:
        unresolved = tolerance.resolution * _largest_mass(coordinates) / step.h**2
        if unresolved > limit:
            sharpness = max(limit / unresolved, SHARPEST)
    return scaled(tolerance, min(1.0, TOLERATED * load / tolerance.force), sharpness)


@jit_exact
def is_coarse(tolerance, step, problem, load):
    """Return whether inertia makes a considerable part of the ``load`` (N) unresolved.

    A shorter step would not be resolved better.
    """
    unresolved = tolerance.resolution * _largest_mass(problem.scene.coordinates)
    return step.dynamic and unresolved > LARGEST_IMBALANCE * load * step.h**2 > 0.0


@jit_exact
def is_tighter(one, other):
    """Return whether ``one``, which `fit` has returned for the ``other`` tolerance, is tighter than
    it.
    """
    return one.force < other.force or one.resolution < other.resolution


@jit_exact
def largest_force(coordinates, state, evaluation, load):
    """Return the largest force on a coordinate in the step of ``evaluation`` and all before, N.

    load: `largest_load` of the step. Damping is left out: in a very short step it magnifies the
    round-off of positions.
    """
    lever, force = coordinates.lever, max(state.totals[0].force, load)
    for part in (evaluation.elastic, evaluation.friction):
        for i in range(part.size):
            force = max(force, abs(part[i]) * lever[i])
    return force


@jit_exact
def _largest_inertia(coordinates, v, h):
    """Return the largest force, N, that stops a coordinate of velocity ``v`` (n,) within h."""
    force = 0.0
    for i in range(v.size):
        force = max(force, coordinates.mass[i] * abs(v[i]) / h)
    return force


@jit_exact
def is_resolved(problem, step, tolerance, state, evaluation, work, load, decrement):
    """Return whether the residual of a step is small enough.

    It is if only a prescribed move drives the problem, or if nothing drives it in a static step.
    Without a load, motion from rest is due to stored energy: of a strained spring, or after a
    release. load: `largest_load` of the step. decrement: Newton decrement at the point, J.
    """
    coordinates, driving = problem.scene.coordinates, load
    if step.dynamic and state.book[0].kinetic > tolerance.noise:
        driving = max(driving, _largest_inertia(coordinates, state.v, step.h))
    if driving == 0.0:
        stored = total(state.stored) + total(evaluation.stored)
        if coordinates.driven >= 0 or not step.dynamic or stored <= tolerance.noise:
            return True
    force = max(driving, largest_force(coordinates, state, evaluation, load))
    limit, left, h2 = LARGEST_RESIDUAL * force, 2.0 * decrement, step.h * step.h
    problem.reduce(evaluation.g, work.residual)
    if largest_residual(work.residual, coordinates) <= limit:
        return True
    for i in range(state.x.size):
        if coordinates.role[i] != FREE:
            continue
        heavy = step.dynamic and tolerance.resolution * coordinates.mass[i] > limit * h2
        if heavy and abs(work.residual[i]) > limit:
            return False
        left += abs(work.residual[i] * (state.x[i] - step.x0[i]))
    return left <= LARGEST_IMBALANCE * largest_energy(problem, step, state, evaluation)
