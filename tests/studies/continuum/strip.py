"""A strip of rubber bent into a circle: the moment that a thick section bears.

A line at z, of -t/2 to t/2, becomes an arc of radius r(z) and is stretched by kappa r along and r'
across; r makes the energy of the section least. kappa: turn per length at rest.
"""

import numpy as np
from scipy.optimize import minimize

LAYERS = 60
STEP = 0.01  # of the curvature: central difference


def energy(rubber, kappa):
    """Energy of a length of 1 of a strip of thickness 1."""

    def of(q):
        r = q[0] + np.concatenate([[0.0], np.cumsum(q[1:])]) / LAYERS
        along, across = kappa * 0.5 * (r[1:] + r[:-1]), q[1:]
        if min(along.min(), across.min()) <= 0.0:
            return np.inf
        return np.mean(rubber.energy(along**2 + across**2, np.log(along * across)))

    start = np.concatenate([[1.0 / kappa - 0.5], np.ones(LAYERS)])
    return minimize(of, start, method="BFGS", options={"gtol": 1e-9}).fun


def moment(rubber, kappa):
    """Moment of a strip of thickness 1."""
    near = 0.5 * STEP * kappa
    return (energy(rubber, kappa + near) - energy(rubber, kappa - near)) / (2.0 * near)


def softening(rubber, stiffness, kappa):
    """1 - M / (Y I kappa). stiffness: Y I."""
    return 1.0 - moment(rubber, kappa) / (stiffness * kappa)
