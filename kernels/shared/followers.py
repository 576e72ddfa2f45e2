"""Coordinates that follow others: supports, platens and prescribed moves.

Verbs of a problem for its constraints (`solve.problem`), whatever the dimension. The layout of the
problem has leader (n,), the coordinate that each one follows, itself if free, -1 if held; ratio
(n,), its move divided by the move of its leader; and driven, the leader with a prescribed move.
"""

from kernels.arrays import zero
from kernels.compile.jit import jit, jit_exact


@jit
def reduce(problem, g, residual):
    """Fill ``residual`` (n,) with the gradient ``g`` (n,) of the free and driven coordinates.

    Entries of tied coordinates are added to their leaders; entries of held ones are zero.
    """
    layout = problem.scene.layout
    zero(residual)
    for i in range(g.size):
        if layout.leader[i] >= 0:
            residual[layout.leader[i]] += layout.ratio[i] * g[i]


@jit_exact
def lead(problem, move, direction):
    """Write the moves of all LED coordinates when the driven coordinate moves by ``move`` m."""
    layout = problem.scene.layout
    for i in range(direction.size):
        if layout.leader[i] == layout.driven:
            direction[i] = layout.ratio[i] * move


@jit_exact
def tie(problem, vector):
    """Set each tied coordinate of ``vector`` to its leader times the ratio of their moves."""
    layout = problem.scene.layout
    for i in range(vector.size):
        leader = layout.leader[i]
        if leader >= 0 and leader != i:
            vector[i] = layout.ratio[i] * vector[leader]
