"""Compressible neo-Hookean rubber in plane stress, and in plane strain.

    W = mu/2 (F : F + s - 3) - mu ln J + lambda/2 (ln J)^2,    J = det F sqrt(s),

F (2, 2) in the plane, s the squared stretch across it, which makes W least:
mu (s - 1) + lambda ln J = 0. With L = ln det F, dW/dL at that s is p = -mu s. In plane
strain s is 1.
"""

from dataclasses import dataclass

import numpy as np

TOLERANCE = 1e-14  # of ln s


@dataclass(frozen=True)
class Rubber:
    """modulus: Young's, MPa."""

    modulus: float
    poisson: float

    @property
    def mu(self):
        """Shear modulus, MPa."""
        return self.modulus / (2.0 * (1.0 + self.poisson))

    @property
    def lame(self):
        """First Lamé constant, MPa."""
        return 2.0 * self.mu * self.poisson / (1.0 - 2.0 * self.poisson)

    def across(self, logarithm):
        """The s of L; Newton's steps from the linear solution fall towards the root."""
        mu, lame = self.mu, self.lame
        u = -lame * logarithm / (mu + 0.5 * lame)
        while True:
            s = np.exp(u)
            step = (mu * (s - 1.0) + lame * (logarithm + 0.5 * u)) / (mu * s + 0.5 * lame)
            u = u - step
            if np.max(np.abs(step)) < TOLERANCE * (1.0 + np.max(np.abs(u))):
                return np.exp(u)

    def energy(self, square, logarithm):
        """W in MPa from F : F and L."""
        s = self.across(logarithm)
        log_j = logarithm + 0.5 * np.log(s)
        return (
            0.5 * self.mu * (square + s - 3.0) - self.mu * log_j + 0.5 * self.lame * log_j * log_j
        )

    def uniaxial(self, stretch):
        """Nominal stress, MPa, of a bar that is free in the plane: mu (a - b^2 / a), where the
        stretch b across the bar has mu b^2 + p = 0, by Newton's steps in ln b.
        """
        a, v = np.asarray(stretch), -self.poisson * np.log(stretch)
        while True:
            p, slope = self.pressure(np.log(a) + v)
            square = self.mu * np.exp(2.0 * v)
            step = (square + p) / (2.0 * square + slope)
            v = v - step
            if np.max(np.abs(step)) < TOLERANCE * (1.0 + np.max(np.abs(v))):
                return self.mu * (a - np.exp(2.0 * v) / a)

    def pressure(self, logarithm):
        """Slope p = dW/dL and dp/dL in MPa."""
        s = self.across(logarithm)
        return -self.mu * s, self.mu * s * self.lame / (self.mu * s + 0.5 * self.lame)


class DeepRubber(Rubber):
    """The same in plane strain: dW/dL is p = lambda L - mu."""

    def across(self, logarithm):
        """No stretch."""
        return np.ones_like(logarithm)

    def pressure(self, logarithm):
        """Slope p = dW/dL and dp/dL in MPa."""
        return self.lame * logarithm - self.mu, np.full_like(logarithm, self.lame)


RUBBERS = {"stress": Rubber, "strain": DeepRubber}
