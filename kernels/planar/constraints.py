"""Constraints of a lattice: supports, platens, prescribed moves and periodic images."""

from kernels.arrays import zero, zero_rows
from kernels.compile.jit import jit, jit_exact
from kernels.linear import periodic_images
from kernels.terms import elements


@jit
def reduce(problem, g, residual):
    """Fill ``residual`` (n,) with the gradient ``g`` (n,) of the free and driven coordinates.

    Entries of tied coordinates are added to their leaders; those of held ones are zero.
    """
    layout = problem.scene.layout
    zero(residual)
    for i in range(g.size):
        leader = layout.leader[i]
        if leader == i:
            residual[i] += g[i]
        elif leader >= 0:
            residual[leader] += layout.ratio[i] * g[i]
    periodic_images.collect(layout.images, residual)


@jit_exact
def lead(problem, move, direction):
    """Write the moves of all LED coordinates when the driven coordinate moves by ``move`` m."""
    layout = problem.scene.layout
    for i in range(direction.size):
        if layout.leader[i] == layout.driven:
            direction[i] = layout.ratio[i] * move
    periodic_images.spread(layout.images, direction)


@jit_exact
def pull(problem, move, direction):
    """Fill ``direction`` (n,), zero before, with the linearised change of the gradient when the
    driven coordinate moves by ``move`` m.
    """
    walls, shape, stiffness = problem.scene.walls, problem.buffers.shape, problem.buffers.stiffness
    matrix = problem.neighbours.system.matrix
    lead(problem, move, direction)
    zero_rows(shape.slope)
    elements.product(walls, stiffness, direction, 1.0, shape)
    zero(direction)
    elements.gather(walls, shape, direction)
    for i in range(direction.size):
        direction[i] += matrix.pull[i] * move


@jit_exact
def tie(problem, vector):
    """Set entries of tied coordinates to those of their leaders times the ratio of their moves."""
    layout = problem.scene.layout
    for i in range(layout.leader.size):
        leader = layout.leader[i]
        if leader >= 0 and leader != i:
            vector[i] = layout.ratio[i] * vector[leader]
