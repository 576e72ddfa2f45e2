"""Inertia of backward Euler as a potential: E_i = |x - x~|_M^2 / (2 dt^2), lumped masses."""

from kernels.jit import jit
from kernels.sparse import add


@jit
def energy(x, x_pred, mass, dt):
    """Return E_i in J; ``mass`` (n_coordinates,) in kg, zero for rotations."""
    total = 0.0
    for i in range(mass.size):
        d = x[i] - x_pred[i]
        total += mass[i] * d * d
    return total / (2.0 * dt * dt)


@jit
def gradient(x, x_pred, mass, dt, g):
    """Add M (x - x~) / dt^2 to ``g``."""
    for i in range(mass.size):
        g[i] += mass[i] * (x[i] - x_pred[i]) / (dt * dt)


@jit
def hessian(mass, dt, matrix):
    """Add M / dt^2."""
    for i in range(mass.size):
        if mass[i] > 0.0:
            add(matrix, i, i, mass[i] / (dt * dt))


@jit
def kinetic(v, mass):
    """Return 1/2 |v|_M^2 in J."""
    total = 0.0
    for i in range(mass.size):
        total += mass[i] * v[i] * v[i]
    return 0.5 * total
