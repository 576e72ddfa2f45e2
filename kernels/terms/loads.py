"""Dead loads: E = -f . u."""

from kernels.arrays import dot
from kernels.compile.jit import jit_exact


@jit_exact
def evaluate(u, load, factor, g):
    """Return -f . u in J, f = ``factor`` x ``load`` (n,) in N; subtract f from ``g`` (n,)."""
    for i in range(u.size):
        g[i] -= factor * load[i]
    return -factor * dot(load, u)
