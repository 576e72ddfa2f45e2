"""Damping as a convex dissipation potential of a step: D = D_mass + D_stiffness + D_viscous.

    D_mass = alpha / (2 h) |x - y|_M^2;  the others: `rayleigh` and `kelvin_voigt`.

(x - y) / h is the velocity at the end of the step (`solve.integrators`); with backward Euler y = x0
and h = dt. M is the mass of the lattice alone: the flight of a striker is not damped. The gradient
is dD/dx.
"""

from typing import NamedTuple

import numpy as np

from kernels.compile.jit import jit
from kernels.terms import bend, elements, kelvin_voigt, rayleigh, stretch


class Damp(NamedTuple):
    """alpha_m in 1/s, beta_k in s, relaxation: tau of `kelvin_voigt` in s; zero: no damping."""

    alpha_m: float
    beta_k: float
    relaxation: float


class Before(NamedTuple):
    """Data of the start of a step: frame of the arms (`bend.renew_frame`), shape from which rates
    of strain are measured, and projected stiffness K.
    """

    frame: np.ndarray
    shape: object
    stiffness: object


@jit
def _measure(x, terms, frame, shape):
    """Fill ``shape``; return the shortest length in m and the least opening in rad."""
    shortest = elements.measure(x, terms.walls, shape)
    return shortest, bend.turns(x, terms.walls, terms.bend, frame, shape)


@jit
def _measure_ahead(x0, terms, before, move, place):
    """Measure the shape at the expected end of the step, or at x0 if that would crush walls."""
    frame, shape = before.frame, before.shape
    shortest, opened = _measure(x0, terms, frame, shape)
    for i in range(x0.size):
        place[i] = x0[i] + move[i]
    length, opening = _measure(place, terms, frame, shape)
    if 2.0 * length < shortest or 2.0 * opening < opened:
        _measure(x0, terms, frame, shape)


@jit
def prepare(x0, terms, memory, before, ahead, place, past):
    """Fill ``before`` for a step from ``x0``; data that no damping of the scene needs is left out.

    ahead: `integrators.Ahead`. place (n,): scratch positions. past: scratch `Shape`.
    """
    frame, shape, stiffness = before.frame, before.shape, before.stiffness
    bend.renew_frame(x0, terms.walls, terms.bend, frame)
    if terms.damp.beta_k > 0.0:
        if ahead.time > 0.0:
            _measure_ahead(x0, terms, before, ahead.move, place)
        else:
            _measure(x0, terms, frame, shape)
        elements.clear(shape, stiffness)
        whole = stretch.Stretch(terms.stretch.l0, terms.stretch.area, True)
        stretch.evaluate(whole, terms.law, memory, shape, stiffness, True)
        bend.evaluate(terms.walls, terms.bend, memory, shape, stiffness, True)
    if terms.damp.relaxation > 0.0:
        _measure(x0, terms, frame, shape)
        if ahead.time > 0.0 and ahead.last == 0.0:
            kelvin_voigt.advance(terms, ahead.rate, ahead.time, shape)
        elif ahead.time > 0.0:
            for i in range(x0.size):
                place[i] = x0[i] - ahead.last * ahead.rate[i]
            _measure(place, terms, frame, past)
            kelvin_voigt.extrapolate(shape, past, ahead.time / ahead.last)


@jit
def evaluate(u, terms, before, dt, shape, stiffness, projected, g):
    """Return D in J for a move ``u`` = x - y in ``dt`` = h; add dD/dx to ``g`` and the walls' part
    of the Hessian to ``stiffness``. Slopes and moments of ``shape`` are zero on entry.
    """
    total = 0.0
    alpha, mass = terms.damp.alpha_m / dt, terms.coordinates.mass
    if alpha > 0.0:
        for i in range(2 * terms.layout.n_nodes):
            total += 0.5 * alpha * mass[i] * u[i] * u[i]
            g[i] += alpha * mass[i] * u[i]
    if terms.damp.beta_k > 0.0:
        rate = terms.damp.beta_k / dt
        total += rayleigh.evaluate(u, terms.walls, before.stiffness, rate, shape, stiffness)
    if terms.damp.relaxation > 0.0:
        rate = terms.damp.relaxation / dt
        total += kelvin_voigt.evaluate(terms, before.shape, rate, shape, stiffness, projected)
    if terms.damp.beta_k > 0.0 or terms.damp.relaxation > 0.0:
        elements.gather(terms.walls, shape, g)
    return total
