"""Square plates: buckling under uniaxial compression, and pressure.

Expected: k of sigma = k pi^2 D / (b^2 t), D = Y t^3 / (12 (1 - nu^2)), nu = 1/2; and w D / (q b^4)
in the centre (S. Timoshenko and S. Woinowsky-Krieger, 1959; S. Timoshenko and J. Gere, 1961).
"""

import numpy as np

from tests.studies.plates.model import Places, buckling_strain, coordinates, deflection
from tests.support.shells import MODULUS, Structure, plate

SUPPORTED, CLAMPED = "simply supported", "clamped"
X, Y, Z, ABOUT_S, ABOUT_Z, ABOUT_N = range(6)
LONGEST_WAVE = 0.661  # length over width of the half wave of a long plate with clamped sides
KAPPA = 5.0 / 6.0


def held(of: Structure, sides: str, ends: str) -> Places:
    """Coordinates of a plate in the plane that are held: all motions in that plane, and at the
    edges (sides: x, ends: z) deflections and rotations.
    """
    at, (x, _, z) = coordinates(of), of.points.T
    found = [at[:, c] for c in (X, Z, ABOUT_N)]
    for where, kind, hinge in ((x, sides, ABOUT_Z), (z, ends, ABOUT_S)):
        edge = (where == where.min()) | (where == where.max())
        stopped = {Y, ABOUT_S, ABOUT_Z} - ({hinge} if kind == SUPPORTED else set())
        found += [at[edge, c] for c in stopped]
    return np.concatenate(found)


def rigidity(thickness: float) -> float:
    """D of a plate."""
    return MODULUS * thickness**3 / 12 / 0.75


def factor(n: int, sides: str, ends: str, thickness: float = 0.01, thick: float = 0.0) -> float:
    """k of a plate of width 1 with n quads a side.

    thick: ratio of thickness to width of a plate whose share of shear it has, 0: its own.
    """
    height = LONGEST_WAVE if (sides, ends) == (CLAMPED, SUPPORTED) else 1.0
    of = plate(n, n, 1.0, height, thickness)
    if thick > 0.0:
        softer = of.walls.shear_modulus * (thickness / thick) ** 2
        of = Structure(of.points, of.frames, of.walls._replace(shear_modulus=softer))
    stress = MODULUS * buckling_strain(of, held(of, sides, ends))[0]
    return stress * thickness / (np.pi**2 * rigidity(thickness))


def mindlin(k: float, thick: float) -> float:
    """k of a simply supported plate with shear: k / (1 + sigma / (2 kappa G))."""
    stress = k * np.pi**2 * rigidity(thick) / thick
    return k / (1.0 + stress / (2.0 * KAPPA * MODULUS / 3.0))


def pressed(n: int, edges: str, thickness: float) -> float:
    """w D / (q b^4) in the centre of a square plate under uniform pressure."""
    of = plate(n, n, 1.0, 1.0, thickness)
    force = np.zeros(6 * len(of.points))
    area = np.zeros(len(of.points))
    np.add.at(area, of.walls.quads, 0.25 / n**2)
    force[coordinates(of)[:, Y]] = area
    u = deflection(of, held(of, edges, edges), force)
    middle = np.argmin(np.abs(of.points - [0.5, 0.0, 0.5]).sum(axis=1))
    return u[6 * middle + Y] * rigidity(thickness)
