"""Linear system of a step: walls condensed four by four, then blocks of joints and open walls."""

from kernels.arrays import zero
from kernels.compile.jit import jit, jit_exact
from kernels.compile.simd import LANES
from kernels.linear.condensed import block_ldlt, condense, periodic_images
from kernels.linear.condensed.block_matrix import IMAGE, INNER, add_image
from kernels.linear.condensed.bundles import CONDENSED, OPEN, rows_of
from kernels.linear.pivots import ROUNDED, THROUGH


@jit
def _scatter(values, scattered, w, rows, outer, lane):
    """Add the entries of wall ``w`` to the block matrix: ``outer``, and ``rows`` of an open one."""
    start, source, target = scattered.start, scattered.source, scattered.target
    for t in range(start[2 * w], start[2 * w + 1]):
        values[target[t]] += rows[source[t] + lane]
    for t in range(start[2 * w + 1], start[2 * w + 2]):
        values[target[t]] += outer[source[t] + lane]


@jit
def _scatter_image(system, layout, w, inner, rows, lane):
    """Add the entries of wall ``w``, one end of which is the image of a joint.

    If both ends are one joint, the coupling of their rotations counts twice on the diagonal.
    Entries of an open wall that are zero have no room: they belong to nodes too far apart to
    couple.
    """
    matrix, outer = system.matrix, layout.outer[w]
    for c in range(condense.OUTER):
        is_image = matrix.home[outer[c]] <= IMAGE
        for d in range(c + 1):
            entry = system.outer[condense.joint_entry(c, d) + lane]
            if entry != 0.0 and (is_image or matrix.home[outer[d]] <= IMAGE):
                add_image(matrix, outer[c], outer[d], entry, False)
            elif c != d and outer[c] == outer[d]:
                matrix.diagonal[outer[c]] += entry
        if is_image and system.kind[w] == OPEN:
            for k in range(inner.size // LANES):
                entry = rows[condense.entry(k, condense.BAND + c) + lane]
                if entry != 0.0:
                    add_image(matrix, inner[LANES * k + lane], outer[c], entry, False)


@jit_exact
def add_walls(system, layout, stiffness, rounded):
    """Add all walls to the block matrix, condensed if they are not open.

    Return (wall, row, pivot) of the first negative pivot in the first wall that has one, wall -1
    if none has; the matrix is then incomplete.
    """
    bundles, matrix, wall, row, pivot = system.bundles, system.matrix, -1, -1, 0.0
    for g in range(bundles.size.size):
        rows, span = system.rows[rows_of(bundles, g, condense.WIDTH)], rows_of(bundles, g, 1)
        inner = bundles.inner[span]
        condense.fill(bundles.first[g], bundles.pieces[g], stiffness, rows, system.outer)
        if system.kind[bundles.wall[g, 0]] == CONDENSED:
            lane, failed, first = condense.eliminate(
                rows, inner, matrix.diagonal, system.own[span], system.outer,
                layout.scale, rounded,
            )  # fmt: skip
            if lane < LANES and (wall < 0 or bundles.wall[g, lane] < wall):
                wall, row, pivot = bundles.wall[g, lane], failed, first
        for lane in range(bundles.size[g]):
            w = bundles.wall[g, lane]
            _scatter(matrix.values, system.scattered, w, rows, system.outer, lane)
            if matrix.home[layout.outer[w, 3]] <= IMAGE:
                _scatter_image(system, layout, w, inner, rows, lane)
    return wall, row, pivot


@jit_exact
def factor(system, layout, stiffness, through):
    """Add the walls to the matrix and factor the system.

    Return (failed, pivot): whether there is a negative pivot, and the first one; its place is kept
    for `descend`. through: negative pivots do not stop the factorisation, see `negatives`.
    """
    rounded, place = THROUGH if through else ROUNDED, system.place[0]
    place.wall, place.row, pivot = add_walls(system, layout, stiffness, rounded)
    if place.wall < 0:
        block_ldlt.add_diagonal(system.matrix, layout.scale)
        place.row, pivot = block_ldlt.factor(system.matrix, layout.scale, rounded)
    return place.row >= 0, pivot


@jit_exact
def negatives(system):
    """Return the number of negative pivots, which equals the number of negative eigenvalues
    (Sylvester).
    """
    count, bundles = block_ldlt.negatives(system.matrix), system.bundles
    for g in range(bundles.size.size):
        if system.kind[bundles.wall[g, 0]] == CONDENSED:
            for k in range(bundles.start[g], bundles.start[g + 1]):
                for lane in range(bundles.size[g]):
                    count += system.rows[condense.entry(k, 0) + lane] < 0.0
    return count


@jit
def _condense(system, b):
    """Condense the right side ``b`` (n,) inside walls onto their joints."""
    bundles, joints = system.bundles, system.joints
    for g in range(bundles.size.size):
        if system.kind[bundles.wall[g, 0]] == CONDENSED:
            span = rows_of(bundles, g, 1)
            inner, inside = bundles.inner[span], system.inside[span]
            for i in range(inner.size):
                inside[i] = b[inner[i]]
            zero(joints)
            condense.forward(system.rows[rows_of(bundles, g, condense.WIDTH)], inside, joints)
            for c in range(0, joints.size, LANES):
                for i in range(c, c + bundles.size[g]):
                    b[bundles.outer[g, i]] += joints[i]


@jit_exact
def _expand(system, layout, b):
    """Copy the solution of the block matrix to ``b`` (n,), then solve the condensed walls."""
    home, vector, bundles = system.matrix.home, system.matrix.vector, system.bundles
    for c in range(b.size):
        if home[c] >= 0:
            b[c] = vector[home[c]]
        elif home[c] != INNER:
            b[c] = 0.0
    periodic_images.spread(layout.images, b)
    for g in range(bundles.size.size):
        if system.kind[bundles.wall[g, 0]] == CONDENSED:
            rows, span = system.rows[rows_of(bundles, g, condense.WIDTH)], rows_of(bundles, g, 1)
            inner, inside = bundles.inner[span], system.inside[span]
            for c in range(system.joints.size):
                system.joints[c] = b[bundles.outer[g, c]]
            condense.backward(rows, inside, system.joints, inner.size // LANES)
            for i in range(inner.size):
                b[inner[i]] = inside[i]
    periodic_images.spread(layout.images, b)


@jit
def solve(system, layout, b):
    """Solve in place for the right side ``b`` (n,), by coordinate; held ones are zero."""
    home, vector = system.matrix.home, system.matrix.vector
    periodic_images.collect(layout.images, b)
    _condense(system, b)
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
    wall, failed, bundles = system.place[0].wall, system.place[0].row, system.bundles
    zero(direction)
    zero(system.inside)
    if wall >= 0:
        g, lane = bundles.place[wall] // LANES, bundles.place[wall] % LANES
        rows, span = system.rows[rows_of(bundles, g, condense.WIDTH)], rows_of(bundles, g, 1)
        inner, inside = bundles.inner[span], system.inside[span]
        zero(system.joints)
        inside[LANES * failed + lane] = 1.0
        condense.backward(rows, inside, system.joints, failed)
        for i in range(lane, inner.size, LANES):
            direction[inner[i]] = inside[i]
        periodic_images.spread(layout.images, direction)
    else:
        block_ldlt.descend(system.matrix, failed)
        _expand(system, layout, direction)
