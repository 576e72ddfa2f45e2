"""Static condensation: eliminates the inner unknowns of walls.

Each node has three unknowns x, y, phi and couples with the next node only. Row k of a wall holds
the entries (k, k) .. (k, k + 5) of the inner nodes, then the couplings with the joints:

    [ band 6 | x_a y_a phi_a x_b y_b phi_b ]

After `eliminate` it holds the row of D L^T, with 1 / pivot as its first entry. Only the last node
couples with the second joint: the rows before it have zeros there.

Four walls with the same number of elements are handled together, one in each lane of a vector
(`bundles`): entry c of row k is at `entry`, followed by the same entry of the next wall.
"""

from kernels.arrays import zero
from kernels.compile.jit import jit, jit_exact
from kernels.compile.simd import LANES, collect, exceeds, load, spread, store
from kernels.linear.pivots import THROUGH, ZERO_PIVOT, regularised

NODE, BAND, WIDTH, OUTER = 3, 6, 12, 6


@jit
def entry(k, c):
    """Return the index of entry ``c`` of row ``k`` of the first of four walls."""
    return LANES * (WIDTH * k + c)


@jit
def joint_entry(c, d):
    """Return the index of the entry of the joint unknowns ``c`` >= ``d`` of the first of four
    walls.
    """
    return LANES * (OUTER * c + d)


@jit
def _add(array, at, value):
    """Add ``value`` to four entries."""
    store(array, at, load(array, at) + value)


@jit
def _node(rows, i, block):
    """Add the 3 x 3 ``block`` xx, xy, yy, xf, yf, ff of the inner node of rows ``i`` on."""
    _add(rows, entry(i, 0), block[0])
    _add(rows, entry(i, 1), block[1])
    _add(rows, entry(i, 2), block[3])
    _add(rows, entry(i + 1, 0), block[2])
    _add(rows, entry(i + 1, 1), block[4])
    _add(rows, entry(i + 2, 0), block[5])


@jit
def _joint(outer, i, block):
    """Add the 3 x 3 ``block`` of the joint whose first unknown is ``i``."""
    _add(outer, joint_entry(i, i), block[0])
    _add(outer, joint_entry(i + 1, i), block[1])
    _add(outer, joint_entry(i + 1, i + 1), block[2])
    _add(outer, joint_entry(i + 2, i), block[3])
    _add(outer, joint_entry(i + 2, i + 1), block[4])
    _add(outer, joint_entry(i + 2, i + 2), block[5])


@jit
def _couple(rows, outer, q, n, block):
    """Write the ``block`` of unknowns of both ends of element ``q`` of ``n``, row by row."""
    for r in range(NODE):
        for c in range(NODE):
            value = block[NODE * r + c]
            if 0 < q < n - 1:
                store(rows, entry(NODE * (q - 1) + r, NODE + c - r), value)
            elif n == 1:
                store(outer, joint_entry(NODE + c, r), value)
            elif q == 0:
                store(rows, entry(c, BAND + r), value)
            else:
                store(rows, entry(NODE * (q - 1) + r, BAND + NODE + c), value)


@jit
def fill(first, n, stiffness, rows, outer):
    """Write the Hessian of four walls of ``n`` elements into ``rows`` and the lower half of
    ``outer``. first (4,): the first element of each.
    """
    own, lean, twist, minus = stiffness.own, stiffness.lean, stiffness.twist, spread(-1.0)
    zero(rows)
    zero(outer)
    for q in range(n):
        xx, xy = collect(own[0, q:], first, 0), collect(own[1, q:], first, 0)
        yy, ff = collect(own[2, q:], first, 0), collect(twist[0, q:], first, 0)
        ax, ay = collect(lean[0, q:], first, 0), collect(lean[1, q:], first, 0)
        bx, by = collect(lean[2, q:], first, 0), collect(lean[3, q:], first, 0)
        fg, gg = collect(twist[1, q:], first, 0), collect(twist[2, q:], first, 0)
        left, right = (xx, xy, yy, minus * ax, minus * ay, ff), (xx, xy, yy, bx, by, gg)
        if q == 0:
            _joint(outer, 0, left)
        else:
            _node(rows, NODE * (q - 1), left)
        if q == n - 1:
            _joint(outer, NODE, right)
        else:
            _node(rows, NODE * q, right)
        xx, xy, yy, bx, by = minus * xx, minus * xy, minus * yy, minus * bx, minus * by
        _couple(rows, outer, q, n, (xx, xy, bx, xy, yy, by, ax, ay, fg))


@jit
def _reach(k, m):
    """Return how many inner unknowns and how many joint unknowns row ``k`` couples with."""
    inner = BAND - k % NODE
    return min(inner, m - k), (OUTER if k >= m - NODE else NODE)


@jit
def _reduce(rows, k, m, outer):
    """Subtract the update of row ``k`` from the rows after it and from the joints."""
    inner, joints = _reach(k, m)
    minus = spread(-1.0) * load(rows, entry(k, 0))
    for i in range(1, inner):
        factor = minus * load(rows, entry(k, i))
        for j in range(i, inner):
            _add(rows, entry(k + i, j - i), factor * load(rows, entry(k, j)))
        for c in range(BAND, BAND + joints):
            _add(rows, entry(k + i, c), factor * load(rows, entry(k, c)))
    for c in range(joints):
        factor = minus * load(rows, entry(k, BAND + c))
        for d in range(c + 1):
            _add(outer, joint_entry(c, d), factor * load(rows, entry(k, BAND + d)))


@jit_exact
def _regularise(rows, k, own, scale, rounded, failure):
    """Replace the pivots of row ``k`` that are zero within round-off; return the new ``failure`` of
    `eliminate`.
    """
    for lane in range(LANES):
        at = entry(k, 0) + lane
        pivot = rows[at] = regularised(rows[at], own[LANES * k + lane], scale, rounded)
        if not (pivot > 0.0 or rounded == THROUGH) and lane < failure[0]:
            failure = (lane, k, pivot)
    return failure


@jit_exact
def eliminate(rows, dofs, diagonal, own, outer, scale, rounded):
    """Eliminate all rows in place, with entries of ``diagonal`` (n,) added to them.

    Return (lane, row, pivot): the first wall that fails, with its first negative pivot; lane 4 if
    none does. Entries of a wall that fails are wrong from that row on. dofs (4 m,): coordinates of
    the rows. own (4 m,): filled with the diagonal before elimination. scale (3,), rounded: as in
    `pivots.regularised`.
    """
    m, failure = own.size // LANES, (LANES, -1, 0.0)
    for k in range(m):
        first = load(rows, entry(k, 0)) + collect(diagonal, dofs, LANES * k)
        store(rows, entry(k, 0), first)
        store(own, LANES * k, first)
    one, share = spread(1.0), spread(ZERO_PIVOT)
    for k in range(m):
        least = spread(1e-3 * scale[k % NODE])
        if not exceeds(load(rows, entry(k, 0)), share * (load(own, LANES * k) + least)):
            failure = _regularise(rows, k, own, scale[k % NODE], rounded, failure)
        store(rows, entry(k, 0), one / load(rows, entry(k, 0)))
        _reduce(rows, k, m, outer)
    return failure


@jit
def forward(rows, inside, joints):
    """Forward substitution: condense the right side ``inside`` (4 m,) onto ``joints`` (24,)."""
    m = inside.size // LANES
    for k in range(m):
        inner, outer = _reach(k, m)
        y = load(inside, LANES * k) * load(rows, entry(k, 0))
        for i in range(1, inner):
            at = LANES * (k + i)
            store(inside, at, load(inside, at) - load(rows, entry(k, i)) * y)
        for c in range(outer):
            at = LANES * c
            store(joints, at, load(joints, at) - load(rows, entry(k, BAND + c)) * y)


@jit
def backward(rows, inside, joints, last):
    """Back substitution for the first ``last`` inner unknowns, given the solution at ``joints``
    (24,).
    """
    m = inside.size // LANES
    for k in range(last - 1, -1, -1):
        inner, outer = _reach(k, m)
        total = load(inside, LANES * k)
        for i in range(1, inner):
            total = total - load(rows, entry(k, i)) * load(inside, LANES * (k + i))
        for c in range(outer):
            total = total - load(rows, entry(k, BAND + c)) * load(joints, LANES * c)
        store(inside, LANES * k, total * load(rows, entry(k, 0)))
