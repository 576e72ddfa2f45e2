"""Stiffness-proportional damping: D = rate / 2 (x - x0)^T K (x - x0), rate = beta / dt.

K is the Hessian of stretch and bend at x0, projected to be positive semi-definite element by
element as `stretch.hessian` and `bend.hessian` project it: D is convex, and quadratic in x.
"""

from kernels import angle
from kernels.bend import arm_turn, cross, curvature, hinge_turn
from kernels.jit import jit
from kernels.law import uniaxial
from kernels.rows import pair, triple
from kernels.stretch import direction, pull, stiffen


@jit
def _edge(x0, terms, k):
    """Return direction at x0 and the clipped stiffness along and across element ``k``."""
    i, j = pair(terms.stretch.edges, k)
    nx, ny, length = direction(x0, i, j)
    _, stress, tangent = uniaxial(terms.law, length / terms.stretch.l0[k] - 1.0)
    area = terms.stretch.area[k]
    return nx, ny, max(area * tangent / terms.stretch.l0[k], 0.0), max(area * stress / length, 0.0)


@jit
def _hinge_weight(x0, bend, k):
    """Return the stiffness of hinge ``k`` against its turn, at x0."""
    _, d1, _ = curvature(bend.measure, hinge_turn(x0, bend, k))
    return bend.hinge_stiffness[k] * d1 * d1


@jit
def _arm_weight(x0, bend, k):
    """Return the stiffness of arm ``k`` against its turn, at x0."""
    _, d1, _ = curvature(bend.measure, arm_turn(x0, bend, k))
    return bend.arm_stiffness[k] * d1 * d1


@jit
def _coupling_weight(x0, bend, k):
    """Return the stiffness of coupling ``k`` between the turns of its two arms, at x0."""
    one, two = pair(bend.couplings, k)
    _, d1, _ = curvature(bend.measure, arm_turn(x0, bend, one))
    _, d2, _ = curvature(bend.measure, arm_turn(x0, bend, two))
    return bend.coupling_stiffness[k] * d1 * d2


@jit
def _move(x, x0, i, j):
    """Return how far node j has moved from node i."""
    mx = (x[2 * j] - x0[2 * j]) - (x[2 * i] - x0[2 * i])
    my = (x[2 * j + 1] - x0[2 * j + 1]) - (x[2 * i + 1] - x0[2 * i + 1])
    return mx, my


@jit
def _linear_turn(x, x0, b, c):
    """Return the change of arg(c - b) from x0 to x, linearised at x0."""
    qx, qy = angle.slope(x0, b, c)
    mx, my = _move(x, x0, b, c)
    return qx * mx + qy * my


@jit
def _hinge_change(x, x0, bend, k):
    a, b, c = triple(bend.hinges, k)
    return _linear_turn(x, x0, b, c) - _linear_turn(x, x0, b, a)


@jit
def _arm_change(x, x0, bend, k):
    b, c, rotation = triple(bend.arms, k)
    return _linear_turn(x, x0, b, c) - (x[rotation] - x0[rotation])


@jit
def energy(x, x0, terms, rate):
    """Return D in J."""
    total, bend = 0.0, terms.bend
    for k in range(terms.stretch.l0.size):
        nx, ny, along, across = _edge(x0, terms, k)
        mx, my = _move(x, x0, terms.stretch.edges[k, 0], terms.stretch.edges[k, 1])
        total += along * (nx * mx + ny * my) ** 2 + across * (nx * my - ny * mx) ** 2
    for k in range(bend.hinge_stiffness.size):
        total += _hinge_weight(x0, bend, k) * _hinge_change(x, x0, bend, k) ** 2
    for k in range(bend.arm_stiffness.size):
        total += _arm_weight(x0, bend, k) * _arm_change(x, x0, bend, k) ** 2
    for k in range(bend.coupling_stiffness.size):
        one, two = pair(bend.couplings, k)
        product = _arm_change(x, x0, bend, one) * _arm_change(x, x0, bend, two)
        total += 2.0 * _coupling_weight(x0, bend, k) * product
    return 0.5 * rate * total


@jit
def gradient(x, x0, terms, rate, g):
    """Add dD/dx to ``g``."""
    bend = terms.bend
    for k in range(terms.stretch.l0.size):
        i, j = pair(terms.stretch.edges, k)
        nx, ny, along, across = _edge(x0, terms, k)
        mx, my = _move(x, x0, i, j)
        pull(g, i, j, nx, ny, rate * along * (nx * mx + ny * my))
        pull(g, i, j, -ny, nx, rate * across * (nx * my - ny * mx))
    for k in range(bend.hinge_stiffness.size):
        a, b, c = triple(bend.hinges, k)
        moment = rate * _hinge_weight(x0, bend, k) * _hinge_change(x, x0, bend, k)
        angle.twist(g, x0, a, b, c, moment)
    for k in range(bend.arm_stiffness.size):
        moment = rate * _arm_weight(x0, bend, k) * _arm_change(x, x0, bend, k)
        angle.arm_twist(g, x0, *triple(bend.arms, k), moment)
    for k in range(bend.coupling_stiffness.size):
        one, two = pair(bend.couplings, k)
        weight = rate * _coupling_weight(x0, bend, k)
        moment1 = weight * _arm_change(x, x0, bend, two)
        moment2 = weight * _arm_change(x, x0, bend, one)
        angle.arm_twist(g, x0, *triple(bend.arms, one), moment1)
        angle.arm_twist(g, x0, *triple(bend.arms, two), moment2)


@jit
def hessian(x0, terms, rate, matrix):
    """Add rate K."""
    bend = terms.bend
    for k in range(terms.stretch.l0.size):
        i, j = pair(terms.stretch.edges, k)
        nx, ny, along, across = _edge(x0, terms, k)
        stiffen(matrix, i, j, nx, ny, rate * along, rate * across)
    for k in range(bend.hinge_stiffness.size):
        a, b, c = triple(bend.hinges, k)
        angle.twist_stiffen(matrix, x0, a, b, c, rate * _hinge_weight(x0, bend, k), 0.0)
    for k in range(bend.arm_stiffness.size):
        weight = rate * _arm_weight(x0, bend, k)
        angle.arm_stiffen(matrix, x0, *triple(bend.arms, k), weight, 0.0)
    for k in range(bend.coupling_stiffness.size):
        one, two = pair(bend.couplings, k)
        weight = rate * _coupling_weight(x0, bend, k)
        cross(x0, matrix, triple(bend.arms, one), triple(bend.arms, two), weight)
