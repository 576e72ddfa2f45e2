"""Viscous stress and moment, proportional to the rates of strain and turn of each element.

    D = rate / 2 [ sum Y A l0 de^2 + sum K dtheta^2 + sum 2 k12 dtheta_1 dtheta_2 ], rate = tau / dt

de, dtheta: changes of strain and turn in the step. A rigid motion costs nothing.
"""

from kernels import angle
from kernels.bend import arm_turn, cross, hinge_turn
from kernels.jit import jit
from kernels.rows import pair, triple
from kernels.stretch import direction, pull, stiffen


@jit
def _strain_change(x, x0, terms, k):
    """Return direction and length at x, and e(x) - e(x0), of element ``k``."""
    i, j = pair(terms.stretch.edges, k)
    _, _, before = direction(x0, i, j)
    nx, ny, length = direction(x, i, j)
    return nx, ny, length, (length - before) / terms.stretch.l0[k]


@jit
def _hinge_change(x, x0, bend, k):
    return hinge_turn(x, bend, k) - hinge_turn(x0, bend, k)


@jit
def _arm_change(x, x0, bend, k):
    return arm_turn(x, bend, k) - arm_turn(x0, bend, k)


@jit
def energy(x, x0, terms, rate):
    """Return D in J."""
    total, bend = 0.0, terms.bend
    for k in range(terms.stretch.l0.size):
        _, _, _, change = _strain_change(x, x0, terms, k)
        total += terms.law.modulus * terms.stretch.area[k] * terms.stretch.l0[k] * change * change
    for k in range(bend.hinge_stiffness.size):
        total += bend.hinge_stiffness[k] * _hinge_change(x, x0, bend, k) ** 2
    for k in range(bend.arm_stiffness.size):
        total += bend.arm_stiffness[k] * _arm_change(x, x0, bend, k) ** 2
    for k in range(bend.coupling_stiffness.size):
        one, two = pair(bend.couplings, k)
        product = _arm_change(x, x0, bend, one) * _arm_change(x, x0, bend, two)
        total += 2.0 * bend.coupling_stiffness[k] * product
    return 0.5 * rate * total


@jit
def gradient(x, x0, terms, rate, g):
    """Add dD/dx to ``g``."""
    bend = terms.bend
    for k in range(terms.stretch.l0.size):
        nx, ny, _, change = _strain_change(x, x0, terms, k)
        i, j = pair(terms.stretch.edges, k)
        pull(g, i, j, nx, ny, rate * terms.law.modulus * terms.stretch.area[k] * change)
    for k in range(bend.hinge_stiffness.size):
        moment = rate * bend.hinge_stiffness[k] * _hinge_change(x, x0, bend, k)
        angle.twist(g, x, *triple(bend.hinges, k), moment)
    for k in range(bend.arm_stiffness.size):
        moment = rate * bend.arm_stiffness[k] * _arm_change(x, x0, bend, k)
        angle.arm_twist(g, x, *triple(bend.arms, k), moment)
    for k in range(bend.coupling_stiffness.size):
        one, two = pair(bend.couplings, k)
        weight = rate * bend.coupling_stiffness[k]
        moment1 = weight * _arm_change(x, x0, bend, two)
        moment2 = weight * _arm_change(x, x0, bend, one)
        angle.arm_twist(g, x, *triple(bend.arms, one), moment1)
        angle.arm_twist(g, x, *triple(bend.arms, two), moment2)


@jit
def hessian(x, x0, terms, rate, matrix, projected):
    """Add d2D/dx2; ``projected`` keeps the part that is positive semi-definite."""
    bend = terms.bend
    for k in range(terms.stretch.l0.size):
        i, j = pair(terms.stretch.edges, k)
        nx, ny, length, change = _strain_change(x, x0, terms, k)
        viscosity = rate * terms.law.modulus * terms.stretch.area[k]
        across = viscosity * change / length
        if projected:
            across = max(across, 0.0)
        stiffen(matrix, i, j, nx, ny, viscosity / terms.stretch.l0[k], across)
    for k in range(bend.hinge_stiffness.size):
        weight = rate * bend.hinge_stiffness[k]
        moment = 0.0 if projected else weight * _hinge_change(x, x0, bend, k)
        angle.twist_stiffen(matrix, x, *triple(bend.hinges, k), weight, moment)
    for k in range(bend.arm_stiffness.size):
        weight = rate * bend.arm_stiffness[k]
        moment = 0.0 if projected else weight * _arm_change(x, x0, bend, k)
        angle.arm_stiffen(matrix, x, *triple(bend.arms, k), weight, moment)
    for k in range(bend.coupling_stiffness.size):
        one, two = pair(bend.couplings, k)
        weight = rate * bend.coupling_stiffness[k]
        cross(x, matrix, triple(bend.arms, one), triple(bend.arms, two), weight)
        if not projected:
            moment1 = weight * _arm_change(x, x0, bend, two)
            moment2 = weight * _arm_change(x, x0, bend, one)
            angle.arm_stiffen(matrix, x, *triple(bend.arms, one), 0.0, moment1)
            angle.arm_stiffen(matrix, x, *triple(bend.arms, two), 0.0, moment2)
