"""Viscous stress and moment, proportional to the rates of strain and turn of each element.

    D = rate / 2 [ sum Y A l0 de^2 + sum K dtheta^2 + sum 2 k12 dtheta_1 dtheta_2 ], rate = tau / h

de, dtheta: changes of strain and turn since y (`solve.integrators`). As y is extrapolated in
lengths and turns instead of positions, a rigid motion dissipates nothing.
"""

from kernels.compile.jit import jit
from kernels.terms import elements


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
        elements.stretch(shape, stiffness, k, viscosity * change, viscosity, across)
    return total


@jit
def _hinges(bend, before, rate, shape, stiffness, projected):
    total = 0.0
    for h in range(bend.hinges.size):
        k = bend.hinges[h]
        weight, change = rate * bend.hinge_stiffness[h], shape.hinge_turn[k] - before.hinge_turn[k]
        total += 0.5 * weight * change * change
        moment = weight * change
        elements.turn_hinge(shape, stiffness, k, moment, weight, 0.0 if projected else moment)
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
            elements.turn_arm(shape, stiffness, walls, a, moment, weight, bent)
        if k12 > 0.0:
            elements.couple_arms(shape, stiffness, walls, w, k12)
    return total


@jit
def advance(terms, v, time, shape):
    """Extrapolate lengths and turns of ``shape`` by ``time`` (s) at the velocities ``v`` (n,)."""
    walls, hinges = terms.walls, terms.bend.hinges
    bearing, stretching = shape.slope[0], shape.slope[1]
    for k in range(shape.length.size):
        i, j = 2 * walls.edges[k, 0], 2 * walls.edges[k, 1]
        ex, ey, tx, ty = v[j] - v[i], v[j + 1] - v[i + 1], shape.t[0, k], shape.t[1, k]
        stretching[k] = tx * ex + ty * ey
        bearing[k] = (tx * ey - ty * ex) / shape.length[k]
    for k in range(shape.length.size):
        shape.length[k] += time * stretching[k]
    for k in hinges:
        shape.hinge_turn[k] += time * (bearing[k + 1] - bearing[k])
    for a in range(shape.arm_turn.size):
        turning = bearing[walls.arm_element[a]] - v[walls.rotation[a]]
        shape.arm_turn[a] += time * turning


@jit
def extrapolate(shape, past, share):
    """Extrapolate lengths and turns of ``shape`` by a ``share`` of their change since ``past``."""
    for k in range(shape.length.size):
        shape.length[k] += share * (shape.length[k] - past.length[k])
        shape.hinge_turn[k] += share * (shape.hinge_turn[k] - past.hinge_turn[k])
    for a in range(shape.arm_turn.size):
        shape.arm_turn[a] += share * (shape.arm_turn[a] - past.arm_turn[a])


@jit
def evaluate(terms, before, rate, shape, stiffness, projected):
    """Return D in J; add its derivatives. before: the shape at y, from which rates are measured."""
    total = _strain(terms, before, rate, shape, stiffness, projected)
    total += _hinges(terms.bend, before, rate, shape, stiffness, projected)
    return total + _arms(terms.walls, terms.bend, before, rate, shape, stiffness, projected)
