"""The barrier function of contact, folds and element lengths.

    b(s) = -(s - 1)^2 ln s   for 0 < s < 1,   0 beyond,

It is infinite at s = 0 and twice continuously differentiable at s = 1 (Li et al. 2020, Incremental
Potential Contact, eq. 6, with distances divided by the distance at which the barrier starts).
"""

import math

from kernels.compile.jit import jit

CLOSEST = 1e-7  # s below which round-off of positions is a considerable part of the force


@jit
def barrier(s):
    """Return b, b' and b'' at ``s`` (dimensionless); infinite up to `CLOSEST`."""
    if s >= 1.0:
        return 0.0, 0.0, 0.0
    if not s > CLOSEST:
        return math.inf, -math.inf, math.inf
    log = math.log(s)
    r = s - 1.0
    value = -r * r * log
    slope = -r * (2.0 * log + r / s)
    curvature = -2.0 * log - 4.0 * r / s + r * r / (s * s)
    return value, slope, curvature


@jit
def phi(weight, stiffness, starts, d):
    """Return ``weight`` times phi(d) = stiffness t_c b(d / t_c) in J, and its first two derivatives
    in the distance ``d``, m.

    weight, stiffness: contact length, m, and N/m; in space contact area, m^2, and Pa. starts: t_c,
    the distance at which contact starts, m.
    """
    value, slope, curvature = barrier(d / starts)
    scale = weight * stiffness
    return scale * starts * value, scale * slope, scale / starts * curvature
