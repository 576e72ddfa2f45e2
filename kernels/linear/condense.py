"""Static condensation: eliminates the inner unknowns of a wall.

An inner node has two unknowns and couples with the next two nodes at most; each of the two joints
has three. Row k of a wall holds entries (k, k) .. (k, k + 5), then those with the unknowns of the
joints:

    [ band 6 | x_a y_a phi_a x_b y_b phi_b ]

After `eliminate` it holds the row of D L^T, with 1 / pivot as its first entry.
"""

from kernels.arrays import zero_rows
from kernels.compile.jit import jit, jit_exact
from kernels.linear.block_ldlt import THROUGH, regularised

BAND, WIDTH, OUTER = 6, 12, 6


@jit
def _couple(rows, outer, i, j, xx, xy, yx, yy):
    """Add the 2 x 2 block of local points ``i`` <= ``j``; points < 0 are joints: -6 a, -3 b."""
    if i < 0:
        i, j, xy, yx = j, i, yx, xy
    if j >= 0:
        rows[i, j - i] += xx
        rows[i, j - i + 1] += xy
        rows[i + 1, j - i] += yy
        if i != j:
            rows[i + 1, j - i - 1] += yx
    elif i >= 0:
        rows[i, WIDTH + j] += xx
        rows[i, WIDTH + j + 1] += xy
        rows[i + 1, WIDTH + j] += yx
        rows[i + 1, WIDTH + j + 1] += yy
    else:
        i, j = max(i, j) + OUTER, min(i, j) + OUTER
        outer[i, j] += xx
        outer[i + 1, j] += yx
        outer[i + 1, j + 1] += yy
        if i != j:
            outer[i, j + 1] += xy


@jit
def fill(first, last, w, stiffness, rows, outer):
    """Write the Hessian of wall ``w``, elements ``first`` .. ``last``, into ``rows`` (m, 12) and
    ``outer`` (6, 6), lower half.
    """
    own, following = stiffness.own, stiffness.next
    n = last - first
    zero_rows(rows)
    zero_rows(outer)
    for q in range(n + 1):
        k = first + q
        xx = xy = yx = yy = 0.0
        if q > 0:
            xx, xy, yy = own[0, k - 1], own[1, k - 1], own[2, k - 1]
        if q < n:
            xx, xy, yy = xx + own[0, k], xy + own[1, k], yy + own[2, k]
        if 0 < q < n:
            xx -= 2.0 * following[0, k - 1]
            xy -= following[1, k - 1] + following[2, k - 1]
            yy -= 2.0 * following[3, k - 1]
        point = -6 if q == 0 else (-3 if q == n else 2 * q - 2)
        _couple(rows, outer, point, point, xx, xy, xy, yy)
        if q == n:
            continue
        xx, xy, yx, yy = -own[0, k], -own[1, k], -own[1, k], -own[2, k]
        if q > 0:
            xx, xy = xx + following[0, k - 1], xy + following[1, k - 1]
            yx, yy = yx + following[2, k - 1], yy + following[3, k - 1]
        if q + 1 < n:
            xx, xy = xx + following[0, k], xy + following[1, k]
            yx, yy = yx + following[2, k], yy + following[3, k]
        other = -3 if q + 1 == n else 2 * q
        _couple(rows, outer, point, other, xx, xy, yx, yy)
        if q + 1 < n:
            other = -3 if q + 2 == n else 2 * q + 2
            xx, xy, yx, yy = following[0, k], following[1, k], following[2, k], following[3, k]
            _couple(rows, outer, point, other, -xx, -xy, -yx, -yy)
    _arms(rows, outer, n, stiffness.arm, w)
    outer[5, 2] += stiffness.twist[w]


@jit
def _arms(rows, outer, n, arm, w):
    """Add the rotations of both joints and their couplings with the elements at the ends."""
    for side, phi in ((0, 2), (1, 5)):
        vx, vy = arm[0, 2 * w + side], arm[1, 2 * w + side]
        outer[phi, phi] += arm[2, 2 * w + side]
        sign = -1.0 if side == 0 else 1.0  # of the joint's own end of the element
        outer[phi, phi - 2] += sign * vx
        outer[phi, phi - 1] += sign * vy
        if n > 1:
            i = 0 if side == 0 else 2 * n - 4
            rows[i, BAND + phi] -= sign * vx
            rows[i + 1, BAND + phi] -= sign * vy
        elif side == 0:
            outer[3, 2] += vx
            outer[4, 2] += vy
        else:
            outer[5, 0] -= vx
            outer[5, 1] -= vy


@jit
def _reduce(rows, k, m, inverse, outer):
    """Subtract the update of row ``k`` from the rows after it and from the joints."""
    for i in range(1, min(BAND, m - k)):
        factor = rows[k, i] * inverse
        for j in range(i, BAND):
            rows[k + i, j - i] -= factor * rows[k, j]
        for c in range(BAND, WIDTH):
            rows[k + i, c] -= factor * rows[k, c]
    for c in range(OUTER):
        factor = rows[k, BAND + c] * inverse
        for d in range(c + 1):
            outer[c, d] -= factor * rows[k, BAND + d]


@jit_exact
def eliminate(rows, diagonal, own, outer, scale, rounded):
    """Eliminate all rows (m, 12) in place, with ``diagonal`` (m,) added to them.

    Return (failed, pivot): row of the first negative pivot, -1 if none. own (m,): filled with the
    diagonal before elimination. rounded: as in `block_ldlt.regularised`.
    """
    m = rows.shape[0]
    for k in range(m):
        rows[k, 0] += diagonal[k]
        own[k] = rows[k, 0]
    for k in range(m):
        pivot = regularised(rows[k, 0], own[k], scale, rounded)
        if not (pivot > 0.0 or rounded == THROUGH):
            return k, pivot
        rows[k, 0] = 1.0 / pivot
        _reduce(rows, k, m, rows[k, 0], outer)
    return -1, 0.0


@jit
def forward(rows, b, joints):
    """Forward substitution: condense the right side ``b`` (m,) onto ``joints`` (6,)."""
    m = rows.shape[0]
    for k in range(m):
        y = b[k] * rows[k, 0]
        for i in range(1, min(BAND, m - k)):
            b[k + i] -= rows[k, i] * y
        for c in range(OUTER):
            joints[c] -= rows[k, BAND + c] * y


@jit
def backward(rows, b, joints, last):
    """Back substitution for the first ``last`` inner unknowns, given those of ``joints`` (6,)."""
    m = rows.shape[0]
    for k in range(last - 1, -1, -1):
        total = b[k]
        for i in range(1, min(BAND, m - k)):
            total -= rows[k, i] * b[k + i]
        for c in range(OUTER):
            total -= rows[k, BAND + c] * joints[c]
        b[k] = total * rows[k, 0]
