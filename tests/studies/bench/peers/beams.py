"""Corotational beams in numpy: what linear walls store that neither touch nor fold.

    E = sum Y A l0 e^2 / 2 + a . K a / 2,   e = l / l0 - 1 + a . C a / 2

An element runs along its chord l t with the bearing beta; its ends turn by a_i = beta - phi_i from
rest. q = (l, a_1, a_2) has the derivatives B = dq/du in the six coordinates u of both ends, with
t^ = dl/du and n^ / l = dbeta/du, and N, M_i = dE/dq:

    dE/du = B^T (N, M_1, M_2)
    d2E/du2 = B^T E'' B + N / l n^ n^T - (M_1 + M_2) / l^2 (t^ n^T + n^ t^T)

All elements at once, the Hessian by a linear map found before into a band for LAPACK's Cholesky.
"""

from typing import NamedTuple

import numpy as np
from scipy.linalg import lapack
from scipy.sparse import csr_array
from scipy.sparse.csgraph import reverse_cuthill_mckee


class Material(NamedTuple):
    """Of every element: l0 (m,), Y A (m,), K (m, 2, 2), C (m, 2, 2) and bearing at rest (m,)."""

    l0: np.ndarray
    axial: np.ndarray
    bending: np.ndarray
    arc: np.ndarray
    rest: np.ndarray

    @classmethod
    def of(cls, terms):
        """The data of a scene."""
        (k11, k12, k22), (same, mixed) = terms.bend.stiffness, terms.stretch.arc
        return cls(
            terms.stretch.l0,
            terms.law.modulus * terms.stretch.area,
            np.array([[k11, k12], [k12, k22]]).transpose(2, 0, 1),
            np.array([[2.0 * same, mixed], [mixed, 2.0 * same]]).transpose(2, 0, 1),
            np.arctan2(*terms.walls.rest.T[::-1]),
        )


class Found(NamedTuple):
    """Energy, gradient (n,) and Hessians of the elements, (m, 6, 6)."""

    energy: float
    gradient: np.ndarray
    hessian: np.ndarray


def sparse(rows, columns, values, shape):
    """Matrix from its entries; those at one place add up."""
    values = np.broadcast_to(values, np.shape(columns)).ravel()
    return csr_array((values, (np.ravel(rows), np.ravel(columns))), shape)


class Beams:
    """What walls store, over the coordinates ``free`` (n,) that nothing holds, in an order that
    makes the Hessian a narrow band.
    """

    def __init__(self, scene):
        self.given, self.dofs = Material.of(scene.terms), scene.terms.walls.dofs
        self.x, m, leader = scene.x_rest.copy(), len(self.dofs), scene.terms.layout.leader
        free = np.flatnonzero(leader == np.arange(leader.size))
        span = sparse(np.arange(m).repeat(6), self.dofs, 1.0, (m, leader.size))[:, free]
        linked = (span.T @ span).tocsr()
        self.free = free[reverse_cuthill_mckee(linked, symmetric_mode=True)]
        place = np.full(leader.size, -1)
        place[self.free] = np.arange(self.free.size)
        at = place[self.dofs]
        kept = at >= 0
        number = np.arange(at.size).reshape(at.shape)
        self.gather = sparse(at[kept], number[kept], 1.0, (self.free.size, at.size))
        i, j = np.broadcast_arrays(at[:, :, None], at[:, None, :])
        kept = (i >= j) & (j >= 0)
        self.width = 1 + (i - j)[kept].max()
        value = np.arange(i.size).reshape(i.shape)
        shape = self.free.size * self.width, i.size
        self.assemble = sparse((j * self.width + i - j)[kept], value[kept], 1.0, shape)

    def found(self, x):
        """Energy and its derivatives at ``x`` (n,)."""
        self.x[self.free] = x
        l0, axial, bending, arc, rest = self.given
        u = self.x[self.dofs]
        e = u[:, 3:5] - u[:, :2]
        length = np.hypot(*e.T)
        tx, ty = e.T / length
        none = np.zeros_like(tx)
        t = np.column_stack([-tx, -ty, none, tx, ty, none])
        n = np.column_stack([ty, -tx, none, -ty, tx, none])
        deformed = np.stack([t, n / length[:, None], n / length[:, None]], axis=1)
        deformed[:, [1, 2], [2, 5]] = -1.0
        a = np.arctan2(e[:, 1], e[:, 0])[:, None] - rest[:, None] - u[:, [2, 5]]
        a -= 2.0 * np.pi * np.round(a / (2.0 * np.pi))
        slope = np.einsum("kij,kj->ki", arc, a)
        strain = length / l0 - 1.0 + 0.5 * np.sum(a * slope, axis=1)
        of_strain, pull = np.column_stack([1.0 / l0, slope]), axial * l0 * strain
        moment = np.einsum("kij,kj->ki", bending, a)
        force = pull[:, None] * of_strain
        force[:, 1:] += moment
        rigidity = (axial * l0)[:, None, None] * of_strain[:, :, None] * of_strain[:, None, :]
        rigidity[:, 1:, 1:] += pull[:, None, None] * arc + bending
        hessian = deformed.transpose(0, 2, 1) @ rigidity @ deformed
        hessian += (force[:, 0] / length)[:, None, None] * n[:, :, None] * n[:, None, :]
        curl = (force[:, 1] + force[:, 2]) / length**2
        both = t[:, :, None] * n[:, None, :]
        hessian -= curl[:, None, None] * (both + both.transpose(0, 2, 1))
        energy = 0.5 * (pull @ strain + np.sum(moment * a))
        g = self.gather @ np.einsum("ki,kij->kj", force, deformed).ravel()
        return Found(energy, g, hessian)

    def band(self, found):
        """Lower band of the Hessian, (width, n)."""
        return (self.assemble @ found.hessian.ravel()).reshape(-1, self.width).T

    def towards(self, found, diagonal, g):
        """Newton's step, with more on the diagonal of the Hessian, which has to be positive."""
        band = self.band(found)
        band[0] += diagonal
        _, dx, failed = lapack.dpbsv(band, -g, lower=1, overwrite_ab=1)
        if failed:
            raise np.linalg.LinAlgError(f"pivot {failed} is not positive")
        return dx
