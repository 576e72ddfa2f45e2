"""How far nodes move, and whether a list of neighbours covers such a move.

Verbs of a problem (`solve.problem`), whatever the dimension. Its class has the verbs
``longest(dx)``, the longest move of a node in ``dx``, and ``drift(x)``, the longest move of a node
since the pairs were listed, m; its neighbours have the ``margin``, by which a pair that is not
listed may come closer, m.
"""

from kernels.arrays import zero
from kernels.compile.jit import jit_exact

ADVANCE = 0.9  # share of a move up to the first contact that is admissible
MOVE_MARGIN = 2.2  # least margin of a list made for a move, as a multiple of that move. A list with
# a margin of 2 holds for that move and no other.


@jit_exact
def begin(x, y, evaluation):
    """Fill the move u = ``x`` - ``y`` of a `solve.problem.Evaluation`; set the parts of its
    gradient to zero.
    """
    for i in range(x.size):
        evaluation.u[i] = x[i] - y[i]
    for part in (evaluation.elastic, evaluation.material, evaluation.friction):
        zero(part)


@jit_exact
def end(evaluation, potential):
    """Enter the ``potential`` in J of a step that is not committed; return it."""
    sums = evaluation.sums[0]
    sums.potential, sums.dissipated = potential, 0.0
    return potential


@jit_exact
def travel(problem, dx):
    """Return the longest move of a node in ``dx``, m, at most the longest that lists may cover."""
    return min(problem.longest(dx), problem.scene.contact.most_move)


@jit_exact
def covers(problem, x, far):
    """Return whether the pair list holds for moves of all nodes by at most ``far`` m from ``x``."""
    return 2.0 * (problem.drift(x) + far) <= problem.neighbours.margin


@jit_exact
def listed_share(problem, dx, far):
    """Return the share of ``dx``, at most 1, that lists may cover, and the longest move of a node
    in the whole of ``dx``, m. far: `travel` of ``dx``, m.
    """
    if far < problem.scene.contact.most_move:
        return 1.0, far
    far = problem.longest(dx)
    return min(1.0, problem.scene.contact.most_move / far), far
