"""Stiffness-proportional damping: D = rate / 2 u^T K u, u = x - y, rate = beta / h (`scheme`).

K is the stiffness of stretch and bend at x0, or of second order where the step is expected to end,
projected to be positive semi-definite element by element: D is convex, and quadratic in x.
"""

from kernels.terms import elements as chain
from kernels.compile.jit import jit


@jit
def evaluate(u, walls, before, rate, shape, stiffness):
    """Return D in J; add rate K u and rate K. ``before``: the stiffness K."""
    chain.product(walls, before, u, shape)
    chain.add_scaled(stiffness, before, rate)
    total = 0.0
    for k in range(shape.length.size):
        i, j = 2 * walls.edges[k, 0], 2 * walls.edges[k, 1]
        total += shape.slope[0, k] * (u[j] - u[i]) + shape.slope[1, k] * (u[j + 1] - u[i + 1])
        shape.slope[0, k] *= rate
        shape.slope[1, k] *= rate
    for a in range(shape.moment.size):
        total -= shape.moment[a] * u[walls.rotation[a]]
        shape.moment[a] *= rate
    return 0.5 * rate * total
