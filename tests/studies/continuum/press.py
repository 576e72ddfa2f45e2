"""A grid between glued platens that come together: a minimum of the energy at every strain.

Newton's method on the energy with the exact Hessian. Its pivots show whether it is positive
definite; where it is not, a multiple of its diagonal at rest is added, and a falling energy leads
away from an unstable branch.
"""

from dataclasses import dataclass, field

import numpy as np
from scipy.sparse import diags_array
from scipy.sparse.linalg import splu

SYMMETRIC = {"diag_pivot_thresh": 0.0, "options": {"SymmetricMode": True}}
TOLERANCE = 1e-7  # of the residual, N
ENOUGH = 200  # iterations
FINEST = 2.0**-10  # of a step of the strain
NEAR = 1e-12  # of strains
HALVINGS = 30
ARMIJO, ROUND_OFF = 1e-4, 1e-13


class StuckError(RuntimeError):
    """No minimum was found within the iterations allowed."""


@dataclass
class Curve:
    """A crush, row by row: strain, force in N, energy in mJ; and where the nodes end, mm."""

    rows: list = field(default_factory=lambda: [(0.0, 0.0, 0.0)])
    shape: np.ndarray | None = None

    def at(self, strain):
        """Force and energy at strains up to the last."""
        strains, force, energy = np.array(self.rows).T
        if np.max(strain) > strains[-1] + NEAR:
            raise ValueError(f"the crush ended at a strain of {strains[-1]}")
        return np.interp(strain, strains, force), np.interp(strain, strains, energy)


def factor(matrix):
    """Factor of a symmetric matrix; None unless it is positive definite."""
    try:
        found = splu(matrix.tocsc(), "MMD_AT_PLUS_A", **SYMMETRIC)
    except RuntimeError:  # singular
        return None
    definite = np.array_equal(found.perm_r, found.perm_c) and found.U.diagonal().min() > 0.0
    return found if definite else None


class Press:
    """solid: the body, glued at its lowest and highest nodes. touch: its contact, if it has any.

    height: to which strains refer, mm. tolerance: of the residual, N.
    """

    tolerance = TOLERANCE

    def __init__(self, solid, height, touch=None):
        self.body, self.touch, self.size = solid, touch, solid.size
        self.terms = [solid] if touch is None else [solid, touch]
        y = solid.points[:, 1]
        low, self.high = (np.flatnonzero(np.isclose(y, edge)) for edge in (y.min(), y.max()))
        held = np.concatenate([low, self.high])
        fixed = (2 * held[:, None] + np.arange(2)).ravel()
        self.free = np.setdiff1d(np.arange(self.size), fixed)
        self.drive = np.zeros(self.size)
        self.drive[2 * self.high + 1] = -height
        rest = solid.hessian(np.zeros(self.size))
        self.damper = rest[self.free][:, self.free].diagonal()

    def energy(self, u):
        """Energy of all terms, mJ."""
        return sum(term.energy(u) for term in self.terms)

    def gradient(self, u):
        """Gradient of all terms, N."""
        return sum(term.gradient(u) for term in self.terms)

    def hessian(self, u):
        """Hessian of all terms."""
        return sum((term.hessian(u) for term in self.terms[1:]), self.terms[0].hessian(u))

    def room(self, u, step):
        """Share of a step that contact allows."""
        return 1.0 if self.touch is None else self.touch.room(u, step)

    def _solver(self, matrix):
        """Factor of the free part, and whether it is definite without help."""
        inner, shift = matrix[self.free][:, self.free], 0.0
        while (found := factor(inner + diags_array(shift * self.damper))) is None:
            shift = max(4.0 * shift, 1e-6)
        return found, shift == 0.0

    def settle(self, u):
        """The minimum that Newton's steps downhill lead to, with the platens where they are."""
        energy = self.energy(u)
        for _ in range(ENOUGH):
            gradient, step = self.gradient(u), np.zeros(self.size)
            solver, definite = self._solver(self.hessian(u))
            step[self.free] = -solver.solve(gradient[self.free])
            if definite and np.abs(gradient[self.free]).max() < self.tolerance:
                return u
            share = self.room(u, step)
            for _ in range(HALVINGS):
                there = self.energy(u + share * step)
                if there <= energy + ARMIJO * share * (gradient @ step) + ROUND_OFF * energy:
                    break
                share *= 0.5
            else:
                raise StuckError("the energy does not fall")
            u, energy = u + share * step, there
        raise StuckError(f"no minimum after {ENOUGH} iterations")

    def onwards(self, u, by):
        """Predicted move of the coordinates as the strain grows, along the tangent."""
        ahead, matrix = by * self.drive, self.hessian(u)
        solver, _ = self._solver(matrix)
        ahead[self.free] = -solver.solve((matrix @ ahead)[self.free])
        return ahead

    def force(self, gradient):
        """Force of the upper platen, N."""
        return -float(gradient[2 * self.high + 1].sum())

    def crush(self, strains):
        """Curve over rising strains; a step that fails is cut in two."""
        curve, u, now = Curve(), np.zeros(self.size), 0.0
        for strain in strains:
            share = 1.0
            while now < strain - NEAR:
                by = share * (strain - now)
                try:
                    u, now, share = self._step(u, by), now + by, 1.0
                except StuckError:
                    share *= 0.5
                    if share < FINEST:
                        raise
            curve.rows.append((strain, self.force(self.gradient(u)), self.energy(u)))
        curve.shape = u
        return curve

    def _step(self, u, by):
        ahead = self.onwards(u, by)
        if self.room(u, ahead) < 1.0 or not np.isfinite(self.energy(u + ahead)):
            raise StuckError("walls are in the way")
        return self.settle(u + ahead)
