"""Bricks of 27 nodes of nearly incompressible neo-Hookean rubber, with a discontinuous linear
pressure (Q2-P1), which do not lock:

    E = integral of mu / 2 (J^(-2/3) F : F - 3)  +  K / 2 integral of q^2,

q the projection of J - 1 on linear functions in each brick, so that K q is the pressure that makes
the mixed energy stationary (T. Sussman and K.-J. Bathe, 1987).
"""

from itertools import product

import numpy as np

BULK = 200.0  # K / mu; Poisson's ratio is 0.4975
THREE = np.array([-(0.6**0.5), 0.0, 0.6**0.5]), np.array([5.0, 8.0, 5.0]) / 9.0


def _quadratics(x):
    """Values and slopes (3,) of the quadratics that are 1 at one of -1, 0, 1."""
    return (
        np.array([0.5 * x * (x - 1.0), 1.0 - x * x, 0.5 * x * (x + 1.0)]),
        np.array([x - 0.5, -2.0 * x, x + 0.5]),
    )


def _reference():
    """Weights (27,), slopes (27, 3, 27) of shape functions and 1, x, y, z (27, 4) at points."""
    at, weight = THREE
    weights, slopes, linear = [], [], []
    for i, j, k in product(range(3), repeat=3):
        (a, da), (b, db), (c, dc) = (_quadratics(at[m]) for m in (i, j, k))
        parts = (da, b, c), (a, db, c), (a, b, dc)
        slopes.append([np.einsum("i,j,k->ijk", *part).ravel() for part in parts])
        weights.append(weight[i] * weight[j] * weight[k])
        linear.append([1.0, at[i], at[j], at[k]])
    return np.array(weights), np.array(slopes), np.array(linear)


class Solid:
    """points (n, 3) in mm; nodes (e, 27), the last of the three axes fastest; modulus in MPa.

    u (3 n,): displacements of node after node, mm.
    """

    def __init__(self, points, nodes, modulus, bulk=BULK):
        weight, slopes, self.linear = _reference()
        map_ = np.einsum("qra,eai->eqri", slopes, points[nodes])
        self.points, self.nodes = points, nodes
        self.mu = modulus * (1.0 + 1.0 / (3.0 * bulk)) / 3.0
        self.bulk = bulk * self.mu
        self.weight = weight * np.linalg.det(map_)
        self.slopes = np.linalg.inv(map_) @ slopes  # (e, q, 3, 27)
        self.places = (3 * nodes[:, :, None] + np.arange(3)).reshape(len(nodes), 81)
        mass = np.einsum("eq,qk,ql->ekl", self.weight, self.linear, self.linear)
        self.inverse = np.linalg.inv(mass)
        self.size = points.size

    def _stretched(self, u):
        """F and its determinant at the points, and coefficients of q (e, 4)."""
        moved = u.reshape(-1, 3)[self.nodes][:, None]
        f = np.eye(3) + (self.slopes @ moved).swapaxes(2, 3)
        det = np.linalg.det(f)
        swell = np.einsum("eq,qk->ek", self.weight * (det - 1.0), self.linear)
        return f, det, np.einsum("ekl,el->ek", self.inverse, swell), swell

    def energy(self, u):
        """Energy in mJ, infinite where a brick is turned inside out."""
        f, det, found, swell = self._stretched(u)
        if det.min() <= 0.0:
            return np.inf
        density = 0.5 * np.einsum("eqij,eqij->eq", f, f) * det ** (-2.0 / 3.0) - 1.5
        return self.mu * np.sum(self.weight * density) + 0.5 * self.bulk * np.sum(found * swell)

    def _slope(self, u):
        """At the points: J, dW/dJ, half the F : F, and both slopes (e, q, 3, 27): of half of
        F : F, and of J.
        """
        f, det, found, _ = self._stretched(u)
        half = 0.5 * np.einsum("eqij,eqij->eq", f, f)
        push = self.bulk * found @ self.linear.T - 2.0 / 3.0 * self.mu * half * det ** (-5.0 / 3.0)
        turned = np.linalg.inv(f).swapaxes(2, 3) * det[..., None, None]
        return det, push, half, f @ self.slopes, turned @ self.slopes

    def gradient(self, u):
        """Forces on the nodes that hold the body in place, N."""
        det, push, _, grown, swell = self._slope(u)
        shear = self.mu * det ** (-2.0 / 3.0)
        stress = shear[..., None, None] * grown + push[..., None, None] * swell
        force = np.einsum("eq,eqia->eai", self.weight, stress)
        return np.bincount(self.places.ravel(), force.ravel(), minlength=self.size)

    def hessians(self, u):
        """Second derivatives of the bricks, (e, 81, 81).

        With s = J^(-2/3) and i = F : F / 2, of W = mu s i: mu s times 1 grad N_a . grad N_b; -2 /
        (3 J) of the products of slopes of i and J; 10 i / (9 J^2) of the products of slopes of J.
        Of the whole energy, dW/dJ times the second derivative of J: products of its slopes less
        their transposes, over J.
        """
        det, push, half, grown, swell = self._slope(u)
        shear = self.weight * self.mu * det ** (-2.0 / 3.0)
        flat, other = (x.swapaxes(2, 3).reshape(*det.shape, 81) for x in (swell, grown))
        turn = (flat * (self.weight * push / det)[..., None]).swapaxes(1, 2) @ flat
        four = turn.reshape(-1, 27, 3, 27, 3)
        found = four - four.swapaxes(2, 4)
        rows = self.slopes.reshape(len(det), -1, 27)
        laplace = (self.slopes * shear[..., None, None]).reshape(rows.shape).swapaxes(1, 2) @ rows
        for i in range(3):
            found[:, :, i, :, i] += laplace
        found = found.reshape(-1, 81, 81)
        mixed = (5.0 / 9.0 * shear * half / det**2)[..., None] * flat
        mixed -= (2.0 / 3.0 * shear / det)[..., None] * other
        mixed = flat.swapaxes(1, 2) @ mixed
        mean = (self.weight[..., None] * self.linear).swapaxes(1, 2) @ flat
        return found + mixed + mixed.swapaxes(1, 2) + (
            self.bulk * mean.swapaxes(1, 2) @ (self.inverse @ mean)
        )  # fmt: skip
