"""Square plates: buckling under uniaxial compression, and pressure.

Expected: k of sigma = k pi^2 D / (b^2 t), D = Y t^3 / (12 (1 - nu^2)), nu = 1/2; and w D / (q b^4)
in the centre (S. Timoshenko and S. Woinowsky-Krieger, 1959; S. Timoshenko and J. Gere, 1961).
"""

import numpy as np
from scipy.optimize import brentq

from tests.studies.plates.model import (
    Floats,
    Places,
    buckling_strain,
    coordinates,
    deflection,
    free,
    stiffness,
)
from tests.support.kernels.shells import MODULUS, Structure, plate

SUPPORTED, CLAMPED = "simply supported", "clamped"
X, Y, Z, ABOUT_S, ABOUT_Z, ABOUT_N = range(6)
LONGEST_WAVE = 0.661  # length over width of the half wave of a long plate with clamped sides
KAPPA = 5.0 / 6.0
BUCKLING = [
    (SUPPORTED, SUPPORTED, 4.0),
    (CLAMPED, SUPPORTED, 6.97),
    (CLAMPED, CLAMPED, 10.07),
]
PRESSURE = [(SUPPORTED, 0.00406235), (CLAMPED, 0.00126532)]


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


def factor(
    n: int, sides: str, ends: str, thickness: float = 0.001, height: float | None = None
) -> float:
    """Factor k of a plate of width 1 with n quads a side; height: 1, or of its half wave."""
    if height is None:
        height = LONGEST_WAVE if (sides, ends) == (CLAMPED, SUPPORTED) else 1.0
    of = plate(n, n, 1.0, height, thickness)
    stress = MODULUS * buckling_strain(of, held(of, sides, ends))[0]
    return stress * thickness / (np.pi**2 * rigidity(thickness))


def critical_strain(n: int, thickness: float) -> float:
    """Strain at which a simply supported neo-Hookean plate that is compressed along z and free to
    widen loses its stiffness.
    """
    of = plate(n, n, 1.0, 1.0, thickness)
    kept = free(of, held(of, SUPPORTED, SUPPORTED))

    def least(strain: float) -> float:
        x = of.rest
        wider = (1.0 - strain) ** -0.5
        x[:-2].reshape(-1, 6)[:, :3] *= [wider, 1.0, 1.0 - strain]
        values = np.linalg.eigvalsh(stiffness(of, x)[kept][:, kept].toarray())
        return float(values[0])

    return float(brentq(least, 1e-7, 0.4, xtol=1e-9))


def knock_down(n: int, thickness: float) -> float:
    """Stiffness of a simply supported plate against the pressure of one half wave each way,
    relative to Kirchhoff's plate; the buckling load of Mindlin's plate is lower by the same factor.
    """
    of = plate(n, n, 1.0, 1.0, thickness)
    wave = np.sin(np.pi * of.points[:, 0]) * np.sin(np.pi * of.points[:, 2])
    wave *= np.sinc(0.5 / n) ** 4  # forces by bilinear shape functions
    u = deflection(of, held(of, SUPPORTED, SUPPORTED), pressure(of, n, wave))
    return 1.0 / (4.0 * np.pi**4 * rigidity(thickness) * u[coordinates(of)[:, Y]].max())


def mindlin(thickness: float) -> float:
    """`knock_down` by Mindlin's theory: 1 / (1 + sigma / (2 kappa G)), sigma: buckling stress."""
    stress = 4.0 * np.pi**2 * rigidity(thickness) / thickness
    return 1.0 / (1.0 + stress / (2.0 * KAPPA * MODULUS / 3.0))


def pressure(of: Structure, n: int, size: Floats) -> Floats:
    """Forces (6 n,) of a pressure of ``size`` (n,) at the nodes of a square plate."""
    force, area = np.zeros(6 * len(of.points)), np.zeros(len(of.points))
    np.add.at(area, of.walls.quads, 0.25 / n**2)
    force[coordinates(of)[:, Y]] = area * size
    return force


def pressed(n: int, edges: str, thickness: float = 0.001) -> float:
    """Deflection w D / (q b^4) in the centre of a square plate under uniform pressure."""
    of = plate(n, n, 1.0, 1.0, thickness)
    force = pressure(of, n, np.ones(len(of.points)))
    u = deflection(of, held(of, edges, edges), force)
    return u[coordinates(of)[:, Y]].max() * rigidity(thickness)
