"""Stiffness of one period of the solid wall about a gyroid, by bricks of a regular grid.

The period, of length 1, is divided into n^3 cubes with trilinear displacements, each of 4^3 parts.
A part counts with its solid share, 1/2 + (t / 2 - d) / a between 0 and 1: d is the distance of its
centre from the surface and a its side. The stiffness of a cube that the faces of the wall cut is
the sum of its parts' exact ones, each times its share. These are displacements of the true wall, so
that C11 and C44 of all grids are upper bounds, to the accuracy of the shares, and tend to the limit
as n^(-2). The other rule, ``weighted``, multiplies the stiffness of a whole cube by its share.

Symmetry leaves a sixteenth of the period (`symmetry`). Conjugate gradients with the diagonal as
preconditioner solve for the periodic displacement.
"""

from itertools import product
from typing import NamedTuple

import numpy as np
from scipy.sparse import csr_array, diags_array
from scipy.sparse.linalg import cg

from tests.studies.surfaces import symmetry, wall
from tests.studies.surfaces.moduli import Cubic, tensor

PARTS = 4  # along each side of a cube
CORNERS = np.array(list(product((0, 1), repeat=3)))
TOLERANCE = 1e-6  # of the residual
SMALL = 1e-12  # a residual of rounding alone, of modulus and period 1


def elastic(poisson):
    """Stiffness (6, 6) of an isotropic solid of modulus 1, over the strains of `moduli`."""
    shear = 0.5 / (1.0 + poisson)
    whole = np.diag([2.0 * shear] * 3 + [shear] * 3)
    whole[:3, :3] += 2.0 * shear * poisson / (1.0 - 2.0 * poisson)
    return whole


def _strains(at):
    """Strains (6, 24) at a point of a cube of side 1, over the displacements of its corners."""
    each = np.where(CORNERS == 1, at, 1.0 - np.asarray(at))
    way = 2.0 * CORNERS - 1.0
    slope = np.stack(
        [way[:, k] * np.delete(each, k, axis=1).prod(axis=1) for k in range(3)], axis=1
    )
    found = np.zeros((6, 8, 3))
    for k in range(3):
        found[k, :, k] = slope[:, k]
        i, j = (k + 1) % 3, (k + 2) % 3
        found[3 + k, :, i], found[3 + k, :, j] = slope[:, j], slope[:, i]
    return found.reshape(6, 24)


def brick_parts(poisson):
    """Stiffnesses (PARTS^3, 24, 24) of the parts of a cube of side 1 and modulus 1."""
    law, found = elastic(poisson), []
    points = 0.5 + np.array([-0.5, 0.5]) / np.sqrt(3.0)
    for first in product(range(PARTS), repeat=3):
        places = [(np.array(first) + p) / PARTS for p in product(points, repeat=3)]
        found.append(sum((b := _strains(at)).T @ law @ b for at in places) / 8 / PARTS**3)
    return np.array(found)


class Cubes(NamedTuple):
    """Cubes of the model that are at least in part solid. at (m, 3): of n^3. shares (m, PARTS^3):
    solid shares of their parts. n: along the period.
    """

    at: np.ndarray
    shares: np.ndarray
    n: int


def cubes(n, thickness, members):
    """The `Cubes` of the part of the period that the operations ``members`` repeat."""
    at = symmetry.cells(members, n)
    away = wall.distance((at + 0.5) / n)
    reach = 0.5 * np.sqrt(3.0) / n
    at, away = at[away < 0.5 * thickness + reach], away[away < 0.5 * thickness + reach]
    shares = np.ones((len(at), PARTS**3))
    cut = away > 0.5 * thickness - reach
    inner = (np.array(list(product(range(PARTS), repeat=3))) + 0.5) / PARTS
    points = (at[cut][:, None] + inner) / n
    apart = wall.distance(points.reshape(-1, 3)).reshape(-1, PARTS**3)
    shares[cut] = np.clip(0.5 + (0.5 * thickness - apart) * n * PARTS, 0.0, 1.0)
    solid = shares.any(axis=1)
    return Cubes(at[solid], shares[solid], n)


class Solid(NamedTuple):
    """Results of the bricks for a wall: its stiffnesses, and its solid share of the period."""

    cubic: Cubic
    density: float


def solid(n, thickness, poisson=0.3, weighted=False):
    """The `Solid` of a wall of this thickness about a gyroid, on n^3 cubes; n: a multiple of 4."""
    members = symmetry.group()
    of = cubes(n, thickness, members)
    bricks = Voxels(of, members, poisson, weighted)
    normal, sheared = bricks.column(0), bricks.column(3)
    share = len(members) * of.shares.mean(axis=1).sum() / n**3
    return Solid(Cubic(normal[0], normal[1], sheared[3]), share)


class Voxels:
    """Bricks of one period. members: operations of `symmetry` that repeat the cubes."""

    def __init__(self, of, members, poisson=0.3, weighted=False):
        self.at, self.n, self.members = of.at, of.n, members
        shares = of.shares
        if weighted:
            shares = np.repeat(shares.mean(axis=1)[:, None], PARTS**3, axis=1)
        parts = brick_parts(poisson).reshape(PARTS**3, -1)
        self.bricks = (shares @ parts).reshape(-1, 24, 24) / of.n

    def column(self, component):
        """Stresses of the `moduli.PAIRS` that a unit strain of one of them needs, (6,).

        A stress that some operation multiplies by another sign than that strain is zero.
        """
        character = symmetry.characters(self.members, component)
        corners = (self.at[:, None] + CORNERS).reshape(-1, 3)
        nodes = symmetry.follow(self.members, character, corners, self.n)
        used, number = np.unique(nodes.number, return_inverse=True)
        unknown = (3 * number.reshape(-1, 8)[..., None] + np.arange(3)).reshape(-1, 24)
        sign, size = nodes.sign.reshape(-1, 24), 3 * len(used)
        uniform = [(CORNERS @ tensor(e) / self.n).ravel() for e in np.eye(6)]
        pushed = self.bricks @ np.stack(uniform, axis=1)
        force = np.bincount(unknown.ravel(), (sign * pushed[..., component]).ravel(), size)
        move = solved(self._matrix(unknown, sign, size), -force)
        stress = uniform @ pushed.sum(axis=0)[:, component]
        stress += np.einsum("mik,mi->k", pushed, sign * move[unknown])
        like = [np.all(symmetry.characters(self.members, k) == character) for k in range(6)]
        return len(self.members) * np.where(like, stress, 0.0)

    def _matrix(self, unknown, sign, size):
        """The stiffness over the unknowns."""
        rows = np.repeat(unknown.astype(np.int32), 24, axis=1).ravel()
        columns = np.tile(unknown.astype(np.int32), (1, 24)).ravel()
        values = (sign[:, :, None] * self.bricks * sign[:, None, :]).ravel()
        return csr_array((values, (rows, columns)), (size, size))


def solved(matrix, force):
    """The solution, zero where the matrix is; RuntimeError if it does not converge."""
    diagonal = matrix.diagonal()
    scale = np.where(diagonal > 0.0, 1.0 / np.where(diagonal > 0.0, diagonal, 1.0), 0.0)
    move, failure = cg(
        matrix, force, rtol=TOLERANCE, atol=SMALL, maxiter=20_000, M=diags_array(scale).tocsr()
    )
    if failure:
        raise RuntimeError("The conjugate gradients do not converge in 20,000 iterations")
    return move
