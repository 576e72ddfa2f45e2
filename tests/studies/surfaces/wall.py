"""The solid wall about a gyroid of period 1: all points nearer to it than half of the thickness t.

Its volume in a period is A t + K t^3 / 12 (J. Steiner), as the mean curvature is zero: A is the
area, and K the integral of the Gaussian curvature, 2 pi times the Euler characteristic -8.
"""

import numpy as np

from sweep.design.surfaces.names import SHEETS
from tests.studies.surfaces.period import GYROID

CURVATURE = -16.0 * np.pi
FEET = 8  # rounds towards the foot of a point
ON = 1e-5  # last move of a point that is on the surface
FLAT = 1e-3  # slope, below which no foot is found


def density(thickness):
    """The share of the period that is solid."""
    return SHEETS["gyroid"].area * thickness + CURVATURE * thickness**3 / 12.0


def thickness_of(share):
    """The thickness of the wall that fills this share of the period."""
    roots = np.roots([CURVATURE / 12.0, 0.0, SHEETS["gyroid"].area, -share])
    return float(min(root.real for root in roots if abs(root.imag) < 1e-12 and root.real > 0.0))


def distance(points):
    """Distance to the surface of points (n, 3), exact near to it, infinite where no foot is found.

    From its foot so far, a point of the surface, each point is reached by a vector. The tangential
    part of this moves the foot, which Newton's method takes back to the surface. The error falls by
    the square of distance over radius of curvature a round, from less than 1/9.
    """
    foot = points
    for _ in range(FEET):
        value, normal, foot = _nearer(foot)
        value, normal, foot = _nearer(foot)
        arm = points - foot
        foot = foot + arm - (arm * normal).sum(axis=1)[:, None] * normal
    return np.where(np.abs(value) < ON, np.linalg.norm(arm, axis=1), np.inf)


def _nearer(points):
    """Distance by Newton's method, unit normal, and the points moved by it."""
    phases = 2.0 * np.pi * points
    slope = 2.0 * np.pi * GYROID.gradient(phases)
    steep = np.maximum(np.linalg.norm(slope, axis=1), FLAT)
    away, normal = GYROID.value(phases) / steep, slope / steep[:, None]
    return away, normal, points - away[:, None] * normal
