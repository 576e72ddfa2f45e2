"""Linear system of a step: walls condensed one by one, then the blocks of joints and open walls."""

from kernels.arrays import zero
from kernels.compile.jit import jit, jit_exact
from kernels.linear import block_ldlt, condense, periodic_images
from kernels.linear.analysis import CONDENSED, OPEN, RIGID
from kernels.linear.block_matrix import IMAGE, INNER, add_image


@jit_exact
def _rows(system, w):
    """Return the slice of rows that are the inner unknowns of wall ``w``."""
    return slice(system.row_start[w], system.row_start[w + 1])


@jit
def _scatter(values, target, rows, outer):
    """Add the entries of a wall to the block matrix: ``outer``, and ``rows`` of an open wall."""
    t = 0
    if target.size > 21:
        for k in range(rows.shape[0]):
            for c in range(condense.WIDTH):
                values[target[t]] += rows[k, c]
                t += 1
    for c in range(condense.OUTER):
        for d in range(c + 1):
            values[target[t]] += outer[c, d]
            t += 1


@jit
def _scatter_image(system, layout, w, rows):
    """Add the entries of wall ``w`` with the image of a joint at its end.

    If both ends are one joint, the coupling of their rotations counts twice on the diagonal.
    Entries of an open wall that are zero have no room: they belong to nodes too far apart to
    couple.
    """
    matrix, outer, inner = system.matrix, layout.outer[w], layout.inner[_rows(system, w)]
    for c in range(condense.OUTER):
        is_image = matrix.home[outer[c]] <= IMAGE
        for d in range(c + 1):
            entry = system.outer[c, d]
            if entry != 0.0 and (is_image or matrix.home[outer[d]] <= IMAGE):
                add_image(matrix, outer[c], outer[d], entry, False)
            elif c != d and outer[c] == outer[d]:
                matrix.diagonal[outer[c]] += entry
        if is_image and system.kind[w] == OPEN:
            for k in range(rows.shape[0]):
                entry = rows[k, condense.BAND + c]
                if entry != 0.0:
                    add_image(matrix, inner[k], outer[c], entry, False)


@jit_exact
def factor(system, layout, walls, stiffness, projected, through):
    """Add the walls to the matrix and factor the system.

    Return (failed, pivot): whether there is a negative pivot, and the first one; its place is kept
    for `descend`. through: negative pivots do not stop the factorisation, see `negatives`.
    """
    wall, failed, pivot, home = -1, -1, 0.0, system.matrix.home
    rounded = block_ldlt.CONVEX if projected else block_ldlt.ROUNDED
    if through:
        rounded = block_ldlt.THROUGH
    for w in range(system.kind.size):
        if system.kind[w] == RIGID:
            continue
        span = _rows(system, w)
        rows, own = system.rows[span], system.own[span]
        condense.fill(walls.start[w], walls.start[w + 1], stiffness, rows, system.outer)
        if system.kind[w] == CONDENSED:
            failed, pivot = condense.eliminate(
                rows, layout.inner[span], system.matrix.diagonal, own, system.outer,
                layout.scale, rounded,
            )  # fmt: skip
            if failed >= 0:
                wall = w
                break
        targets = system.target[system.target_start[w] : system.target_start[w + 1]]
        _scatter(system.matrix.values, targets, rows, system.outer)
        if home[layout.outer[w, 3]] <= IMAGE:
            _scatter_image(system, layout, w, rows)
    if failed < 0:
        block_ldlt.add_diagonal(system.matrix, layout.scale)
        failed, pivot = block_ldlt.factor(system.matrix, layout.scale, rounded)
    place = system.place[0]
    place.wall, place.row = wall, failed
    return failed >= 0, pivot


@jit_exact
def negatives(system):
    """Return the number of negative pivots, which is that of negative eigenvalues (Sylvester)."""
    count = block_ldlt.negatives(system.matrix)
    for w in range(system.kind.size):
        if system.kind[w] == CONDENSED:
            for k in range(system.row_start[w], system.row_start[w + 1]):
                count += system.rows[k, 0] < 0.0
    return count


@jit_exact
def _expand(system, layout, b):
    """Copy the solution of the block matrix to ``b`` (n,), then solve the condensed walls."""
    home, vector, joints = system.matrix.home, system.matrix.vector, system.joints
    for c in range(b.size):
        if home[c] >= 0:
            b[c] = vector[home[c]]
        elif home[c] != INNER:
            b[c] = 0.0
    periodic_images.spread(layout.images, b)
    for w in range(system.kind.size):
        if system.kind[w] == CONDENSED:
            span = _rows(system, w)
            rows = system.rows[span]
            for c in range(condense.OUTER):
                joints[c] = b[layout.outer[w, c]]
            condense.backward(rows, layout.inner[span], b, joints, rows.shape[0])
    periodic_images.spread(layout.images, b)


@jit
def solve(system, layout, b):
    """Solve in place for the right side ``b`` (n,), by coordinate; held ones are zero."""
    home, vector, joints = system.matrix.home, system.matrix.vector, system.joints
    periodic_images.collect(layout.images, b)
    for w in range(system.kind.size):
        if system.kind[w] == CONDENSED:
            span = _rows(system, w)
            zero(joints)
            condense.forward(system.rows[span], layout.inner[span], b, joints)
            for c in range(condense.OUTER):
                b[layout.outer[w, c]] += joints[c]
    periodic_images.collect(layout.images, b)
    zero(vector)
    for c in range(b.size):
        if home[c] >= 0:
            vector[home[c]] += b[c]
    block_ldlt.forward(system.matrix)
    block_ldlt.backward(system.matrix, system.matrix.start.size - 1)
    _expand(system, layout, b)


@jit
def descend(system, layout, direction):
    """Fill ``direction`` (n,) with d such that d^T A d is the negative pivot of `factor`."""
    wall, failed = system.place[0].wall, system.place[0].row
    zero(direction)
    if wall >= 0:
        span = _rows(system, wall)
        rows, inner = system.rows[span], layout.inner[span]
        zero(system.joints)
        direction[inner[failed]] = 1.0
        condense.backward(rows, inner, direction, system.joints, failed)
        periodic_images.spread(layout.images, direction)
    else:
        block_ldlt.descend(system.matrix, failed)
        _expand(system, layout, direction)
