"""Walls as geometrically exact Reissner-Mindlin shells: quads of four nodes with directors.

Node i has the coordinates x[6 i] .. x[6 i + 2], its position, and x[6 i + 3] .. x[6 i + 5], its
rotation w since the last commit; its frame Q is a row of ``frames`` (n, 9). At corner a of element
e, the director is d = Q R(w) v, with v = directors[e, a] (`rotation`). Walls that meet along a line
share its nodes, each with directors of its own, so that a joint needs no constraint.

In an element with sides of the lengths h_s and h_z at rest, x and d are bilinear in the coordinates
s and z along the sides. In a flat rectangle s and z are arc lengths; in any other quad the measures
are turned from (s, z) to axes that are orthonormal at rest (`axes`). With p = (x,s; d,s; x,z; d,z)
at a Gauss point each strain measure of `layers` is p . M_k p / 2, so that an energy U of the
measures m has

    dU/dp = R p,   d2U/dp2 = R + sum over k, l of (M_k p) d2U/dm_k dm_l (M_l p)

                       | 2 U_A11   U_B11     U_A12     U_B12 / 2 |
    R = sum U_k M_k =  | U_B11     2 U_D11   U_B12 / 2 U_D12     |   (times the identity of space)
                       | U_A12     U_B12 / 2 2 U_A22   U_B22     |
                       | U_B12 / 2 U_D12     U_B22     2 U_D22   |

and p = sum over the corners a of (N_a,s q_a; N_a,z q_a), q_a = (x_a; d_a), gives the derivatives in
q. The energy of the element is summed over 2 x 2 Gauss points, transverse shear (`shear`) is added,
and the chain rule through d(w) follows last.
"""

import math
from typing import NamedTuple

import numpy as np

from kernels.compile.jit import jit, jit_exact, jit_owning
from kernels.plates.element import axes, bow, fold, layers, relaxing_shear, rotation, shear

GAUSS = math.sqrt(1.0 / 3.0)
POINTS = ((-GAUSS, -GAUSS), (GAUSS, -GAUSS), (GAUSS, GAUSS), (-GAUSS, GAUSS))
MEASURES_OF = ((0, 2, 3, 5), (3, 5, 6, 8), (1, 2, 4, 5), (4, 5, 7, 8))  # by x,s; d,s; x,z; d,z
CORNERS = ((-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0))
POINTS_OF_LAYERS = 4 * layers.LAYERS  # material points of an element; all points of shear follow


class Shell(NamedTuple):
    """quads (m, 4): nodes (s0 z0), (s1 z0), (s1 z1), (s0 z1). size (m, 2): h_s, h_z in m, means of
    two sides.

    thickness (m,) in m. directors (m, 4, 3): at rest, in the frames of the nodes. At rest, at the
    Gauss points, in the order of the corners: rest (m, 4, 9), measures less the measures of a flat
    rectangle; area (m, 4), m^2; axes (m, 4, 3): a, b, c of `axes`; layered (m, 4, REST):
    curvatures, `layers.set_rest`. If all quads are flat rectangles, these are (0, 4, 3) and (1, 4,
    0). shear_rest (m, 4): shear of the edges at rest, see `shear`. sheared (m,): area for
    `shear.stiffnesses`, m^2. corners (m, 4): area of the sides at each corner, m^2, for `fold`.
    shear_modulus: instantaneous kappa G, Pa. fold_modulus: kappa G at the reference time of a
    material that relaxes.
    """

    quads: np.ndarray
    size: np.ndarray
    thickness: np.ndarray
    directors: np.ndarray
    rest: np.ndarray
    area: np.ndarray
    axes: np.ndarray
    layered: np.ndarray
    shear_rest: np.ndarray
    sheared: np.ndarray
    corners: np.ndarray
    shear_modulus: float
    fold_modulus: float


def rectangles(quads, size, thickness, directors, shear_modulus, fold_modulus):
    """Return the `Shell` of flat rectangles, without stress where they are flat."""
    m, whole = len(quads), size[:, 0] * size[:, 1]
    return Shell(
        quads, size, thickness, directors, np.zeros((m, 4, 9)),
        np.repeat(0.25 * whole[:, None], 4, axis=1), np.empty((0, 4, 3)),
        np.empty((1, 4, 0)), np.zeros((m, 4)), whole,
        np.repeat(whole[:, None], 4, axis=1), shear_modulus, fold_modulus,
    )  # fmt: skip


def curved(x, frames, quads, size, thickness, directors, shear_modulus, fold_modulus):
    """Return the `Shell` of any quads, without stress at ``x`` (n,).

    frames (n_nodes, 9): of the nodes.
    """
    walls = rectangles(quads, size, thickness, directors, shear_modulus, fold_modulus)
    m = len(quads)
    walls = walls._replace(axes=np.zeros((m, 4, 3)), layered=np.zeros((m, 4, layers.REST)))
    scratch = make_scratch()
    measure_rest(x, frames, walls, scratch)
    measure_axes(x, frames, walls, scratch)
    return walls


class Scratch(NamedTuple):
    """Arrays of one element.

    q, slope (24,): of the corners, and the gradient in q. At a Gauss point: p (12,); measure,
    resultant (9,); rigidity (9, 9); moments; rows (9, 12): M_k p; pushed (9, 12): rigidity x rows;
    by_p (12, 12): d2U/dp2. half (48, 24): by_p x dp/dq of all points. grid (4, 4, 2): N_a,s and
    N_a,z by point and corner. For shear, see `shear.hessian`: edges, strained (7, 24), inner (7,
    7). row (24,): for `fold`. turn (4, 3, 3): dd/dw of the corners.
    """

    q: np.ndarray
    slope: np.ndarray
    p: np.ndarray
    measure: np.ndarray
    resultant: np.ndarray
    rigidity: np.ndarray
    moments: layers.Moments
    rows: np.ndarray
    pushed: np.ndarray
    by_p: np.ndarray
    half: np.ndarray
    grid: np.ndarray
    edges: np.ndarray
    row: np.ndarray
    strained: np.ndarray
    inner: np.ndarray
    turn: np.ndarray


@jit_owning
def make_scratch():
    """Return a `Scratch`, one for each thread."""
    return Scratch(
        np.zeros(24), np.zeros(24), np.zeros(12), np.zeros(9), np.zeros(9), np.zeros((9, 9)),
        layers.make_moments(), np.zeros((9, 12)), np.zeros((9, 12)), np.zeros((12, 12)),
        np.zeros((48, 24)), np.zeros((4, 4, 2)), np.zeros((shear.NUMBERS, 24)), np.zeros(24),
        np.zeros((shear.NUMBERS, 24)), np.zeros((shear.NUMBERS, shear.NUMBERS)),
        np.zeros((4, 3, 3)),
    )  # fmt: skip


@jit
def _rotation_of(x, node):
    """Return w of a node."""
    return x[6 * node + 3], x[6 * node + 4], x[6 * node + 5]


@jit
def _rest_director(shell, e, a):
    """Return v of a corner."""
    return shell.directors[e, a, 0], shell.directors[e, a, 1], shell.directors[e, a, 2]


@jit
def _gather(x, frames, shell, e, q):
    """Set q to the positions and directors of the corners of element ``e``."""
    for a in range(4):
        i = shell.quads[e, a]
        d = rotation.director(frames[i], _rotation_of(x, i), _rest_director(shell, e, a))
        for c in range(3):
            q[6 * a + c], q[6 * a + 3 + c] = x[6 * i + c], d[c]


@jit
def _differentiate(size, grid):
    """Fill ``grid`` with N_a,s and N_a,z at the Gauss points."""
    for g in range(4):
        for a in range(4):
            s, z = CORNERS[a][0], CORNERS[a][1]
            grid[g, a, 0] = 0.5 * s * (1.0 + z * POINTS[g][1]) / size[0]
            grid[g, a, 1] = 0.5 * z * (1.0 + s * POINTS[g][0]) / size[1]


@jit
def _derive(q, grid, p):
    """Set p = (x,s; d,s; x,z; d,z) at a Gauss point; grid (4, 2)."""
    for k in range(6):
        along, up = 0.0, 0.0
        for a in range(4):
            along += grid[a, 0] * q[6 * a + k]
            up += grid[a, 1] * q[6 * a + k]
        p[k], p[6 + k] = along, up


@jit
def _dot(p, i, k):
    """Return the product of parts ``i`` and ``k`` of p."""
    return p[3 * i] * p[3 * k] + p[3 * i + 1] * p[3 * k + 1] + p[3 * i + 2] * p[3 * k + 2]


@jit
def _measure(p, m):
    """Set the measures of p less the measures of the flat grid."""
    m[0], m[1], m[2] = _dot(p, 0, 0) - 1.0, _dot(p, 2, 2) - 1.0, _dot(p, 0, 2)
    m[3], m[4], m[5] = _dot(p, 0, 1), _dot(p, 2, 3), 0.5 * (_dot(p, 0, 3) + _dot(p, 2, 1))
    m[6], m[7], m[8] = _dot(p, 1, 1), _dot(p, 3, 3), _dot(p, 1, 3)


@jit
def _strain(scratch, shell, e, g):
    """Set the measures of Gauss point ``g``: of arcs, less their values at rest, in orthonormal
    axes.

    Return the measures of chords that the derivatives of `bow` need.
    """
    _derive(scratch.q, scratch.grid[g], scratch.p)
    _measure(scratch.p, scratch.measure)
    for k in range(9):
        scratch.measure[k] -= shell.rest[e, g, k]
    chords = bow.lengthen(shell.size[e], shell.rest[e, g], scratch.measure)
    if shell.axes.shape[0] > 0:
        axes.turn(shell.axes[e, g], scratch.measure)
    return chords


@jit_exact
def measure_rest(x, frames, shell, scratch):
    """Make ``x`` the shape without stress: fill ``rest`` and ``shear_rest`` of the shell."""
    for e in range(shell.quads.shape[0]):
        _gather(x, frames, shell, e, scratch.q)
        _differentiate(shell.size[e], scratch.grid)
        for g in range(4):
            _derive(scratch.q, scratch.grid[g], scratch.p)
            _measure(scratch.p, shell.rest[e, g])
        for edge in range(4):
            length = shell.size[e, edge // 2]
            shell.shear_rest[e, edge] = shear.strain(scratch.q, shear.EDGES[edge], length)


@jit_exact
def measure_axes(x, frames, shell, scratch):
    """Set axes and areas at rest of quads of any shape, after `measure_rest` at ``x``."""
    for e in range(shell.quads.shape[0]):
        rest, whole = shell.rest[e], 0.25 * shell.size[e, 0] * shell.size[e, 1]
        shell.sheared[e] = 0.0
        for g in range(4):
            a, b, c, area = axes.orthonormal(1.0 + rest[g, 0], 1.0 + rest[g, 1], rest[g, 2])
            shell.axes[e, g, 0], shell.axes[e, g, 1], shell.axes[e, g, 2] = a, b, c
            shell.area[e, g] = area * whole
            m = scratch.measure
            for k in range(9):
                m[k] = rest[g, k]
            bow.lengthen_rest(shell.size[e], m)
            axes.turn(shell.axes[e, g], m)
            layers.set_rest(m[3:6], m[6:9], shell.thickness[e], shell.layered[e, g])
            shell.sheared[e] += area * area * area * whole
        _gather(x, frames, shell, e, scratch.q)
        for a in range(4):
            shell.corners[e, a] = fold.area(scratch.q, a)


@jit
def _row(shell, e):
    """Return the row of ``layered`` of element ``e``."""
    return e if shell.axes.shape[0] > 0 else 0


@jit_exact
def thickening(x, frames, shell, e, scratch):
    """Return the mean of j (`layers`) at the Gauss points of element ``e``."""
    total = 0.0
    _gather(x, frames, shell, e, scratch.q)
    _differentiate(shell.size[e], scratch.grid)
    for g in range(4):
        _strain(scratch, shell, e, g)
        total += layers.thickening(scratch.measure)
    return 0.25 * total


@jit
def _matrix(u):
    """Return the upper triangle of R, row by row, for the slopes ``u`` (9,) in the measures."""
    return (
        2.0 * u[0], u[3], u[2], 0.5 * u[5], 2.0 * u[6], 0.5 * u[5], u[8], 2.0 * u[1], u[4],
        2.0 * u[7],
    )  # fmt: skip


@jit
def _add_slopes(scratch, g, area):
    """Add ``area`` (R p) dp/dq to the slopes in q."""
    r, p = _matrix(scratch.resultant), scratch.p
    for c in range(3):
        xs, ds, xz, dz = area * p[c], area * p[3 + c], area * p[6 + c], area * p[9 + c]
        force_s = r[0] * xs + r[1] * ds + r[2] * xz + r[3] * dz
        moment_s = r[1] * xs + r[4] * ds + r[5] * xz + r[6] * dz
        force_z = r[2] * xs + r[5] * ds + r[7] * xz + r[8] * dz
        moment_z = r[3] * xs + r[6] * ds + r[8] * xz + r[9] * dz
        for a in range(4):
            s, z = scratch.grid[g, a, 0], scratch.grid[g, a, 1]
            scratch.slope[6 * a + c] += s * force_s + z * force_z
            scratch.slope[6 * a + 3 + c] += s * moment_s + z * moment_z


@jit
def _scatter(x, frames, shell, e, slope, gradient):
    """Add the slopes in q of an element to the gradient by coordinate."""
    for a in range(4):
        i = shell.quads[e, a]
        g = slope[6 * a + 3], slope[6 * a + 4], slope[6 * a + 5]
        turn = rotation.moment(frames[i], _rotation_of(x, i), _rest_director(shell, e, a), g)
        for c in range(3):
            gradient[6 * i + c] += slope[6 * a + c]
            gradient[6 * i + 3 + c] += turn[c]


@jit
def _shear_stiffness(shell, e):
    """Return the instantaneous shear stiffnesses of an element."""
    return shear.stiffnesses(
        shell.shear_modulus, shell.thickness[e], shell.size[e], shell.sheared[e]
    )


@jit
def _shear_at(shell, law, memory, e):
    """Return the shears at rest of the edges of an element, its stiffnesses in shear, and the
    constant of its energy, all for the present step.
    """
    stiffness = _shear_stiffness(shell, e)
    if law.shares.size == 0:
        rest = shell.shear_rest[e]
        return (rest[0], rest[1], rest[2], rest[3]), stiffness, 0.0
    row = POINTS_OF_LAYERS * shell.quads.shape[0] + e
    return relaxing_shear.of_step(memory, row, stiffness)


@jit_exact
def begin(x, frames, shell, law, memory, scratch):
    """Set the data of all material points for a step from ``x``, at the pace of ``memory``."""
    m = shell.quads.shape[0]
    for point in range(POINTS_OF_LAYERS * m):
        law.begin(memory, point)
    for e in range(m):
        _gather(x, frames, shell, e, scratch.q)
        surface = shear.surface(scratch.q, shell.size[e])
        stiffness = _shear_stiffness(shell, e)
        row, rest = POINTS_OF_LAYERS * m + e, shell.shear_rest[e]
        relaxing_shear.begin(law, memory, row, rest, surface, stiffness)


@jit_exact
def _commit_shear(shell, law, memory, e, q):
    """Accept the shears of an element; return potential less stored energy, and dissipation, J."""
    size, m = shell.size[e], shell.quads.shape[0]
    stiffness = _shear_stiffness(shell, e)
    rest, soft, constant = _shear_at(shell, law, memory, e)
    surface, row = shear.surface(q, size), POINTS_OF_LAYERS * m + e
    potential = shear.energy(shear.strains(q, size, rest), surface, soft) + constant
    g = shear.strains(q, size, shell.shear_rest[e])
    stored, dissipated = relaxing_shear.commit(law, g, memory, row, surface, stiffness)
    return potential - stored, dissipated


@jit_exact
def commit(x, frames, shell, law, memory, scratch, released):
    """Accept ``x`` at all material points; return the dissipation of the step in J.

    released (3,): potential less stored energy, in the parts of `evaluate`.
    """
    dissipated = 0.0
    for k in range(3):
        released[k] = 0.0
    for e in range(shell.quads.shape[0]):
        _gather(x, frames, shell, e, scratch.q)
        _differentiate(shell.size[e], scratch.grid)
        for g in range(4):
            _strain(scratch, shell, e, g)
            area = shell.area[e, g]
            point = POINTS_OF_LAYERS * e + layers.LAYERS * g
            release, of_middle, dissipation = layers.commit(
                law, scratch.measure, shell.layered[_row(shell, e), g], shell.thickness[e], memory,
                point,
            )  # fmt: skip
            released[0] += area * of_middle
            released[1] += area * (release - of_middle)
            dissipated += area * dissipation
        release, dissipation = _commit_shear(shell, law, memory, e, scratch.q)
        released[2] += release
        dissipated += dissipation
    return dissipated


@jit
def evaluate(x, frames, shell, law, memory, scratch, gradient, stored):
    """Return the energy in J, infinite where a layer has no area left or a director is turned over;
    add its slopes to ``gradient`` (n,) and its parts to ``stored`` (3,): membrane, bending, shear.

    law: `kernels.laws.relaxing_sheet.RelaxingSheet`, with a memory of the points of the layers of
    all quads, then of the shear of all quads. Membrane is the energy of the strain of the
    mid-surface alone, bending the remainder of the layers. If the energy is infinite, all results
    are incomplete.
    """
    total = 0.0
    for e in range(shell.quads.shape[0]):
        size, thickness = shell.size[e], shell.thickness[e]
        _gather(x, frames, shell, e, scratch.q)
        if fold.is_folded(scratch.q):
            return math.inf
        _differentiate(size, scratch.grid)
        scratch.slope[:] = 0.0
        rest, stiffness, constant = _shear_at(shell, law, memory, e)
        sheared = shear.evaluate(scratch.q, size, rest, stiffness, scratch.slope) + constant
        if math.isinf(sheared):
            return math.inf
        sheared += fold.evaluate(
            scratch.q, shell.corners[e], shell.area[e], shell.fold_modulus * thickness,
            scratch.slope,
        )  # fmt: skip
        total += sheared
        stored[2] += sheared
        for g in range(4):
            chords, area = _strain(scratch, shell, e, g), shell.area[e, g]
            point = POINTS_OF_LAYERS * e + layers.LAYERS * g
            value, middle = layers.resultants(
                law, scratch.measure, shell.layered[_row(shell, e), g], thickness, memory, point,
                scratch.resultant,
            )  # fmt: skip
            if math.isinf(value):
                return math.inf
            total += area * value
            stored[0] += area * middle
            stored[1] += area * (value - middle)
            if shell.axes.shape[0] > 0:
                axes.pull_back(shell.axes[e, g], scratch.resultant)
            bow.pull_back(size, chords, scratch.resultant)
            _add_slopes(scratch, g, area)
        _scatter(x, frames, shell, e, scratch.slope, gradient)
    return total


@jit
def _differentiate_measures(p, rows):
    """Fill the rows M_k p; entries that are always zero are not written."""
    for c in range(3):
        xs, ds, xz, dz = p[c], p[3 + c], p[6 + c], p[9 + c]
        rows[0, c] = 2.0 * xs
        rows[1, 6 + c] = 2.0 * xz
        rows[2, c], rows[2, 6 + c] = xz, xs
        rows[3, c], rows[3, 3 + c] = ds, xs
        rows[4, 6 + c], rows[4, 9 + c] = dz, xz
        rows[5, c], rows[5, 3 + c], rows[5, 6 + c], rows[5, 9 + c] = (
            0.5 * dz, 0.5 * xz, 0.5 * ds, 0.5 * xs,
        )  # fmt: skip
        rows[6, 3 + c] = 2.0 * ds
        rows[7, 9 + c] = 2.0 * dz
        rows[8, 3 + c], rows[8, 9 + c] = dz, ds


@jit
def _by_p(scratch, area):
    """Fill ``by_p`` with ``area`` d2U/dp2."""
    rows, pushed, by_p, second = scratch.rows, scratch.pushed, scratch.by_p, scratch.rigidity
    _differentiate_measures(scratch.p, rows)
    for i in range(12):
        a, b, c, d = MEASURES_OF[i // 3]
        one, two, three, four = rows[a, i], rows[b, i], rows[c, i], rows[d, i]
        for k in range(9):
            pushed[k, i] = area * (
                second[k, a] * one + second[k, b] * two + second[k, c] * three + second[k, d] * four
            )
    for i in range(12):
        a, b, c, d = MEASURES_OF[i // 3]
        one, two, three, four = rows[a, i], rows[b, i], rows[c, i], rows[d, i]
        for k in range(12):
            by_p[i, k] = (
                one * pushed[a, k] + two * pushed[b, k] + three * pushed[c, k] + four * pushed[d, k]
            )
    r, at = _matrix(scratch.resultant), 0
    for i in range(4):
        for k in range(i, 4):
            for c in range(3):
                by_p[3 * i + c, 3 * k + c] += area * r[at]
                if k > i:
                    by_p[3 * k + c, 3 * i + c] += area * r[at]
            at += 1


@jit
def _half(scratch, g):
    """Fill the rows of Gauss point ``g`` in ``half``: by_p dp/dq."""
    for i in range(12):
        for a in range(4):
            s, z = scratch.grid[g, a, 0], scratch.grid[g, a, 1]
            for k in range(6):
                scratch.half[12 * g + i, 6 * a + k] = (
                    s * scratch.by_p[i, k] + z * scratch.by_p[i, 6 + k]
                )


@jit
def _whole(scratch, second):
    """Add (dp/dq)^T half, summed over the Gauss points, to ``second`` (24, 24)."""
    half, grid = scratch.half, scratch.grid
    for a in range(4):
        for k in range(6):
            for c in range(24):
                total = 0.0
                for g in range(4):
                    total += grid[g, a, 0] * half[12 * g + k, c]
                    total += grid[g, a, 1] * half[12 * g + 6 + k, c]
                second[6 * a + k, c] += total


@jit
def _turn_back(x, frames, shell, e, scratch, second):
    """Transform the Hessian in q to the Hessian by coordinate: the chain rule through d(w)."""
    for a in range(4):
        i, at = shell.quads[e, a], 6 * a + 3
        frame, w, v = frames[i], _rotation_of(x, i), _rest_director(shell, e, a)
        turn = scratch.turn[a]
        for k in range(3):
            d = rotation.slope(frame, w, v, k)
            turn[0, k], turn[1, k], turn[2, k] = d[0], d[1], d[2]
        for row in range(24):
            one, two, three = second[row, at], second[row, at + 1], second[row, at + 2]
            for k in range(3):
                second[row, at + k] = one * turn[0, k] + two * turn[1, k] + three * turn[2, k]
        for k in range(24):
            one, two, three = second[at, k], second[at + 1, k], second[at + 2, k]
            for row in range(3):
                second[at + row, k] = turn[0, row] * one + turn[1, row] * two + turn[2, row] * three
        slope = scratch.slope
        own = rotation.moment_slopes(frame, w, v, (slope[at], slope[at + 1], slope[at + 2]))
        n = 0
        for k in range(3):
            for m in range(k, 3):
                second[at + k, at + m] += own[n]
                if m > k:
                    second[at + m, at + k] += own[n]
                n += 1


@jit
def hessian(x, frames, shell, law, memory, e, scratch, second):
    """Set ``second`` (24, 24) to the exact Hessian of element ``e`` by coordinate: rows 6 a .. 6 a
    + 5 of corner a. Call it only where the energy is finite.
    """
    size, thickness = shell.size[e], shell.thickness[e]
    _gather(x, frames, shell, e, scratch.q)
    _differentiate(size, scratch.grid)
    scratch.slope[:] = 0.0
    second[:] = 0.0
    rest, stiffness, _ = _shear_at(shell, law, memory, e)
    shear.evaluate(scratch.q, size, rest, stiffness, scratch.slope)
    shear.hessian(
        scratch.q, size, rest, stiffness, scratch.edges, scratch.strained, scratch.inner, second
    )
    corners, areas, folding = shell.corners[e], shell.area[e], shell.fold_modulus * thickness
    fold.evaluate(scratch.q, corners, areas, folding, scratch.slope)
    fold.hessian(scratch.q, corners, areas, folding, scratch.row, second)
    for g in range(4):
        chords, area = _strain(scratch, shell, e, g), shell.area[e, g]
        point = POINTS_OF_LAYERS * e + layers.LAYERS * g
        layers.rigidity(
            law, scratch.measure, shell.layered[_row(shell, e), g], thickness, memory, point,
            scratch.moments, scratch.resultant, scratch.rigidity,
        )  # fmt: skip
        if shell.axes.shape[0] > 0:
            axes.pull_back(shell.axes[e, g], scratch.resultant)
            axes.pull_back_second(shell.axes[e, g], scratch.rigidity)
        bow.pull_back_second(size, chords, scratch.resultant, scratch.rigidity)
        bow.pull_back(size, chords, scratch.resultant)
        _add_slopes(scratch, g, area)
        _by_p(scratch, area)
        _half(scratch, g)
    _whole(scratch, second)
    _turn_back(x, frames, shell, e, scratch, second)
