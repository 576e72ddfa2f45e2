"""What is out of balance, and how much of it counts as none."""

from typing import NamedTuple

from kernels.compile.jit import jit, jit_exact


class Tolerance(NamedTuple):
    """What counts as converged.

    force: largest residual in N. decrement: largest Newton decrement in J. friction: largest change
    of a lagged force in N; grip: the same as a share of the greatest one. noise: energy changes
    below it are round-off, J. finest: a move that positions cannot resolve, m. iterations: most for
    one minimum.
    """

    force: float
    decrement: float
    friction: float
    grip: float
    noise: float
    finest: float
    iterations: int


@jit_exact
def largest(residual, coordinates):
    """Return the largest residual of the free coordinates in N; NaN if any is."""
    most = 0.0
    for i in range(residual.size):
        size = abs(residual[i]) * coordinates.lever[i] if i != coordinates.driven else 0.0
        if not size <= most:
            most = size
            if size != size:
                return size
    return most


@jit_exact
def allowed(stiffest, tolerance):
    """Return the largest residual in N and Newton decrement in J that count as none: no less than
    what the ``stiffest`` coordinate (N/m) answers to a move too fine for its position.
    """
    force = max(tolerance.force, tolerance.finest * stiffest)
    return force, tolerance.decrement * (force / tolerance.force) ** 2


@jit
def loosened(tolerance, times):
    """Return the tolerance of a minimum that may miss by ``times`` as much."""
    return Tolerance(
        times * tolerance.force,
        times * times * tolerance.decrement,
        tolerance.friction,
        tolerance.grip,
        tolerance.noise,
        tolerance.finest,
        tolerance.iterations,
    )
