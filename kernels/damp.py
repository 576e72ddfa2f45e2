"""Damping as a convex dissipation potential of a step: D = D_mass + D_stiffness + D_viscous.

    D_mass = alpha / (2 dt) |x - x0|_M^2;  the others: `rayleigh` and `kelvin_voigt`.

M is the lattice's: nothing damps the flight of a striker.

The force is dD/dx. In one step a quadratic potential dissipates dD/dx . (x - x0) = 2 D.
"""

from typing import NamedTuple

import numpy as np

from kernels import bend, chain, kelvin_voigt, rayleigh, stretch
from kernels.jit import jit


class Damp(NamedTuple):
    """alpha_m in 1/s, beta_k and relaxation time in s; zero where the scene has none."""

    alpha_m: float
    beta_k: float
    relaxation: float


class Before(NamedTuple):
    """The start of a step: x0 (n,), its frame, shape and projected stiffness."""

    x0: np.ndarray
    frame: np.ndarray
    shape: object
    stiffness: object


@jit
def prepare(terms, before):
    """Fill ``before`` for a step from ``before.x0``; what no damping needs is left out."""
    x0, shape, stiffness = before.x0, before.shape, before.stiffness
    bend.aim(x0, terms.walls, terms.bend, before.frame)
    if terms.damp.beta_k == 0.0 and terms.damp.relaxation == 0.0:
        return
    chain.measure(x0, terms.walls, shape)
    bend.turns(x0, terms.walls, terms.bend, before.frame, shape)
    if terms.damp.beta_k > 0.0:
        chain.clear(shape, stiffness)
        elements = stretch.Stretch(terms.stretch.l0, terms.stretch.area, True)
        stretch.evaluate(elements, terms.law, shape, stiffness, True)
        bend.evaluate(terms.walls, terms.bend, shape, stiffness, True)


@jit
def evaluate(u, terms, before, dt, shape, stiffness, projected, g):
    """Return D in J for a move ``u`` from x0; add dD/dx to ``g`` and its walls' part to
    ``stiffness``. Slopes and moments of ``shape`` start at zero.
    """
    total = 0.0
    alpha = terms.damp.alpha_m / dt
    if alpha > 0.0:
        for i in range(2 * terms.layout.n_nodes):
            total += 0.5 * alpha * terms.mass[i] * u[i] * u[i]
            g[i] += alpha * terms.mass[i] * u[i]
    if terms.damp.beta_k > 0.0:
        rate = terms.damp.beta_k / dt
        total += rayleigh.evaluate(u, terms.walls, before.stiffness, rate, shape, stiffness)
    if terms.damp.relaxation > 0.0:
        rate = terms.damp.relaxation / dt
        total += kelvin_voigt.evaluate(terms, before.shape, rate, shape, stiffness, projected)
    if terms.damp.beta_k > 0.0 or terms.damp.relaxation > 0.0:
        chain.gather(terms.walls, shape, g)
    return total
