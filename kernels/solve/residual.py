"""What is out of balance, and how much of it counts as none."""

from typing import NamedTuple

import numpy as np

from kernels.linear import periodic_images as image
from kernels.compile.jit import jit, jit_exact
from kernels.arrays import zero


class Tolerance(NamedTuple):
    """What counts as converged.

    force: largest residual in N. decrement: largest Newton decrement in J. friction: largest change
    of a lagged friction force in N; grip: the same as a share of the greatest one. noise: energy
    changes below it are round-off, J. finest: a move that positions cannot resolve, m. iterations:
    most for one minimum.
    """

    force: float
    decrement: float
    friction: float
    grip: float
    noise: float
    finest: float
    iterations: int


class Unknowns(NamedTuple):
    """Which coordinates move, and how far at once.

    leader, ratio (n,), images (k, 4): as in `pattern.Layout`. scale (n,): length that turns a
    coordinate into m, 1 for one in m; lever (n,): its inverse. driven: coordinate that is led to a
    target, -1 if none. cap: longest move in one iteration, m. leap: first move along a direction of
    negative curvature, m. close: a move so short that stability cannot have been lost on it, m.
    """

    leader: np.ndarray
    ratio: np.ndarray
    images: np.ndarray
    scale: np.ndarray
    lever: np.ndarray
    driven: int
    cap: float
    leap: float
    close: float


@jit
def reduce(g, unknowns, residual):
    """Fill ``residual`` (n,) with ``g``, what is tied added to its leader, zero where held."""
    zero(residual)
    for i in range(g.size):
        leader = unknowns.leader[i]
        if leader == i:
            residual[i] += g[i]
        elif leader >= 0:
            residual[leader] += unknowns.ratio[i] * g[i]
    image.collect(unknowns.images, residual)


@jit_exact
def largest(residual, unknowns):
    """Return the largest residual of the free coordinates in N; NaN if any is."""
    most = 0.0
    for i in range(residual.size):
        size = abs(residual[i]) * unknowns.lever[i] if i != unknowns.driven else 0.0
        if not size <= most:
            most = size
            if size != size:
                return size
    return most


@jit_exact
def allowed(matrix, tolerance):
    """Return the largest residual in N and Newton decrement in J that count as none: no less than
    what the stiffest coordinate of the last factor answers to a move too fine for its position.
    """
    stiffest = 0.0
    for h in range(matrix.own.size):
        if h % 3 != 2:
            stiffest = max(stiffest, matrix.own[h])
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
