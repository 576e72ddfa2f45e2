"""The Hessian of a lattice at the point of the last `potential.evaluate`, factored and solved."""

from kernels.compile.jit import jit_exact
from kernels.linear.condensed import block_ldlt, system
from kernels.linear.condensed.block_matrix import clear
from kernels.shared.lagging import slip_of
from kernels.solve.problem import NEGATIVE, NO_ROOM, POSITIVE
from kernels.terms import contact, damping, fold, friction, inertia, spring

LENGTHS = 2  # x and y, the first slots of a block


@jit_exact
def factor(problem, x, step, evaluation, shift, through):
    """Factor the Hessian of all terms at ``x``; see `solve.problem.Problem.factor`."""
    scene, neighbours = problem.scene, problem.neighbours
    matrix, scale = neighbours.system.matrix, scene.coordinates.scale
    clear(matrix)
    fold.hessian(x, scene.fold, matrix)
    spring.hessian(x, scene.spring, matrix)
    contact.hessian(x, scene.contact, neighbours.pairs, neighbours.touching, matrix)
    friction.hessian(evaluation.u, neighbours.lagged_contacts, slip_of(problem, step), matrix)
    if step.dynamic:
        inertia.hessian(scene.coordinates.mass, step.h, matrix.diagonal)
        damping.hessian(scene, step.h, matrix.diagonal)
    if shift > 0.0:
        for i in range(scale.size):
            matrix.diagonal[i] += shift * scale[i] * scale[i]
    failed, pivot = system.factor(
        neighbours.system, scene.layout, problem.buffers.stiffness, through
    )
    if matrix.missing[0] != 0:
        return NO_ROOM, pivot
    return (NEGATIVE if failed else POSITIVE), pivot


@jit_exact
def solve(problem, b):
    """Solve in place for the right side ``b`` (n,); held coordinates are zero."""
    system.solve(problem.neighbours.system, problem.scene.layout, b)


@jit_exact
def descend(problem, direction):
    """Fill ``direction`` (n,) with d such that d . H d is the negative pivot of `factor`."""
    system.descend(problem.neighbours.system, problem.scene.layout, direction)


@jit_exact
def unstable(problem):
    """Return the number of negative pivots of the factor."""
    return system.negatives(problem.neighbours.system)


@jit_exact
def stiffest(problem):
    """Return the largest diagonal entry of x and y coordinates in the last factor, N/m."""
    return block_ldlt.stiffest(problem.neighbours.system.matrix, LENGTHS)
