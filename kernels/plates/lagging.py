"""Lagged friction of plates: normal forces and tangent planes are fixed during a minimisation."""

from kernels.arrays import add
from kernels.compile.jit import jit_exact
from kernels.plates import friction
from kernels.plates.reach import drift


@jit_exact
def lags(problem):
    """Return whether the scene has friction."""
    return problem.scene.friction.mu > 0.0


@jit_exact
def lag(problem, y):
    """Lag the normal forces at ``y`` (n,); return whether there are any now, or were before."""
    if problem.scene.friction.mu == 0.0:
        return False
    scene, neighbours = problem.scene, problem.neighbours
    lagged_contacts, moved = neighbours.lagged_contacts, drift(problem, y)
    before = lagged_contacts.count[0]
    friction.lag(y, scene.contact, neighbours.pairs, moved, scene.friction, lagged_contacts)
    return before + lagged_contacts.count[0] > 0


@jit_exact
def slip_of(problem, step):
    """Return the smoothing length of friction: the slip in a step, m."""
    slip = problem.scene.friction.slip
    return slip * step.h if step.dynamic else slip


@jit_exact
def exchange(problem, step, found):
    """Replace D_f and its gradient in ``found`` by those of the present forces; return E in J."""
    sums = found.sums[0]
    if problem.scene.friction.mu == 0.0:
        return sums.potential
    for i in range(found.g.size):
        found.g[i] -= found.friction[i]
        found.friction[i] = 0.0
    slip = slip_of(problem, step)
    potential = friction.evaluate(found.u, problem.neighbours.lagged_contacts, slip, found.friction)
    add(found.friction, found.g)
    sums.potential += potential - sums.friction
    sums.friction = potential
    return sums.potential


@jit_exact
def follow(problem, dx, share, step, found):
    """Update the duals of friction in a ``share`` of ``dx``; see `solve.problem.Problem.follow`."""
    return friction.follow(
        found.u, dx, share, problem.neighbours.lagged_contacts, slip_of(problem, step)
    )


@jit_exact
def forget(problem):
    """Reset the duals of friction."""
    friction.forget(problem.neighbours.lagged_contacts)
