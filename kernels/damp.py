"""Damping as a convex dissipation potential of a step: D = D_mass + D_stiffness + D_viscous.

    D_mass = alpha / (2 dt) |x - x0|_M^2;  the others: `rayleigh` and `kelvin_voigt`.

The force is dD/dx. In one step a quadratic potential dissipates dD/dx . (x - x0) = 2 D.
"""

from typing import NamedTuple

from kernels import kelvin_voigt, rayleigh
from kernels.jit import jit
from kernels.sparse import add


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
        total += rayleigh.energy(x, x0, terms, terms.damp.beta_k / dt)
    if terms.damp.relaxation > 0.0:
        total += kelvin_voigt.energy(x, x0, terms, terms.damp.relaxation / dt)
    return total


@jit
def gradient(x, x0, terms, dt, g):
    """Add dD/dx to ``g``."""
    if terms.damp.alpha_m > 0.0:
        for i in range(terms.mass.size):
            g[i] += terms.damp.alpha_m / dt * terms.mass[i] * (x[i] - x0[i])
    if terms.damp.beta_k > 0.0:
        rayleigh.gradient(x, x0, terms, terms.damp.beta_k / dt, g)
    if terms.damp.relaxation > 0.0:
        kelvin_voigt.gradient(x, x0, terms, terms.damp.relaxation / dt, g)


@jit
def hessian(x, x0, terms, dt, matrix, projected):
    """Add d2D/dx2."""
    if terms.damp.alpha_m > 0.0:
        for i in range(terms.mass.size):
            add(matrix, i, i, terms.damp.alpha_m / dt * terms.mass[i])
    if terms.damp.beta_k > 0.0:
        rayleigh.hessian(x0, terms, terms.damp.beta_k / dt, matrix)
    if terms.damp.relaxation > 0.0:
        kelvin_voigt.hessian(x, x0, terms, terms.damp.relaxation / dt, matrix, projected)
