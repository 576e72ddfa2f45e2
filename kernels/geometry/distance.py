"""Distance between a point p and a segment a-b in the plane, its gradient and Hessian.

Interior: d = |n . (p - a)|; beyond an end: the distance to that end. With the closest point tau,
the unit tangent u, the unit normal n towards p and the length l, q = (1, tau - 1, -tau) and r = (0,
-1, 1) / l over the nodes (p, a, b):

    grad d = q n,     d2 d = -(q u)(r n)^T - (r n)(q u)^T - d (r n)(r n)^T        (interior)
    grad d = (1, -1) n,  d2 d = (I - n n^T) / d                                   (point-point)
"""

import numpy as np

from kernels.compile.jit import jit, jit_exact
from kernels.linear.condensed.block_matrix import add_block


@jit
def direction(x, i, j):
    """Return unit vector and length of the line from node ``i`` to node ``j``."""
    nx = x[2 * j] - x[2 * i]
    ny = x[2 * j + 1] - x[2 * i + 1]
    length = np.sqrt(nx * nx + ny * ny)
    return nx / length, ny / length, length


@jit_exact
def closest(x, p, a, b):
    """Return tau in [0, 1], the closest point of segment a-b to p, and whether it is interior."""
    ux, uy = x[2 * b] - x[2 * a], x[2 * b + 1] - x[2 * a + 1]
    wx, wy = x[2 * p] - x[2 * a], x[2 * p + 1] - x[2 * a + 1]
    along = ux * wx + uy * wy
    l2 = ux * ux + uy * uy
    if along <= 0.0:
        return 0.0, False
    if along >= l2:
        return 1.0, False
    return along / l2, True


@jit_exact
def normal(x, p, a, b, tau):
    """Return the unit vector from the point ``tau`` of a-b to p, and the distance."""
    nx = x[2 * p] - (1.0 - tau) * x[2 * a] - tau * x[2 * b]
    ny = x[2 * p + 1] - (1.0 - tau) * x[2 * a + 1] - tau * x[2 * b + 1]
    d = (nx * nx + ny * ny) ** 0.5
    if d > 0.0:
        return nx / d, ny / d, d
    return 0.0, 0.0, 0.0


@jit_exact
def squared_distance(x, p, a, b):
    """Return the squared distance of node ``p`` from the segment a-b, m^2."""
    tau, _ = closest(x, p, a, b)
    nx = x[2 * p] - (1.0 - tau) * x[2 * a] - tau * x[2 * b]
    ny = x[2 * p + 1] - (1.0 - tau) * x[2 * a + 1] - tau * x[2 * b + 1]
    return nx * nx + ny * ny


@jit
def push(g, x, p, a, b, force):
    """Add the gradient of an energy with derivative ``force`` in the distance of p from a-b."""
    tau, _ = closest(x, p, a, b)
    nx, ny, _ = normal(x, p, a, b, tau)
    g[2 * p] += force * nx
    g[2 * p + 1] += force * ny
    g[2 * a] -= (1.0 - tau) * force * nx
    g[2 * a + 1] -= (1.0 - tau) * force * ny
    g[2 * b] -= tau * force * nx
    g[2 * b + 1] -= tau * force * ny


@jit
def push_point(g, x, p, v, force):
    """Add the gradient of an energy with derivative ``force`` in the distance of p from node v."""
    nx, ny, _ = direction(x, v, p)
    g[2 * v] -= force * nx
    g[2 * v + 1] -= force * ny
    g[2 * p] += force * nx
    g[2 * p + 1] += force * ny


@jit
def _pair_block(matrix, i, j, qi, qj, ri, rj, vectors, terms):
    """Add block (i, j) of stiffness N N^T - force [U R^T + R U^T + d R R^T], N = q n, R = r n."""
    nx, ny, ux, uy = vectors
    stiffness, force, d = terms
    nn = stiffness * qi * qj - force * d * ri * rj
    un, nu = -force * qi * rj, -force * ri * qj
    xx, xy = (nn * nx + (un + nu) * ux) * nx, nn * nx * ny + un * ux * ny + nu * nx * uy
    yx, yy = nn * nx * ny + un * uy * nx + nu * ny * ux, (nn * ny + (un + nu) * uy) * ny
    add_block(matrix, i, j, xx, xy, yx, yy)


@jit
def push_stiffen(matrix, x, p, a, b, stiffness, force):
    """Add stiffness * (grad d)(grad d)^T + force * d2 d for the distance of p from a-b."""
    tau, inside = closest(x, p, a, b)
    if not inside:
        v = a if tau == 0.0 else b
        push_point_stiffen(matrix, x, p, v, stiffness, force)
        return
    nx, ny, d = normal(x, p, a, b, tau)
    ux, uy, length = direction(x, a, b)
    vectors, terms = (nx, ny, ux, uy), (stiffness, force, d)
    r = 1.0 / length
    _pair_block(matrix, 2 * p, 2 * p, 1.0, 1.0, 0.0, 0.0, vectors, terms)
    _pair_block(matrix, 2 * a, 2 * a, tau - 1.0, tau - 1.0, -r, -r, vectors, terms)
    _pair_block(matrix, 2 * b, 2 * b, -tau, -tau, r, r, vectors, terms)
    _pair_block(matrix, 2 * p, 2 * a, 1.0, tau - 1.0, 0.0, -r, vectors, terms)
    _pair_block(matrix, 2 * p, 2 * b, 1.0, -tau, 0.0, r, vectors, terms)
    _pair_block(matrix, 2 * a, 2 * b, tau - 1.0, -tau, -r, r, vectors, terms)


@jit
def push_point_stiffen(matrix, x, p, v, stiffness, force):
    """Add stiffness * (grad d)(grad d)^T + force * d2 d for the distance of p from node v."""
    nx, ny, d = direction(x, v, p)
    across = force / d
    xx = across + (stiffness - across) * nx * nx
    xy = (stiffness - across) * nx * ny
    yy = across + (stiffness - across) * ny * ny
    add_block(matrix, 2 * p, 2 * p, xx, xy, xy, yy)
    add_block(matrix, 2 * v, 2 * v, xx, xy, xy, yy)
    add_block(matrix, 2 * p, 2 * v, -xx, -xy, -xy, -yy)
