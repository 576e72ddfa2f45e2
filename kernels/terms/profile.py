"""Contact of walls with rigid profiles: strikers, and ribs on which a lattice lies.

    E_p = sum_p l_p phi(d(p)) + sum_v w_v [ sum_e phi(d(v, e)) - sum_q (n_q - 1) phi(d(v, q)) ]

d(p): distance of node p from the profile; d(v, e), d(v, q): of vertex v of its chain from element
e, from node q, each less the radius r; n_q: elements at q; phi, t_c = t / 2, l_p: as at a platen
(`contact`). The second sum is for walls that a sharp vertex touches between their nodes: the
trapezoidal rule of the first sum misses l^2 / (8 (r + t_c)) of the distance, l being the length of
an element, so that w_v is l times the ratio of this distance to t_c, at most l.
"""

import numpy as np

from kernels.arrays import pair
from kernels.compile.jit import jit, jit_exact
from kernels.geometry.profile import advance, distance, gap, is_far, to_segment
from kernels.laws.barrier import phi
from kernels.linear.condensed.block_matrix import add, add_block


@jit_exact
def near_node(x, profiles, k, p, reach):
    """Return n, d and b of node ``p`` and profile ``k`` (`profile.distance`); d is infinite beyond
    ``reach``.
    """
    px, py = x[2 * p], x[2 * p + 1] - x[profiles.carrier[k]]
    if is_far(profiles, k, reach, px, px, py, py):
        return 0.0, 0.0, np.inf, 0.0
    return distance(profiles, k, px, py)


@jit_exact
def ends(x, profiles, k, e):
    """Return both ends of element ``e``, y above the carrier of profile ``k``."""
    a, b = pair(profiles.edges, e)
    y = x[profiles.carrier[k]]
    return (x[2 * a], x[2 * a + 1] - y), (x[2 * b], x[2 * b + 1] - y)


@jit_exact
def near_element(x, profiles, k, i, e, reach):
    """Return tau, n and d of vertex ``i`` of profile ``k`` and element ``e``; n is from the vertex,
    d is infinite beyond ``reach``.
    """
    a, b = ends(x, profiles, k, e)
    vx, vy, far = profiles.vertex[i, 0], profiles.vertex[i, 1], reach + profiles.radius[k]
    beside = min(a[0], b[0]) - vx > far or vx - max(a[0], b[0]) > far
    if beside or min(a[1], b[1]) - vy > far or vy - max(a[1], b[1]) > far:
        return 0.0, 0.0, 0.0, np.inf
    tau, nx, ny, apart = to_segment(vx, vy, a[0], a[1], b[0], b[1])
    return tau, nx, ny, apart - profiles.radius[k]


@jit_exact
def near_end(x, profiles, k, i, q):
    """Return n and d of vertex ``i`` of profile ``k`` and node ``q``."""
    px, py = x[2 * q], x[2 * q + 1] - x[profiles.carrier[k]]
    vx, vy = profiles.vertex[i, 0], profiles.vertex[i, 1]
    _, nx, ny, apart = to_segment(vx, vy, px, py, px, py)
    return nx, ny, apart - profiles.radius[k]


@jit
def _push(g, nodes, tau, carrier, nx, ny, slope):
    """Add the gradient of an energy with derivative ``slope`` in the distance of the point ``tau``
    between two nodes.
    """
    a, b = nodes
    g[2 * a] += (1.0 - tau) * slope * nx
    g[2 * a + 1] += (1.0 - tau) * slope * ny
    g[2 * b] += tau * slope * nx
    g[2 * b + 1] += tau * slope * ny
    g[carrier] -= slope * ny


@jit
def evaluate(x, profiles, stiffness, g):
    """Return E_p in J, infinite at a distance of zero; add dE_p/dx to ``g`` (n,).

    stiffness: c Y' depth, N/m.
    """
    total = 0.0
    for k in range(profiles.radius.size):
        total += _nodes(x, profiles, k, stiffness, g)
        for i in range(profiles.start[k], profiles.start[k + 1]):
            if profiles.weight[i] > 0.0:
                total += _elements(x, profiles, k, i, stiffness, g)
    return total


@jit
def _nodes(x, profiles, k, stiffness, g):
    """Return the energy of nodes, J; add its gradient."""
    total = 0.0
    for p in profiles.nodes:
        starts = profiles.node_half[p]
        nx, ny, d, _ = near_node(x, profiles, k, p, starts)
        if d <= 0.0:
            return np.inf
        if d < starts:
            value, slope, _ = phi(profiles.tributary[p], stiffness, starts, d)
            total += value
            _push(g, (p, p), 0.0, profiles.carrier[k], nx, ny, slope)
    return total


@jit
def _elements(x, profiles, k, i, stiffness, g):
    """Return the energy of contact of vertex ``i`` with elements, J; add its gradient."""
    total, weight = 0.0, profiles.weight[i]
    for e in range(profiles.edges.shape[0]):
        starts = profiles.edge_half[e]
        tau, nx, ny, d = near_element(x, profiles, k, i, e, starts)
        if d >= starts:
            continue
        if d <= 0.0:  # the subtracted energy may be infinite too
            return np.inf
        value, slope, _ = phi(weight, stiffness, starts, d)
        total += value
        _push(g, pair(profiles.edges, e), tau, profiles.carrier[k], nx, ny, slope)
        for end in range(2):
            q = profiles.edges[e, end]
            nx, ny, d = near_end(x, profiles, k, i, q)
            if profiles.subtract[e, end] != 0.0 and d < starts:
                value, slope, _ = phi(-weight, stiffness, starts, d)
                total += value
                _push(g, (q, q), 0.0, profiles.carrier[k], nx, ny, slope)
    return total


@jit
def hessian(x, profiles, stiffness, matrix):
    """Add d2E_p/dx2 at ``x``."""
    for k in range(profiles.radius.size):
        for p in profiles.nodes:
            starts = profiles.node_half[p]
            nx, ny, d, bend = near_node(x, profiles, k, p, starts)
            if d < starts:
                _, slope, curvature = phi(profiles.tributary[p], stiffness, starts, d)
                _stiffen(matrix, p, profiles.carrier[k], (nx, ny), curvature, slope * bend)
        for i in range(profiles.start[k], profiles.start[k + 1]):
            if profiles.weight[i] > 0.0:
                _stiffen_elements(x, profiles, k, i, stiffness, matrix)


@jit
def _stiffen(matrix, p, carrier, n, curvature, across):
    """Add ``curvature`` n n^T + ``across`` (I - n n^T) of node ``p`` and a profile."""
    nx, ny = n
    xx = across + (curvature - across) * nx * nx
    xy = (curvature - across) * nx * ny
    yy = across + (curvature - across) * ny * ny
    add_block(matrix, 2 * p, 2 * p, xx, xy, xy, yy)
    add(matrix, carrier, carrier, yy)
    add(matrix, carrier, 2 * p, -xy)
    add(matrix, carrier, 2 * p + 1, -yy)


@jit
def _stiffen_elements(x, profiles, k, i, stiffness, matrix):
    """Add the Hessian of vertex ``i`` with elements."""
    weight, carrier = profiles.weight[i], profiles.carrier[k]
    for e in range(profiles.edges.shape[0]):
        starts = profiles.edge_half[e]
        tau, nx, ny, d = near_element(x, profiles, k, i, e, starts)
        if d >= starts:
            continue
        _, slope, curvature = phi(weight, stiffness, starts, d)
        apart = d + profiles.radius[k]
        if 0.0 < tau < 1.0:
            _stiffen_inside(matrix, x, profiles, k, e, tau, (nx, ny, apart), curvature, slope)
        else:
            q = profiles.edges[e, 0 if tau == 0.0 else 1]
            _stiffen(matrix, q, carrier, (nx, ny), curvature, slope / apart)
        for end in range(2):
            q = profiles.edges[e, end]
            nx, ny, d = near_end(x, profiles, k, i, q)
            if profiles.subtract[e, end] != 0.0 and d < starts:
                _, slope, curvature = phi(-weight, stiffness, starts, d)
                across = slope / (d + profiles.radius[k])
                _stiffen(matrix, q, carrier, (nx, ny), curvature, across)


@jit
def _stiffen_inside(matrix, x, profiles, k, e, tau, normal, curvature, slope):
    """Add the Hessian of a vertex at a distance d from a point inside element a-b.

    As in `geometry.distance`, with n from the vertex to the element, and q = (-1, 1 - tau, tau) and
    r = (0, -1, 1) / l over vertex, a and b.
    """
    nx, ny, apart = normal
    a, b = pair(profiles.edges, e)
    ux, uy = x[2 * b] - x[2 * a], x[2 * b + 1] - x[2 * a + 1]
    length = np.sqrt(ux * ux + uy * uy)
    ux, uy, carrier = ux / length, uy / length, profiles.carrier[k]
    vectors, terms, r = (nx, ny, ux, uy), (curvature, slope, apart), 1.0 / length
    for i, j, q, s, at, of in (
        (a, a, 1.0 - tau, 1.0 - tau, -r, -r),
        (b, b, tau, tau, r, r),
        (a, b, 1.0 - tau, tau, -r, r),
    ):
        xx, xy, yx, yy = _block(q, s, at, of, vectors, terms)
        add_block(matrix, 2 * i, 2 * j, xx, xy, yx, yy)
    _, _, _, yy = _block(-1.0, -1.0, 0.0, 0.0, vectors, terms)
    add(matrix, carrier, carrier, yy)
    for i, q, at in ((a, 1.0 - tau, -r), (b, tau, r)):
        _, _, yx, yy = _block(-1.0, q, 0.0, at, vectors, terms)
        add(matrix, carrier, 2 * i, yx)
        add(matrix, carrier, 2 * i + 1, yy)


@jit
def _block(qi, qj, ri, rj, vectors, terms):
    """Return block (i, j) of curvature N N^T - slope [U R^T + R U^T + d R R^T], N = q n, R = r n,
    U = q u.
    """
    nx, ny, ux, uy = vectors
    curvature, slope, d = terms
    nn = curvature * qi * qj - slope * d * ri * rj
    un, nu = -slope * qi * rj, -slope * ri * qj
    return (
        nn * nx * nx + (un + nu) * ux * nx,
        nn * nx * ny + un * ux * ny + nu * nx * uy,
        nn * nx * ny + un * uy * nx + nu * ny * ux,
        nn * ny * ny + (un + nu) * uy * ny,
    )


@jit_exact
def step_limit(x, dx, profiles):
    """Return a share of the move ``dx``, at most 1, up to which elements and profiles stay
    apart.
    """
    first = 1.0
    for k in range(profiles.radius.size):
        for e in range(profiles.edges.shape[0]):
            a, b = ends(x, profiles, k, e)
            da, db = ends(dx, profiles, k, e)
            if not _stays_far(profiles, k, a, b, da, db):
                first = min(first, advance(profiles, k, a, b, da, db))
    return first


@jit_exact
def _stays_far(profiles, k, a, b, da, db):
    """Return whether the box around a moving element stays outside the box of a profile."""
    low_x = min(a[0], b[0], a[0] + da[0], b[0] + db[0])
    high_x = max(a[0], b[0], a[0] + da[0], b[0] + db[0])
    low_y = min(a[1], b[1], a[1] + da[1], b[1] + db[1])
    high_y = max(a[1], b[1], a[1] + da[1], b[1] + db[1])
    return is_far(profiles, k, 0.0, low_x, high_x, low_y, high_y)


@jit_exact
def least_gap(x, profiles):
    """Return the smallest distance in m of the centre line of a wall from a profile."""
    least = np.inf
    for k in range(profiles.radius.size):
        for e in range(profiles.edges.shape[0]):
            a, b = ends(x, profiles, k, e)
            _, _, d = gap(profiles, k, a[0], a[1], b[0], b[1])
            least = min(least, d)
    return least


@jit_exact
def free_path(x, profiles, carrier, towards):
    """Return a distance in m by which the profiles of ``carrier`` may move before one touches the
    surface of a wall, a good share of the whole way. towards: 1 upwards, -1 downwards.
    """
    path = np.inf
    for k in range(profiles.radius.size):
        for e in range(profiles.edges.shape[0] if profiles.carrier[k] == carrier else 0):
            a, b = ends(x, profiles, k, e)
            _, ny, d = gap(profiles, k, a[0], a[1], b[0], b[1])
            if ny * towards > 0.0:
                path = min(path, max(d - profiles.edge_half[e], 0.0) / (ny * towards))
    return path


@jit_exact
def room(profiles):
    """Return the largest number of contacts with normal forces of their own."""
    tips = 0
    for i in range(profiles.weight.size):
        if profiles.weight[i] > 0.0:
            tips += 1
    return profiles.radius.size * profiles.nodes.size + 3 * tips * profiles.edges.shape[0]
