"""Damping as a convex dissipation potential of a step: D = D_mass + D_stiffness + D_viscous.

    D_mass = alpha / (2 h) |x - y|_M^2;  the others: `rayleigh` and `kelvin_voigt`.

(x - y) / h is the velocity at the end of the step (`solve.integrators`); with backward Euler y = x0
and h = dt. M is the mass of the lattice alone: the flight of a striker is not damped. The gradient
is dD/dx. scene: `planar.problem.PlanarScene`.
"""

from typing import NamedTuple

import numpy as np

from kernels.compile.jit import jit, jit_exact
from kernels.terms import bend, elements, kelvin_voigt, rayleigh, stretch


class Damp(NamedTuple):
    """alpha_m in 1/s, beta_k in s, relaxation: tau of `kelvin_voigt` in s; zero: no damping."""

    alpha_m: float
    beta_k: float
    relaxation: float


class Before(NamedTuple):
    """Data of the start of a step: frame of the elements (`elements.renew_frame`), shape and strain
    (m,) from which rates are measured, and projected stiffness K.
    """

    frame: np.ndarray
    shape: elements.Shape
    strain: np.ndarray
    stiffness: elements.Stiffness


@jit
def _measure_ahead(x0, scene, before, move, place):
    """Measure the shape at the expected end of the step, or at x0 if that would crush walls."""
    walls, frame, shape = scene.walls, before.frame, before.shape
    shortest = elements.measure(x0, walls, frame, shape)
    for i in range(x0.size):
        place[i] = x0[i] + move[i]
    if 2.0 * elements.measure(place, walls, frame, shape) < shortest:
        elements.measure(x0, walls, frame, shape)


@jit
def prepare(x0, scene, memory, before, ahead, place, past, resultants):
    """Fill ``before`` for a step from ``x0``, except data that the damping of the scene does not
    need.

    ahead: `integrators.Ahead`. place (n,), past (`Shape`), resultants: scratch.
    """
    walls, frame, shape, stiffness = scene.walls, before.frame, before.shape, before.stiffness
    elements.renew_frame(x0, walls, frame)
    if scene.damp.beta_k > 0.0:
        if ahead.time > 0.0:
            _measure_ahead(x0, scene, before, ahead.move, place)
        else:
            elements.measure(x0, walls, frame, shape)
        elements.clear(shape, stiffness)
        stretch.evaluate(scene.stretch, scene.law, memory, shape, resultants, True)
        bend.evaluate(scene.bend, scene.stretch, memory, shape, resultants, True)
        elements.add(resultants, True, True, shape, stiffness)
    if scene.damp.relaxation > 0.0:
        elements.measure(x0, walls, frame, shape)
        kelvin_voigt.measure(scene, shape, before.strain)
        if ahead.time > 0.0 and ahead.last == 0.0:
            kelvin_voigt.advance(scene, ahead.rate, ahead.time, shape, before.strain)
        elif ahead.time > 0.0:
            for i in range(x0.size):
                place[i] = x0[i] - ahead.last * ahead.rate[i]
            elements.measure(place, walls, frame, past)
            share = ahead.time / ahead.last
            kelvin_voigt.extrapolate(scene, shape, before.strain, past, share)


@jit
def evaluate(u, scene, before, h, shape, resultants, stiffness, g):
    """Return D in J for a move ``u`` = x - y in ``h`` (s); add dD/dx to ``g`` and the walls' part
    of the Hessian to ``stiffness``. Slopes of ``shape`` are zero on entry.
    """
    total = 0.0
    alpha, mass = scene.damp.alpha_m / h, scene.coordinates.mass
    if alpha > 0.0:
        for i in range(2 * scene.layout.n_nodes):
            total += 0.5 * alpha * mass[i] * u[i] * u[i]
            g[i] += alpha * mass[i] * u[i]
    if scene.damp.beta_k > 0.0:
        rate = scene.damp.beta_k / h
        total += rayleigh.evaluate(u, scene.walls, before.stiffness, rate, shape, stiffness)
    if scene.damp.relaxation > 0.0:
        rate = scene.damp.relaxation / h
        total += kelvin_voigt.evaluate(scene, before, rate, shape, resultants)
        elements.add(resultants, True, False, shape, stiffness)
    if scene.damp.beta_k > 0.0 or scene.damp.relaxation > 0.0:
        elements.gather(scene.walls, shape, g)
    return total


@jit_exact
def hessian(scene, h, diagonal):
    """Add the Hessian of D_mass to the ``diagonal`` (n,); `evaluate` has already added the other
    parts to the stiffness of the walls. h: s.
    """
    factor, mass = scene.damp.alpha_m / h, scene.coordinates.mass
    for i in range(2 * scene.layout.n_nodes):
        diagonal[i] += factor * mass[i]
