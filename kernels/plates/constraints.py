"""Constraints of a lattice of plates: supports, platens, mirror planes and prescribed moves."""

from kernels.compile.jit import jit_exact
from kernels.plates import layout


@jit_exact
def reduce(problem, g, residual):
    """Fill ``residual`` (n,) with the gradient ``g`` (n,) of the free and driven coordinates."""
    layout.reduce(problem.scene.layout, g, residual)


@jit_exact
def lead(problem, move, direction):
    """Write the moves of all LED coordinates when the driven coordinate moves by ``move`` m."""
    layout.lead(problem.scene.layout, move, direction)


@jit_exact
def pull(problem, move, direction):
    """Fill ``direction`` (n,), zero before, with the linearised change of the gradient when the
    driven coordinate moves by ``move`` m.
    """
    for i in range(direction.size):
        direction[i] = problem.buffers.pull[i] * move


@jit_exact
def tie(problem, vector):
    """Set entries of tied coordinates to those of their leaders times the ratio of moves."""
    layout.tie(problem.scene.layout, vector)
