"""The angle between two arms that leave one node: value, gradient, Hessian.

    psi = arg(c - b) - arg(a - b),  in (-pi, pi],  counted from arm b-a to arm b-c.

With v = c - b, r = |v|: d arg/dc = (-v_y, v_x) / r^2 and
d2 arg/dc2 = [[2 v_x v_y, v_y^2 - v_x^2], [., -2 v_x v_y]] / r^4.
"""

import math

from kernels.jit import jit
from kernels.sparse import add, add_block


@jit
def between(x, a, b, c):
    """Return (cross, dot) of arm b-a with arm b-c: psi = atan2(cross, dot)."""
    ux, uy = x[2 * a] - x[2 * b], x[2 * a + 1] - x[2 * b + 1]
    vx, vy = x[2 * c] - x[2 * b], x[2 * c + 1] - x[2 * b + 1]
    return ux * vy - uy * vx, ux * vx + uy * vy


@jit
def turned(cross, dot, cos_rest, sin_rest):
    """Return psi - psi_rest in (-pi, pi], by rotating back through the rest angle."""
    return math.atan2(cross * cos_rest - dot * sin_rest, dot * cos_rest + cross * sin_rest)


@jit
def slope(x, b, c):
    """Return d arg(c - b) / dc, two numbers in 1/m (minus the same with respect to b)."""
    vx, vy = x[2 * c] - x[2 * b], x[2 * c + 1] - x[2 * b + 1]
    r2 = vx * vx + vy * vy
    return -vy / r2, vx / r2


@jit
def twist(g, x, a, b, c, moment):
    """Add the gradient of an energy with derivative ``moment`` in psi(a, b, c)."""
    px, py = slope(x, b, a)
    qx, qy = slope(x, b, c)
    g[2 * a] -= moment * px
    g[2 * a + 1] -= moment * py
    g[2 * c] += moment * qx
    g[2 * c + 1] += moment * qy
    g[2 * b] += moment * (px - qx)
    g[2 * b + 1] += moment * (py - qy)


@jit
def _outer(matrix, i, j, weight, px, py, qx, qy):
    add_block(matrix, i, j, weight * px * qx, weight * px * qy, weight * py * qx, weight * py * qy)


@jit
def curl(matrix, b, c, moment, qx, qy):
    """Add moment * d2 arg(c - b); (qx, qy) is `slope`, whose products are its entries."""
    xx, xy = -2.0 * moment * qx * qy, moment * (qx * qx - qy * qy)
    add_block(matrix, 2 * c, 2 * c, xx, xy, xy, -xx)
    add_block(matrix, 2 * b, 2 * b, xx, xy, xy, -xx)
    add_block(matrix, 2 * c, 2 * b, -xx, -xy, -xy, xx)


@jit
def twist_stiffen(matrix, x, a, b, c, stiffness, moment):
    """Add stiffness * (grad psi)(grad psi)^T + moment * d2 psi."""
    px, py = slope(x, b, a)
    qx, qy = slope(x, b, c)
    rx, ry = px - qx, py - qy
    a, b, c = 2 * a, 2 * b, 2 * c
    _outer(matrix, a, a, stiffness, px, py, px, py)
    _outer(matrix, b, b, stiffness, rx, ry, rx, ry)
    _outer(matrix, c, c, stiffness, qx, qy, qx, qy)
    _outer(matrix, a, b, -stiffness, px, py, rx, ry)
    _outer(matrix, c, b, stiffness, qx, qy, rx, ry)
    _outer(matrix, a, c, -stiffness, px, py, qx, qy)
    if moment != 0.0:
        curl(matrix, b // 2, c // 2, moment, qx, qy)
        curl(matrix, b // 2, a // 2, -moment, px, py)


@jit
def arm_turned(x, b, c, phi, cos_rest, sin_rest):
    """Return arg(c - b) - (rest direction + phi), relative to the rotated rest direction."""
    co, si = math.cos(phi), math.sin(phi)
    rx, ry = co * cos_rest - si * sin_rest, si * cos_rest + co * sin_rest
    vx, vy = x[2 * c] - x[2 * b], x[2 * c + 1] - x[2 * b + 1]
    return math.atan2(rx * vy - ry * vx, rx * vx + ry * vy)


@jit
def arm_twist(g, x, b, c, rotation, moment):
    """Add the gradient of an energy with slope ``moment`` in an arm's turn against its joint."""
    qx, qy = slope(x, b, c)
    g[2 * c] += moment * qx
    g[2 * c + 1] += moment * qy
    g[2 * b] -= moment * qx
    g[2 * b + 1] -= moment * qy
    g[rotation] -= moment


@jit
def arm_stiffen(matrix, x, b, c, rotation, stiffness, moment):
    """Add stiffness * (grad a)(grad a)^T + moment * d2 a of an arm against its joint's rotation."""
    qx, qy = slope(x, b, c)
    _outer(matrix, 2 * c, 2 * c, stiffness, qx, qy, qx, qy)
    _outer(matrix, 2 * b, 2 * b, stiffness, qx, qy, qx, qy)
    _outer(matrix, 2 * c, 2 * b, -stiffness, qx, qy, qx, qy)
    add(matrix, rotation, 2 * c, -stiffness * qx)
    add(matrix, rotation, 2 * c + 1, -stiffness * qy)
    add(matrix, rotation, 2 * b, stiffness * qx)
    add(matrix, rotation, 2 * b + 1, stiffness * qy)
    add(matrix, rotation, rotation, stiffness)
    if moment != 0.0:
        curl(matrix, b, c, moment, qx, qy)
