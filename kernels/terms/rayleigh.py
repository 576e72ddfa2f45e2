"""Stiffness-proportional damping: D = rate / 2 u^T K u, u = x - y, rate = beta / h (`integrators`).

K is the stiffness of stretch and bend at x0, or of second order where the step is expected to end,
projected to be positive semi-definite element by element: D is convex, and quadratic in x.
"""

from kernels.compile.jit import jit
from kernels.terms import elements


@jit
def evaluate(u, walls, before, rate, shape, stiffness):
    """Return D in J; add rate K u and rate K. ``before``: the stiffness K."""
    elements.add_scaled(stiffness, before, rate)
    return 0.5 * rate * elements.product(walls, before, u, rate, shape)
