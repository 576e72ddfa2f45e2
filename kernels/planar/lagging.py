"""Friction of a lattice, which lags: normal forces and directions as they were taken last."""

from kernels.arrays import add
from kernels.compile.jit import jit_exact
from kernels.planar.reach import drift
from kernels.terms import friction


@jit_exact
def lags(problem):
    """Return whether there is friction."""
    return problem.scene.friction.mu > 0.0


@jit_exact
def lag(problem, y):
    """Take normal forces at ``y`` (n,); return whether there are any, or were before."""
    if problem.scene.friction.mu == 0.0:
        return False
    before, pairs = problem.neighbours.lagged_contacts.count[0], problem.neighbours.pairs
    scene = problem.scene
    friction.lag(
        y,
        scene.contact,
        pairs,
        drift(problem, y),
        scene.friction,
        problem.neighbours.lagged_contacts,
    )
    return before + problem.neighbours.lagged_contacts.count[0] > 0


@jit_exact
def slip_of(problem, step):
    """Return the slip in m below which friction is smoothed."""
    slip = problem.scene.friction.slip
    return slip * step.h if step.dynamic else slip


@jit_exact
def exchange(problem, step, found):
    """Exchange D_f and its gradient in ``found`` for those of the forces of now; return E."""
    sums = found.sums[0]
    if problem.scene.friction.mu == 0.0:
        return sums.potential
    for i in range(found.g.size):
        found.g[i] -= found.friction[i]
        found.friction[i] = 0.0
    slip = slip_of(problem, step)
    rubbed = friction.evaluate(found.u, problem.neighbours.lagged_contacts, slip, found.friction)
    add(found.friction, found.g)
    sums.potential += rubbed - sums.friction
    sums.friction = rubbed
    return sums.potential


@jit_exact
def follow(problem, dx, share, step, found):
    """Carry the duals of friction along a share of ``dx``; return whether they fit at its end."""
    return friction.follow(
        found.u, dx, share, problem.neighbours.lagged_contacts, slip_of(problem, step)
    )


@jit_exact
def forget(problem):
    """Forget the duals of friction."""
    friction.forget(problem.neighbours.lagged_contacts)
