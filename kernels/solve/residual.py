"""The residual of an equilibrium, and its tolerances."""

from typing import NamedTuple

from kernels.compile.jit import jit_exact

MOST_CUT_MOVES = 20  # most shortened moves of a dynamic step: beyond, a shorter step costs less


class Tolerance(NamedTuple):
    """Criteria of convergence.

    force: largest residual, N. decrement: largest Newton decrement, J. noise: energy differences
    below it are round-off, J. resolution: smallest move that positions can resolve, m. iterations:
    most Newton iterations of one minimisation. cut_moves: most shortened moves of a dynamic step.
    share: of the largest force so far, which the residual may reach where that is more.
    """

    force: float
    decrement: float
    noise: float
    resolution: float
    iterations: int
    cut_moves: int = MOST_CUT_MOVES
    share: float = 0.0


@jit_exact
def largest_residual(residual, coordinates):
    """Return the largest residual of the free coordinates in N, NaN if any is NaN.

    residual (n,): from `Problem.reduce`. The driven coordinate, a support, is left out.
    """
    largest_size = 0.0
    for i in range(residual.size):
        size = abs(residual[i]) * coordinates.lever[i] if i != coordinates.driven else 0.0
        if not size <= largest_size:
            largest_size = size
            if size != size:
                return size
    return largest_size


@jit_exact
def allowed(stiffest, tolerance):
    """Return the admissible residual in N.

    It is at least the force of the ``stiffest`` coordinate (N/m) in a move of
    ``tolerance.resolution``.
    """
    return max(tolerance.force, tolerance.resolution * stiffest)


@jit_exact
def allowed_decrement(stiffest, tolerance, n):
    """Return the admissible Newton decrement of ``n`` coordinates in J.

    It is at least the energy of moves of ``tolerance.resolution`` against the ``stiffest``
    coordinate (N/m): an admissible residual that can release more energy belongs to softer
    coordinates, and is no round-off.
    """
    return max(tolerance.decrement, n * stiffest * tolerance.resolution**2)


@jit_exact
def scaled(tolerance, factor, sharpness):
    """Return the tolerance with the residual times ``factor``, the decrement times its square, and
    the resolution times ``sharpness``.
    """
    return Tolerance(
        factor * tolerance.force,
        factor * factor * tolerance.decrement,
        tolerance.noise,
        sharpness * tolerance.resolution,
        tolerance.iterations,
        tolerance.cut_moves,
        tolerance.share,
    )


@jit_exact
def loosened(tolerance, largest):
    """Return the tolerance whose residual is at least its share of the ``largest`` force so far, N.

    The decrement, the energy of that residual in a move, grows in proportion.
    """
    factor = max(1.0, tolerance.share * largest / tolerance.force)
    return Tolerance(
        factor * tolerance.force,
        factor * tolerance.decrement,
        tolerance.noise,
        tolerance.resolution,
        tolerance.iterations,
        tolerance.cut_moves,
        tolerance.share,
    )


@jit_exact
def patient(tolerance, doublings):
    """Return the tolerance with its iterations doubled ``doublings`` times, all of whose moves may
    be shortened.
    """
    iterations = tolerance.iterations << doublings
    return Tolerance(
        tolerance.force,
        tolerance.decrement,
        tolerance.noise,
        tolerance.resolution,
        iterations,
        iterations,
        tolerance.share,
    )
