"""Damping as convex dissipation potentials D(x) of a step from x0 to x; the force is dD/dx.

Rayleigh, C = alpha M + beta K:   D = (x - x0)^T C (x - x0) / (2 dt), K the elastic Hessian at x0,
    every element of it projected to be positive semi-definite.
Kelvin-Voigt: D = dt/2 [ sum tau A l0 Y ((e - e0) / dt)^2 + sum tau K ((kappa - kappa0) / dt)^2 ],
    in strain and turn, so that a rigid motion costs nothing.
In one step a quadratic potential dissipates dD/dx . (x - x0) = 2 D.
"""

from typing import NamedTuple

import numpy as np

from kernels import angle
from kernels.bend import arm_turn, curvature, hinge_turn
from kernels.jit import jit
from kernels.law import uniaxial
from kernels.rows import pair, triple
from kernels.sparse import add
from kernels.stretch import direction, pull, stiffen


class Damp(NamedTuple):
    """alpha_m in 1/s, beta_k and relaxation time in s; zero where the scene has none."""

    alpha_m: float
    beta_k: float
    relaxation: float


@jit
def energy(x, x0, terms, dt):
    """Return D in J."""
    total = 0.0
    if terms.damp.alpha_m > 0.0:
        for i in range(terms.mass.size):
            total += 0.5 * terms.damp.alpha_m / dt * terms.mass[i] * (x[i] - x0[i]) ** 2
    if terms.damp.beta_k > 0.0:
        total += _stiffness_energy(x, x0, terms, terms.damp.beta_k / dt)
    if terms.damp.relaxation > 0.0:
        total += _viscous_energy(x, x0, terms, terms.damp.relaxation / dt)
    return total


@jit
def gradient(x, x0, terms, dt, g):
    """Add dD/dx to ``g``."""
    if terms.damp.alpha_m > 0.0:
        for i in range(terms.mass.size):
            g[i] += terms.damp.alpha_m / dt * terms.mass[i] * (x[i] - x0[i])
    if terms.damp.beta_k > 0.0:
        _stiffness_gradient(x, x0, terms, terms.damp.beta_k / dt, g)
    if terms.damp.relaxation > 0.0:
        _viscous_gradient(x, x0, terms, terms.damp.relaxation / dt, g)


@jit
def hessian(x, x0, terms, dt, matrix, projected):
    """Add d2D/dx2."""
    if terms.damp.alpha_m > 0.0:
        for i in range(terms.mass.size):
            add(matrix, i, i, terms.damp.alpha_m / dt * terms.mass[i])
    if terms.damp.beta_k > 0.0:
        _stiffness_hessian(x0, terms, terms.damp.beta_k / dt, matrix)
    if terms.damp.relaxation > 0.0:
        _viscous_hessian(x, x0, terms, terms.damp.relaxation / dt, matrix, projected)


# --- Rayleigh: frozen element stiffness ----------------------------------------------------------


@jit
def _frozen_edge(x0, terms, k):
    """Return direction at x0 and the clipped stiffness along and across the element."""
    i, j = pair(terms.stretch.edges, k)
    nx, ny, length = direction(x0, i, j)
    _, stress, tangent = uniaxial(terms.law, length / terms.stretch.l0[k] - 1.0)
    area = terms.stretch.area[k]
    return nx, ny, max(area * tangent / terms.stretch.l0[k], 0.0), max(area * stress / length, 0.0)


@jit
def _frozen_turn(bend, stiffness, delta):
    _, d1, _ = curvature(bend.measure, delta)
    return stiffness * d1 * d1


@jit
def _move(x, x0, i, j):
    return (x[2 * j] - x0[2 * j]) - (x[2 * i] - x0[2 * i]), (
        x[2 * j + 1] - x0[2 * j + 1]
    ) - (x[2 * i + 1] - x0[2 * i + 1])


@jit
def _linear_turn(x, x0, b, c):
    """Return the change of arg(c - b) from x0 to x, linearised at x0."""
    qx, qy = angle.slope(x0, b, c)
    mx, my = _move(x, x0, b, c)
    return qx * mx + qy * my


@jit
def _stiffness_energy(x, x0, terms, rate):
    total, bend = 0.0, terms.bend
    for k in range(terms.stretch.l0.size):
        nx, ny, along, across = _frozen_edge(x0, terms, k)
        mx, my = _move(x, x0, terms.stretch.edges[k, 0], terms.stretch.edges[k, 1])
        total += along * (nx * mx + ny * my) ** 2 + across * (nx * my - ny * mx) ** 2
    for k in range(bend.hinge_stiffness.size):
        a, b, c = triple(bend.hinges, k)
        turn = _linear_turn(x, x0, b, c) - _linear_turn(x, x0, b, a)
        total += _frozen_turn(bend, bend.hinge_stiffness[k], hinge_turn(x0, bend, k)) * turn * turn
    for k in range(bend.arm_stiffness.size):
        b, c, rotation = triple(bend.arms, k)
        turn = _linear_turn(x, x0, b, c) - (x[rotation] - x0[rotation])
        total += _frozen_turn(bend, bend.arm_stiffness[k], arm_turn(x0, bend, k)) * turn * turn
    return 0.5 * rate * total


@jit
def _stiffness_gradient(x, x0, terms, rate, g):
    bend = terms.bend
    for k in range(terms.stretch.l0.size):
        i, j = pair(terms.stretch.edges, k)
        nx, ny, along, across = _frozen_edge(x0, terms, k)
        mx, my = _move(x, x0, i, j)
        pull(g, i, j, nx, ny, rate * along * (nx * mx + ny * my))
        pull(g, i, j, -ny, nx, rate * across * (nx * my - ny * mx))
    for k in range(bend.hinge_stiffness.size):
        a, b, c = triple(bend.hinges, k)
        turn = _linear_turn(x, x0, b, c) - _linear_turn(x, x0, b, a)
        weight = _frozen_turn(bend, bend.hinge_stiffness[k], hinge_turn(x0, bend, k))
        angle.twist(g, x0, a, b, c, rate * weight * turn)
    for k in range(bend.arm_stiffness.size):
        b, c, rotation = triple(bend.arms, k)
        turn = _linear_turn(x, x0, b, c) - (x[rotation] - x0[rotation])
        weight = _frozen_turn(bend, bend.arm_stiffness[k], arm_turn(x0, bend, k))
        angle.arm_twist(g, x0, b, c, rotation, rate * weight * turn)


@jit
def _stiffness_hessian(x0, terms, rate, matrix):
    bend = terms.bend
    for k in range(terms.stretch.l0.size):
        i, j = pair(terms.stretch.edges, k)
        nx, ny, along, across = _frozen_edge(x0, terms, k)
        stiffen(matrix, i, j, nx, ny, rate * along, rate * across)
    for k in range(bend.hinge_stiffness.size):
        a, b, c = triple(bend.hinges, k)
        weight = _frozen_turn(bend, bend.hinge_stiffness[k], hinge_turn(x0, bend, k))
        angle.twist_stiffen(matrix, x0, a, b, c, rate * weight, 0.0)
    for k in range(bend.arm_stiffness.size):
        b, c, rotation = triple(bend.arms, k)
        weight = _frozen_turn(bend, bend.arm_stiffness[k], arm_turn(x0, bend, k))
        angle.arm_stiffen(matrix, x0, b, c, rotation, rate * weight, 0.0)


# --- Kelvin-Voigt: viscous stress and moment -----------------------------------------------------


@jit
def _strain_change(x, x0, terms, k):
    """Return direction and length at x, and e(x) - e(x0), of element ``k``."""
    i, j = pair(terms.stretch.edges, k)
    _, _, before = direction(x0, i, j)
    nx, ny, length = direction(x, i, j)
    return nx, ny, length, (length - before) / terms.stretch.l0[k]


@jit
def _viscous_energy(x, x0, terms, rate):
    total, bend = 0.0, terms.bend
    for k in range(terms.stretch.l0.size):
        _, _, _, change = _strain_change(x, x0, terms, k)
        viscosity = terms.law.modulus * terms.stretch.area[k] * terms.stretch.l0[k]
        total += viscosity * change * change
    for k in range(bend.hinge_stiffness.size):
        change = hinge_turn(x, bend, k) - hinge_turn(x0, bend, k)
        total += bend.hinge_stiffness[k] * change * change
    for k in range(bend.arm_stiffness.size):
        change = arm_turn(x, bend, k) - arm_turn(x0, bend, k)
        total += bend.arm_stiffness[k] * change * change
    return 0.5 * rate * total


@jit
def _viscous_gradient(x, x0, terms, rate, g):
    bend = terms.bend
    for k in range(terms.stretch.l0.size):
        nx, ny, _, change = _strain_change(x, x0, terms, k)
        i, j = pair(terms.stretch.edges, k)
        pull(g, i, j, nx, ny, rate * terms.law.modulus * terms.stretch.area[k] * change)
    for k in range(bend.hinge_stiffness.size):
        a, b, c = triple(bend.hinges, k)
        change = hinge_turn(x, bend, k) - hinge_turn(x0, bend, k)
        angle.twist(g, x, a, b, c, rate * bend.hinge_stiffness[k] * change)
    for k in range(bend.arm_stiffness.size):
        b, c, rotation = triple(bend.arms, k)
        change = arm_turn(x, bend, k) - arm_turn(x0, bend, k)
        angle.arm_twist(g, x, b, c, rotation, rate * bend.arm_stiffness[k] * change)


@jit
def _viscous_hessian(x, x0, terms, rate, matrix, projected):
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
        a, b, c = triple(bend.hinges, k)
        change = hinge_turn(x, bend, k) - hinge_turn(x0, bend, k)
        weight = rate * bend.hinge_stiffness[k]
        moment = 0.0 if projected else weight * change
        angle.twist_stiffen(matrix, x, a, b, c, weight, moment)
    for k in range(bend.arm_stiffness.size):
        b, c, rotation = triple(bend.arms, k)
        change = arm_turn(x, bend, k) - arm_turn(x0, bend, k)
        weight = rate * bend.arm_stiffness[k]
        moment = 0.0 if projected else weight * change
        angle.arm_stiffen(matrix, x, b, c, rotation, weight, moment)
