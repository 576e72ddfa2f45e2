"""Sparse systems of shells: Hessians, held coordinates, linear buckling loads, static states."""

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import coo_matrix, csc_matrix
from scipy.sparse.linalg import eigsh, spsolve

from kernels.plates.element import rotation, shell
from sweep.array_types import Floats
from tests.support.kernels.shells import LINEAR, Structure, element_hessians, virgin

Places = NDArray[np.int64]

STRAIN = 1e-5  # of the states between which stiffness is differentiated
ROUNDED = 1e-4  # steps below this change the energy by round-off


def coordinates(of: Structure) -> Places:
    """Coordinates (n, 6) of the nodes."""
    return np.arange(6 * len(of.points)).reshape(-1, 6)


def free(of: Structure, held: Places) -> Places:
    """Coordinates that are not ``held``."""
    return np.setdiff1d(coordinates(of).ravel(), held)


def stiffness(of: Structure, x: Floats) -> csc_matrix:
    """Hessian (6 n, 6 n) at ``x``."""
    own = element_hessians(of, x)
    at = (6 * of.walls.quads[:, :, None] + np.arange(6)).reshape(len(own), 24)
    rows, columns = np.repeat(at, 24, axis=1).ravel(), np.tile(at, (1, 24)).ravel()
    n = 6 * len(of.points)
    return coo_matrix((own.ravel(), (rows, columns)), shape=(n, n)).tocsc()


def energy(of: Structure, x: Floats) -> float:
    """Energy in J at ``x``."""
    room, g = shell.make_scratch(), np.zeros_like(x)
    return float(
        shell.evaluate(x, of.frames, of.walls, LINEAR, virgin(of, LINEAR), room, g, np.zeros(3))
    )


def slopes(of: Structure, x: Floats) -> Floats:
    """Gradient (6 n,) at ``x``."""
    room, g = shell.make_scratch(), np.zeros_like(x)
    shell.evaluate(x, of.frames, of.walls, LINEAR, virgin(of, LINEAR), room, g, np.zeros(3))
    return g[:-2]


def squeezed(of: Structure, strain: float) -> Floats:
    """Coordinates under uniform uniaxial compression along z by ``strain``, incompressible."""
    x = of.rest
    x[:-2].reshape(-1, 6)[:, :3] *= [1 + 0.5 * strain, 1 + 0.5 * strain, 1 - strain]
    return x


def buckling_strain(of: Structure, held: Places) -> tuple[float, Floats]:
    """Least strain at which K + strain dK/dstrain is singular, and its mode (6 n,)."""
    at = free(of, held)
    rest = stiffness(of, of.rest)[at][:, at]
    one, two = (stiffness(of, squeezed(of, e))[at][:, at] for e in (STRAIN, -STRAIN))
    slope = (one - two) / (2.0 * STRAIN)
    start = np.random.default_rng(0).uniform(-1, 1, at.size)
    values, modes = eigsh(-slope, k=4, M=rest, which="LA", v0=start)
    mode = np.zeros(6 * len(of.points))
    mode[at] = modes[:, -1]
    return float(1.0 / values[-1]), mode


def deflection(of: Structure, held: Places, force: Floats) -> Floats:
    """Small displacements (6 n,) under a ``force`` (6 n,)."""
    at, u = free(of, held), np.zeros(6 * len(of.points))
    u[at] = spsolve(stiffness(of, of.rest)[at][:, at], force[at])
    return u


def relaxed(of: Structure, x: Floats, held: Places, force: Floats) -> tuple[Structure, Floats]:
    """Equilibrium under dead forces (6 n,) on positions by Newton's method, from ``x``.

    The rotations are passed on to the frames after every step. Directions of negative stiffness are
    followed downhill, so that the state found is stable.
    """
    at, frames = free(of, held), of.frames.copy()
    moved = Structure(of.points, frames, of.walls)
    size = None
    for _ in range(200):
        rotation.rebase(frames, x)
        residual = slopes(moved, x) - force
        unit = of.unit[at]
        matrix = stiffness(moved, x)[at][:, at].toarray() * np.outer(unit, unit)
        values, modes = np.linalg.eigh(matrix)
        dx = -modes @ ((modes.T @ (residual[at] * unit)) / np.abs(values))
        largest = np.abs(dx).max()
        dx *= unit * min(1.0, 0.3 / largest)
        before = energy(moved, x) - force @ x[:-2]
        for _ in range(30):
            tried = x.copy()
            tried[at] += dx
            if largest < ROUNDED or energy(moved, tried) - force @ tried[:-2] <= before:
                break
            dx *= 0.5
        x = tried
        if largest < 1e-8 and values[0] > 0.0:
            rotation.rebase(frames, x)
            return moved, x
        size = largest
    raise RuntimeError(f"no equilibrium after 200 steps; the last one was {size:g}")
