"""Inertia of a step as a potential: E_i = |x - x~|_M^2 / (2 h^2), |v|_M^2 = sum m v^2."""

from kernels.compile.jit import jit, jit_exact


@jit
def evaluate(x, x_pred, mass, h, g):
    """Return E_i in J; add M (x - x~) / h^2 to ``g`` (n,).

    x_pred (n,): x~ of `solve.integrators`. mass (n,): kg, zero for rotations. h: s.
    """
    total = 0.0
    for i in range(mass.size):
        force = mass[i] * (x[i] - x_pred[i]) / (h * h)
        total += force * (x[i] - x_pred[i])
        g[i] += force
    return 0.5 * total


@jit_exact
def hessian(mass, h, diagonal):
    """Add M / h^2 to the ``diagonal`` (n,) of the Hessian. mass, h: as in `evaluate`."""
    factor = 1.0 / (h * h)
    for i in range(mass.size):
        diagonal[i] += factor * mass[i]
