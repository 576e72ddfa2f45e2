"""Quadratic quadrilaterals of rubber: energy, gradient and Hessian of nodal displacements."""

from functools import cached_property

import numpy as np
from scipy.sparse import csc_array
from skfem import Basis, ElementQuad2

ORDER = 5  # of the polynomials that the quadrature integrates exactly: 3 x 3 points


class Solid:
    """A mesh of a thickness ``depth`` (mm) out of its plane. u (2 n,): x, y of node after node."""

    def __init__(self, mesh, rubber, depth):
        basis = Basis(mesh, ElementQuad2(), intorder=ORDER)
        self.rubber, self.mesh, self.basis = rubber, mesh, basis
        self.points = np.ascontiguousarray(basis.doflocs.T)
        self.nodes = np.ascontiguousarray(basis.element_dofs.T)  # (e, 9)
        self.weight = basis.dx * depth  # (e, q)
        slopes = np.array([field.grad for (field,) in basis.basis])  # (9, 2, e, q)
        self.slopes = np.ascontiguousarray(slopes.transpose(2, 3, 1, 0))
        self.size = 2 * len(self.points)
        self.unknowns = (2 * self.nodes[:, :, None] + np.arange(2)).reshape(len(self.nodes), 18)

    @cached_property
    def _pattern(self):
        """Places of all entries of element matrices in the sorted list of entries of the whole
        matrix.
        """
        row, column = np.broadcast_arrays(self.unknowns[:, :, None], self.unknowns[:, None, :])
        keys, place = np.unique((column * self.size + row).ravel(), return_inverse=True)
        column, row = np.divmod(keys, self.size)
        start = np.searchsorted(column, np.arange(self.size + 1))
        return place, row, start

    @cached_property
    def _laplace(self):
        """Integrals of grad N_a . grad N_b, (e, 9, 9)."""
        weighted = self.slopes * self.weight[:, :, None, None]
        return np.einsum("eqja,eqjb->eab", weighted, self.slopes, optimize=True)

    def _stretched(self, u):
        """F (e, q, 2, 2) and its determinant (e, q)."""
        f = np.eye(2) + (self.slopes @ u.reshape(-1, 2)[self.nodes][:, None]).swapaxes(2, 3)
        return f, f[..., 0, 0] * f[..., 1, 1] - f[..., 0, 1] * f[..., 1, 0]

    def energy(self, u):
        """Energy in mJ, infinite where an element is turned inside out."""
        f, det = self._stretched(u)
        if det.min() <= 0.0:
            return np.inf
        density = self.rubber.energy(np.einsum("eqij,eqij->eq", f, f), np.log(det))
        return float(np.sum(self.weight * density))

    def _spatial(self, u):
        """F, p, dp/dL, and gradients of shape functions in the deformed body, (e, q, 2, 9)."""
        f, det = self._stretched(u)
        p, slope = self.rubber.pressure(np.log(det))
        a, b, c, d = f[..., 0, 0], f[..., 0, 1], f[..., 1, 0], f[..., 1, 1]
        inverse = np.moveaxis(np.array([[d, -c], [-b, a]]) / det, (0, 1), (2, 3))  # transposed
        return f, p, slope, inverse @ self.slopes

    def gradient(self, u):
        """Forces on the nodes that hold the body in place, N: P = mu F + p F^-T."""
        f, p, _, spatial = self._spatial(u)
        stress = self.rubber.mu * (f @ self.slopes) + p[..., None, None] * spatial
        force = np.einsum("eq,eqia->eai", self.weight, stress, optimize=True)
        return np.bincount(self.unknowns.ravel(), force.ravel(), minlength=self.size)

    def hessian(self, u):
        """Sum of mu 1 grad N_a . grad N_b, dp/dL g_a g_b and -p g_b g_a, g = F^-T grad N."""
        _, p, slope, spatial = self._spatial(u)
        flat = spatial.swapaxes(2, 3).reshape(*p.shape, 18)
        volume = (flat * (self.weight * slope)[..., None]).swapaxes(1, 2) @ flat
        turned = (flat * (self.weight * p)[..., None]).swapaxes(1, 2) @ flat
        matrix = volume.reshape(-1, 9, 2, 9, 2) - turned.reshape(-1, 9, 2, 9, 2).swapaxes(2, 4)
        for i in range(2):
            matrix[:, :, i, :, i] += self.rubber.mu * self._laplace
        place, row, start = self._pattern
        data = np.bincount(place, matrix.ravel(), minlength=len(row))
        return csc_array((data, row, start), shape=(self.size, self.size))
