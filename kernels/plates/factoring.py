"""The Hessian of a lattice of plates at the point of the last `potential.evaluate`, factored."""

from kernels.arrays import zero
from kernels.compile.jit import jit_exact
from kernels.linear.pivots import ROUNDED, THROUGH
from kernels.linear.supernodal import factor as ldlt
from kernels.linear.supernodal import matrix as blocks
from kernels.linear.supernodal import solution
from kernels.plates import assembly
from kernels.plates.element import shell
from kernels.plates.layout import PER_NODE
from kernels.solve.problem import NEGATIVE, NO_ROOM, POSITIVE
from kernels.terms import inertia


@jit_exact
def _assemble(problem, x, step, evaluation):
    """Fill the matrix with the exact Hessian, and the pull of the driven coordinate."""
    scene, buffers = problem.scene, problem.buffers
    matrix, layout, pull = problem.neighbours.matrix, scene.layout, buffers.pull
    blocks.clear(matrix)
    zero(pull)
    for e in range(scene.shell.quads.shape[0]):
        shell.hessian(
            x, buffers.committed, scene.shell, scene.law, buffers.memory, e, buffers.shell,
            buffers.second,
        )  # fmt: skip
        assembly.add_stencil(
            matrix, layout, pull, scene.shell.quads[e], 4, PER_NODE, buffers.second
        )
    assembly.add_contacts(problem, x, step, evaluation)
    if step.dynamic:
        zero(buffers.diagonal)
        inertia.hessian(scene.coordinates.mass, step.h, buffers.diagonal)
        assembly.add_diagonal(matrix, layout, pull, buffers.diagonal)


@jit_exact
def factor(problem, x, step, evaluation, shift, through):
    """Factor the Hessian at ``x``, of all terms; see `solve.problem.Problem.factor`.

    The weights of the shift are in `Layout`. With a shift, the matrix of the call before is used.
    """
    layout, matrix = problem.scene.layout, problem.neighbours.matrix
    if shift == 0.0:
        _assemble(problem, x, step, evaluation)
        if matrix.missing[0] != 0:
            return NO_ROOM, 0.0
    rounded = THROUGH if through else ROUNDED
    failed, pivot = ldlt.factor(matrix, layout.scale, layout.weight, shift, rounded)
    return (NEGATIVE if failed >= 0 else POSITIVE), pivot


@jit_exact
def solve(problem, b):
    """Solve in place for the right side ``b`` (n,); held coordinates are zero."""
    layout, vector = problem.scene.layout, problem.buffers.unknowns
    zero(vector)
    for i in range(b.size):
        if layout.unknown[i] >= 0:
            vector[layout.unknown[i]] += layout.ratio[i] * b[i]
    solution.solve(problem.neighbours.matrix, vector)
    _spread(layout, vector, b)


@jit_exact
def _spread(layout, vector, move):
    """Write the moves ``vector`` (u,) of the unknowns to all coordinates of ``move`` (n,)."""
    for i in range(move.size):
        u = layout.unknown[i]
        move[i] = layout.ratio[i] * vector[u] if u >= 0 else 0.0


@jit_exact
def pull(problem, move, direction):
    """Fill ``direction`` (n,) with the linearised change of the gradient when the driven coordinate
    moves by ``move`` m.
    """
    for i in range(direction.size):
        direction[i] = problem.buffers.pull[i] * move


@jit_exact
def descend(problem, direction):
    """Fill ``direction`` (n,) with d such that d . H d is the negative pivot of `factor`."""
    solution.descend(problem.neighbours.matrix, problem.buffers.unknowns)
    _spread(problem.scene.layout, problem.buffers.unknowns, direction)


@jit_exact
def unstable(problem):
    """Return the number of negative pivots of the factor."""
    return ldlt.negatives(problem.neighbours.matrix)


@jit_exact
def stiffest(problem):
    """Return the largest diagonal entry of a length in the last factor, N/m."""
    return ldlt.stiffest(problem.neighbours.matrix, problem.scene.layout.is_length)
