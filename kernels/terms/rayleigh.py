"""Stiffness-proportional damping: D = rate / 2 u^T K u, u = x - y, rate = beta / h.

K is the stiffness of stretch and bend, projected to be positive semi-definite element by element,
so that D is convex and quadratic in x. It is evaluated at x0 or, for integrators of second order,
at the expected end of the step (`solve.integrators`).
"""

from kernels.compile.jit import jit
from kernels.terms import elements


@jit
def evaluate(u, walls, before, rate, shape, stiffness):
    """Return D in J; add rate K u to ``shape`` and rate K to ``stiffness``. before: K."""
    elements.add_scaled(stiffness, before, rate)
    return 0.5 * rate * elements.product(walls, before, u, rate, shape)
