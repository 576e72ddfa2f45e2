"""Lagged friction: normal forces and directions are fixed during a minimisation.

Verbs of a problem for lagged forces (`solve.problem`), whatever the dimension of its contacts. The
class of `Neighbours.lagged_contacts` has the verbs

    lag(x, contact, pairs, drift, friction), evaluate(u, eps, g), follow(u, dx, share, eps),
    forget()
"""

from kernels.arrays import add
from kernels.compile.jit import jit_exact

SLIDING = 0.01  # least slip speed / mean speed of the structure


@jit_exact
def lag(problem, y):
    """Lag the normal forces at ``y`` (n,); return whether there are any now, or were before."""
    if problem.scene.friction.mu == 0.0:
        return False
    scene, neighbours = problem.scene, problem.neighbours
    lagged_contacts, moved = neighbours.lagged_contacts, problem.drift(y)
    before = lagged_contacts.count[0]
    lagged_contacts.lag(y, scene.contact, neighbours.pairs, moved, scene.friction)
    return before + lagged_contacts.count[0] > 0


@jit_exact
def slip_of(problem, step):
    """Return eps of the step, the slip up to which friction is smoothed, m.

    In a motion it is at least `SLIDING` of the distance that the structure moves: in steps in which
    most contacts slide a million times as far as a fixed slip, Newton's method would change their
    signs one by one.
    """
    slip = problem.scene.friction.slip
    return max(slip, SLIDING * step.speed) * step.h if step.dynamic else slip * step.rows


@jit_exact
def exchange(problem, step, evaluation):
    """Replace D_f and its gradient in ``evaluation`` by their present values; return E."""
    sums = evaluation.sums[0]
    if problem.scene.friction.mu == 0.0:
        return sums.potential
    for i in range(evaluation.g.size):
        evaluation.g[i] -= evaluation.friction[i]
        evaluation.friction[i] = 0.0
    before = sums.friction
    sums.potential += friction(problem, step, evaluation) - before
    return sums.potential


@jit_exact
def friction(problem, step, evaluation):
    """Return D_f in J; fill ``evaluation.friction``, zero on entry, and add it to the gradient."""
    sums = evaluation.sums[0]
    sums.friction = 0.0
    if problem.scene.friction.mu != 0.0:
        eps, lagged_contacts = slip_of(problem, step), problem.neighbours.lagged_contacts
        sums.friction = lagged_contacts.evaluate(evaluation.u, eps, evaluation.friction)
        add(evaluation.friction, evaluation.g)
    return sums.friction


@jit_exact
def follow(problem, dx, share, step, evaluation):
    """Update the duals of friction in a ``share`` of ``dx``; see `solve.problem.Problem.follow`."""
    return problem.neighbours.lagged_contacts.follow(
        evaluation.u, dx, share, slip_of(problem, step)
    )


@jit_exact
def forget(problem):
    """Reset the duals of friction."""
    problem.neighbours.lagged_contacts.forget()
