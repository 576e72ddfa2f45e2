"""Structures on a floor, and walls pressed upon one another."""

import numpy as np
from scipy.optimize import brentq

from tests.studies.validation.problem import Problem
from tests.support.designs.structures import (
    BENDING,
    CLAMPED,
    DEPTH,
    GRAVITY,
    LENGTH,
    MASS,
    MATERIAL,
    MM,
    ROD,
    THICKNESS,
    let_go,
    probe,
    pushed,
)

L, G = LENGTH * MM, GRAVITY * MM
SMOOTH = dict(friction=0.0)
HEAVY = dict(model="rayleigh", mass=50.0, stiffness=1e-3)


def dropped(pieces):
    """Force on the floor over its weight of a rod that has fallen and come to rest."""
    parts = ROD | {"gravity_mm_s2": [0, -GRAVITY], "floor_y_mm": -2.0, "subdivide": pieces}
    return let_go(parts, 0.4, 5e-4, SMOOTH, HEAVY).history["reaction_bottom_N"][-1] / (MASS * G)


GAP, SAG = 0.2, 1.0  # mm: below the wall's face; where its weight alone would bend the end to


def on_floor(pieces):
    """Force of a floor on the end of a cantilever that its weight bends down to it.

    Over that which lifts the end from where it would be without the floor. Weights are lumped at
    the nodes, which is of second order.
    """
    weight = 8.0 * BENDING * SAG * MM / L**3 / MASS / MM  # mm/s^2, w L^4 / 8 Y I = SAG
    parts = ROD | {
        "supports": [{"node": 0, "fix": CLAMPED}],
        "gravity_mm_s2": [0, -weight],
        "floor_y_mm": -0.5 * THICKNESS - GAP,
        "subdivide": pieces,
    }
    result = pushed(parts, contact=SMOOTH)
    force = result.history["reaction_bottom_N"][-1]
    missed = 3.0 * BENDING / L**3 * (SAG * MM + probe(result, 1, "y_m")[-1])
    return force / missed


PILE = 5e3  # times as heavy as on Earth, so that walls yield


def piled(pieces):
    """Distance of two walls over their thickness, after one has come to rest upon the other."""
    parts = {
        "nodes_mm": [[0, 0], [LENGTH, 0], [0, 1.1], [LENGTH, 1.1]],
        "walls": [[0, 1], [2, 3]],
        "springs": [{"nodes": [0, 2], "stiffness_N_mm": 1e-9}],
        "gravity_mm_s2": [0, -PILE * GRAVITY],
        "floor_y_mm": -0.5,
        "subdivide": pieces,
        "probes": [0, 1, 2, 3],
    }
    result = let_go(parts, 0.02, 2e-5, SMOOTH, dict(model="rayleigh", mass=5e3, stiffness=1e-5))
    return (probe(result, 3, "y_m")[-1] - probe(result, 1, "y_m")[-1]) / (MM * THICKNESS)


def borne():
    """Distance at which the barrier bears the upper wall: -b'(d) = weight / length, c = 1."""
    weight = PILE * G * MASS / L
    scale = MATERIAL.modulus * DEPTH * MM
    return brentq(
        lambda d: scale * (2.0 * (1.0 - d) * -np.log(d) + (d - 1.0) ** 2 / d) - weight, 1e-3, 1.0
    )


PROBLEMS = (
    Problem("rod fallen on a floor: force", dropped, 1.0, "its weight", (4, 8, 16), 0, 1e-6),
    Problem(
        "cantilever pressed on a floor: force", on_floor, 1.0, "3 Y I / L^3", (4, 8, 16), 2, 2e-3
    ),
    Problem("wall upon a wall: distance", piled, borne, "barrier per length", (8, 16, 32), 0, 1e-6),
)
