"""Viscous stress and moment, proportional to the rates of strain and turn of each element.

    D = rate / 2 [ sum Y A l0 de^2 + sum K dtheta^2 + sum 2 k12 dtheta_1 dtheta_2 ], rate = tau / dt

de, dtheta: changes of strain and turn in the step. A rigid motion costs nothing.
"""

from kernels import chain
from kernels.jit import jit


@jit
def _strain(terms, before, rate, shape, stiffness, projected):
    total = 0.0
    for k in range(shape.length.size):
        viscosity = rate * terms.law.modulus * terms.stretch.area[k] / terms.stretch.l0[k]
        change = shape.length[k] - before.length[k]
        total += 0.5 * viscosity * change * change
        across = viscosity * change / shape.length[k]
        if projected:
            across = max(across, 0.0)
        chain.stretch(shape, stiffness, k, viscosity * change, viscosity, across)
    return total


@jit
def _hinges(bend, before, rate, shape, stiffness, projected):
    total = 0.0
    for h in range(bend.hinges.size):
        k = bend.hinges[h]
        weight, change = rate * bend.hinge_stiffness[h], shape.hinge_turn[k] - before.hinge_turn[k]
        total += 0.5 * weight * change * change
        moment = weight * change
        chain.turn_hinge(shape, stiffness, k, moment, weight, 0.0 if projected else moment)
    return total


@jit
def _arms(walls, bend, before, rate, shape, stiffness, projected):
    total = 0.0
    for w in range(bend.coupling.size):
        k12 = rate * bend.coupling[w]
        one = shape.arm_turn[2 * w] - before.arm_turn[2 * w]
        two = shape.arm_turn[2 * w + 1] - before.arm_turn[2 * w + 1]
        total += k12 * one * two
        for a, change, other in ((2 * w, one, two), (2 * w + 1, two, one)):
            weight = rate * bend.arm_stiffness[a]
            total += 0.5 * weight * change * change
            moment = weight * change + k12 * other
            bent = 0.0 if projected else moment
            chain.turn_arm(shape, stiffness, walls, a, moment, weight, bent)
        if k12 > 0.0:
            chain.couple_arms(shape, stiffness, walls, w, k12)
    return total


@jit
def evaluate(terms, before, rate, shape, stiffness, projected):
    """Return D in J; add its derivatives. ``before``: the shape at x0."""
    total = _strain(terms, before, rate, shape, stiffness, projected)
    total += _hinges(terms.bend, before, rate, shape, stiffness, projected)
    return total + _arms(terms.walls, terms.bend, before, rate, shape, stiffness, projected)
