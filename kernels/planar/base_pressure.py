"""Forces of a lattice on its base, node by node, and the patch of the base with the greatest force.

A node of a row that is glued to the base, or held there, presses on it with the gradient of the
step, including the inertia of the node; a loose node with its contact force. The force acts evenly
over the thickness t of the wall, from x - t / 2 to x + t / 2. A patch is a window of a given width
w that slides along x; the force on it is piecewise linear in its centre, with knots at x +- (w + t)
/ 2 and x +- |w - t| / 2 of each node. The greatest force is therefore at a knot, also where a glued
row pulls at the base.
"""

import numpy as np

from kernels.compile.jit import jit_exact
from kernels.shared import rows
from kernels.terms.contact import platen_force


@jit_exact
def force_on_base(problem, x, evaluation, p):
    """Return the force of node ``p`` on the base, N, positive in compression."""
    scene, y = problem.scene, 2 * p + 1
    if scene.layout.leader[y] != y:
        return evaluation.g[y]
    return platen_force(scene.contact, p, x[y] - x[scene.contact.low])


@jit_exact
def sort_along(x, nodes):
    """Sort ``nodes`` (k,) by their x, by insertion: few nodes change places from row to row."""
    for k in range(1, nodes.size):
        p, i = nodes[k], k
        while i > 0 and x[2 * nodes[i - 1]] > x[2 * p]:
            nodes[i] = nodes[i - 1]
            i -= 1
        nodes[i] = p


@jit_exact
def _overlap(x, thickness, centre, width):
    """Return the length of a wall at ``x`` on a patch round ``centre``, at least 0, and the middle
    of that length, all in m.
    """
    low = max(x - 0.5 * thickness, centre - 0.5 * width)
    high = min(x + 0.5 * thickness, centre + 0.5 * width)
    return max(high - low, 0.0), 0.5 * (low + high)


@jit_exact
def _gather(problem, x, evaluation, nodes, pressing):
    """Fill ``pressing`` (k, 3) with x, thickness and force of the ``nodes`` (k,) that exert a
    force, sorted by x; return their number and the greatest thickness.
    """
    thickness, count, thickest = problem.scene.contact.node_thickness, 0, 0.0
    sort_along(x, nodes)
    for p in nodes:
        force = force_on_base(problem, x, evaluation, p)
        if force != 0.0:
            pressing[count, 0] = x[2 * p]
            pressing[count, 1] = thickness[p]
            pressing[count, 2] = force
            count, thickest = count + 1, max(thickest, thickness[p])
    return count, thickest


@jit_exact
def _on_patch(pressing, first, centre, width, reach):
    """Return the force on a patch round ``centre`` and its moment about x = 0.

    Rows of ``pressing`` before ``first`` are skipped.
    """
    force, moment = 0.0, 0.0
    for i in range(first, len(pressing)):
        at, thickness = pressing[i, 0], pressing[i, 1]
        if at > centre + reach:
            break
        length, middle = _overlap(at, thickness, centre, width)
        part = length / thickness * pressing[i, 2]
        force += part
        moment += part * middle
    return force, moment


@jit_exact
def greatest_on_patch(problem, x, evaluation, nodes, pressing, width):
    """Return the greatest force (N) of ``nodes`` (k,) on a patch of ``width`` m, at least 0, and
    the centre of the forces on it, x in m; NaN without a force. pressing (k, 3): scratch.
    """
    count, thickest = _gather(problem, x, evaluation, nodes, pressing)
    pressing, greatest, at, first = pressing[:count], 0.0, np.nan, 0
    for k in range(count):
        place, thickness = pressing[k, 0], pressing[k, 1]
        while pressing[first, 0] < place - width - thickest:
            first += 1
        for side in (-0.5, 0.5):
            for span in (width + thickness, abs(width - thickness)):
                centre, reach = place + side * span, 0.5 * (width + thickest)
                force, moment = _on_patch(pressing, first, centre, width, reach)
                if force > greatest:
                    greatest, at = force, moment / force
    return greatest, at


@jit_exact
def write(problem, out, k, state, evaluation):
    """Write row ``k`` of the history as `rows.write` does, and its greatest force on a patch."""
    rows.write(problem, out, k, state, evaluation)
    row = out.rows[k]
    row.patch_force, row.patch_at = greatest_on_patch(
        problem, state.x, evaluation, out.standing, out.pressing, out.patch
    )
