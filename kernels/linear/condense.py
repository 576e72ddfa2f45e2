"""Static condensation: eliminates the inner unknowns of a wall.

Each node has three unknowns x, y, phi and couples with the next node only. Row k of a wall holds
the entries (k, k) .. (k, k + 5) of the inner nodes, then those with the unknowns of the joints:

    [ band 6 | x_a y_a phi_a x_b y_b phi_b ]

After `eliminate` it holds the row of D L^T, with 1 / pivot as its first entry. Only the last node
couples with the second joint: the rows before it have zeros there.
"""

from kernels.arrays import zero_rows
from kernels.compile.jit import jit, jit_exact
from kernels.linear.block_ldlt import THROUGH, regularised

NODE, BAND, WIDTH, OUTER = 3, 6, 12, 6


@jit
def _node(rows, i, xx, xy, yy, xf, yf, ff):
    """Add the 3 x 3 block of the inner node whose first row is ``i``."""
    rows[i, 0] += xx
    rows[i, 1] += xy
    rows[i, 2] += xf
    rows[i + 1, 0] += yy
    rows[i + 1, 1] += yf
    rows[i + 2, 0] += ff


@jit
def _joint(outer, i, xx, xy, yy, xf, yf, ff):
    """Add the 3 x 3 block of the joint whose first unknown is ``i``."""
    outer[i, i] += xx
    outer[i + 1, i] += xy
    outer[i + 1, i + 1] += yy
    outer[i + 2, i] += xf
    outer[i + 2, i + 1] += yf
    outer[i + 2, i + 2] += ff


@jit
def _couple(rows, outer, q, n, block):
    """Add the ``block`` of unknowns of both ends of element ``q`` of ``n``, row by row."""
    for r in range(NODE):
        for c in range(NODE):
            value = block[NODE * r + c]
            if 0 < q < n - 1:
                rows[NODE * (q - 1) + r, NODE + c - r] += value
            elif n == 1:
                outer[NODE + c, r] += value
            elif q == 0:
                rows[c, BAND + r] += value
            else:
                rows[NODE * (q - 1) + r, BAND + NODE + c] += value


@jit
def fill(first, last, stiffness, rows, outer):
    """Write the Hessian of the wall of elements ``first`` .. ``last`` into ``rows`` (m, 12) and
    ``outer`` (6, 6), lower half.
    """
    own, lean, twist, n = stiffness.own, stiffness.lean, stiffness.twist, last - first
    zero_rows(rows)
    zero_rows(outer)
    for q in range(n):
        k = first + q
        xx, xy, yy = own[0, k], own[1, k], own[2, k]
        ax, ay, bx, by = lean[0, k], lean[1, k], lean[2, k], lean[3, k]
        if q == 0:
            _joint(outer, 0, xx, xy, yy, -ax, -ay, twist[0, k])
        else:
            _node(rows, NODE * (q - 1), xx, xy, yy, -ax, -ay, twist[0, k])
        if q == n - 1:
            _joint(outer, NODE, xx, xy, yy, bx, by, twist[2, k])
        else:
            _node(rows, NODE * q, xx, xy, yy, bx, by, twist[2, k])
        _couple(rows, outer, q, n, (-xx, -xy, -bx, -xy, -yy, -by, ax, ay, twist[1, k]))


@jit
def _reach(k, m):
    """Return how many inner unknowns row ``k`` couples with, and how many of the joints."""
    inner = BAND - k % NODE
    return min(inner, m - k), (OUTER if k >= m - NODE else NODE)


@jit
def _reduce(rows, k, m, inverse, outer):
    """Subtract the update of row ``k`` from the rows after it and from the joints."""
    inner, joints = _reach(k, m)
    for i in range(1, inner):
        factor = rows[k, i] * inverse
        for j in range(i, inner):
            rows[k + i, j - i] -= factor * rows[k, j]
        for c in range(BAND, BAND + joints):
            rows[k + i, c] -= factor * rows[k, c]
    for c in range(joints):
        factor = rows[k, BAND + c] * inverse
        for d in range(c + 1):
            outer[c, d] -= factor * rows[k, BAND + d]


@jit_exact
def eliminate(rows, dofs, diagonal, own, outer, scale, rounded):
    """Eliminate all rows (m, 12) in place, with entries of ``diagonal`` (n,) added to them.

    Return (failed, pivot): row of the first negative pivot, -1 if none. dofs (m,): coordinates of
    the rows. own (m,): filled with the diagonal before elimination. scale (3,), rounded: as
    in `block_ldlt.regularised`.
    """
    m = rows.shape[0]
    for k in range(m):
        rows[k, 0] += diagonal[dofs[k]]
        own[k] = rows[k, 0]
    for k in range(m):
        pivot = regularised(rows[k, 0], own[k], scale[k % NODE], rounded)
        if not (pivot > 0.0 or rounded == THROUGH):
            return k, pivot
        rows[k, 0] = 1.0 / pivot
        _reduce(rows, k, m, rows[k, 0], outer)
    return -1, 0.0


@jit
def forward(rows, dofs, b, joints):
    """Forward substitution: condense the right side, entries ``dofs`` (m,) of ``b`` (n,), onto
    ``joints`` (6,).
    """
    m = rows.shape[0]
    for k in range(m):
        inner, outer = _reach(k, m)
        y = b[dofs[k]] * rows[k, 0]
        for i in range(1, inner):
            b[dofs[k + i]] -= rows[k, i] * y
        for c in range(outer):
            joints[c] -= rows[k, BAND + c] * y


@jit
def backward(rows, dofs, b, joints, last):
    """Back substitution for the first ``last`` inner unknowns, given those of ``joints`` (6,)."""
    m = rows.shape[0]
    for k in range(last - 1, -1, -1):
        inner, outer = _reach(k, m)
        total = b[dofs[k]]
        for i in range(1, inner):
            total -= rows[k, i] * b[dofs[k + i]]
        for c in range(outer):
            total -= rows[k, BAND + c] * joints[c]
        b[dofs[k]] = total * rows[k, 0]
