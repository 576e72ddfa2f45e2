"""Forces of a lattice on its base, node by node, and the patch of the base that is pressed most.

A node of a row that is glued to the base, or held there, presses on it with the gradient of the
step, the inertia of the node included; a loose node with its contact force. A patch is a window of
a given width that slides along x. The sum of the point forces in it changes where one enters or
leaves, and is looked at after each of these events, so that the greatest sum is exact also where a
glued row pulls at the base.
"""

import numpy as np

from kernels.compile.jit import jit_exact
from kernels.shared import rows
from kernels.terms.contact import platen_force


@jit_exact
def force_on_base(problem, x, found, p):
    """Return the force of node ``p`` on the base, N, positive in compression."""
    scene, y = problem.scene, 2 * p + 1
    if scene.layout.leader[y] != y:
        return found.g[y]
    return platen_force(scene.contact, p, x[y] - x[scene.contact.low])


@jit_exact
def sort_along(x, nodes):
    """Sort ``nodes`` (k,) by their x, by insertion: from row to row few of them change places."""
    for k in range(1, nodes.size):
        p, i = nodes[k], k
        while i > 0 and x[2 * nodes[i - 1]] > x[2 * p]:
            nodes[i] = nodes[i - 1]
            i -= 1
        nodes[i] = p


@jit_exact
def greatest_on_patch(problem, x, found, nodes, width):
    """Return the greatest force (N) of ``nodes`` (k,) on a patch of ``width`` m, at least 0, and
    the centre of the forces on it, x in m; NaN without a force.
    """
    sort_along(x, nodes)
    greatest, at, force, moment, first, last = 0.0, np.nan, 0.0, 0.0, 0, 0
    while first < nodes.size:
        enters = last < nodes.size and x[2 * nodes[last]] <= x[2 * nodes[first]] + width
        p = nodes[last] if enters else nodes[first]
        change = force_on_base(problem, x, found, p)
        if enters:
            last += 1
        else:
            change, first = -change, first + 1
        force += change
        moment += change * x[2 * p]
        if force > greatest:
            greatest, at = force, moment / force
    return greatest, at


@jit_exact
def write(problem, out, k, state, found):
    """Write row ``k`` of the history as `rows.write`, and its greatest force on a patch."""
    rows.write(problem, out, k, state, found)
    row = out.rows[k]
    row.patch_force, row.patch_at = greatest_on_patch(
        problem, state.x, found, out.standing, out.patch
    )
