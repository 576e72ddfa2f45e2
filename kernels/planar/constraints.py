"""Constraints of a lattice: supports, platens, prescribed moves and periodic images."""

from kernels.arrays import zero, zero_rows
from kernels.compile.jit import jit, jit_exact
from kernels.linear.condensed import periodic_images
from kernels.shared import followers
from kernels.terms import elements


@jit
def reduce(problem, g, residual):
    """Fill ``residual`` as `followers.reduce` does; add entries of images to their originals."""
    followers.reduce(problem, g, residual)
    periodic_images.collect(problem.scene.layout.images, residual)


@jit_exact
def lead(problem, move, direction):
    """Write moves as `followers.lead` does, and the moves of the images."""
    followers.lead(problem, move, direction)
    periodic_images.spread(problem.scene.layout.images, direction)


@jit_exact
def tie(problem, vector):
    """Set entries as `followers.tie` does, and the entries of the images."""
    followers.tie(problem, vector)
    periodic_images.spread(problem.scene.layout.images, vector)


@jit_exact
def pull(problem, move, direction):
    """Fill ``direction`` (n,), which is zero before, with the linearised change of the gradient
    when the driven coordinate moves by ``move`` m.
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
