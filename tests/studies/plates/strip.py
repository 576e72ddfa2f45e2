"""Strips that are held across: rolled by a moment, pushed over, compressed when thick."""

import numpy as np
from scipy.optimize import brentq
from scipy.special import ellipe, ellipk

from tests.studies.plates.model import Floats, Places, coordinates, free, relaxed, slopes, stiffness
from tests.support.kernels.shells import MODULUS, Structure, plate

X, Y, Z, ABOUT_S, ABOUT_Z, ABOUT_N = range(6)


def strip(n: int, thickness: float) -> Structure:
    """A strip of length 1 and width 1 / n along x."""
    return plate(n, 1, 1.0, 1.0 / n, thickness)


def across(of: Structure) -> Places:
    """Coordinates that hold the strip to a cylinder."""
    return coordinates(of)[:, [Z, ABOUT_S, ABOUT_N]].ravel()


def start(of: Structure) -> Places:
    """Coordinates that clamp the end at x = 0."""
    return coordinates(of)[of.points[:, 0] == 0.0].ravel()


def bending(of: Structure, thickness: float) -> float:
    """D times the width."""
    return MODULUS * thickness**3 / 12 / 0.75 * of.points[:, 2].max()


def rolled(n: int, thickness: float = 2e-3) -> tuple[float, float]:
    """M L / (D b) of a strip whose end is turned by 2 pi, over 2 pi; and how far it is open."""
    of, x = strip(n, thickness), strip(n, thickness).rest
    end = of.points[:, 0] == 1.0
    turned = coordinates(of)[end, ABOUT_Z]
    held, none = np.concatenate([across(of), start(of), turned]), np.zeros(6 * len(of.points))
    steps = 24
    for step in range(steps):
        curve = np.pi / steps * (2 * step + 2) * of.points[:, 0]
        x = bent(of, x, curve, 2 * np.pi / steps)
        of, x = relaxed(of, x, held, none)
    moment = 0.25 * slopes(of, x)[turned].sum()  # a small w turns by 4 w
    ends = x[:-2].reshape(-1, 6)[:, :3]
    gap = np.linalg.norm(ends[end].mean(axis=0) - ends[of.points[:, 0] == 0.0].mean(axis=0))
    return moment / bending(of, thickness) / (2 * np.pi), float(gap)


def bent(of: Structure, x: Floats, angle: Floats, more: float) -> Floats:
    """Positions on the curve whose tangent turns by ``angle`` (n,), and rotations by ``more`` s."""
    s = of.points[:, 0]
    found = x.copy()
    rows = found[:-2].reshape(-1, 6)
    kappa = angle[s == 1.0][0]
    rows[:, 0], rows[:, 1] = np.sin(kappa * s) / kappa, (1.0 - np.cos(kappa * s)) / kappa
    rows[:, 4] = np.tan(0.25 * more * s)
    return found


def column(tip: float) -> tuple[float, float]:
    """P over Euler's load and height over length of an elastica whose free end leans by ``tip``."""
    p = np.sin(0.5 * tip) ** 2
    return (2.0 / np.pi * ellipk(p)) ** 2, 2.0 * ellipe(p) / ellipk(p) - 1.0


def pushed(n: int, tip: float, thickness: float = 0.01) -> float:
    """Height over length of a column under the load at which its end leans by ``tip``."""
    of = strip(n, thickness)
    end = of.points[:, 0] == 1.0
    load = column(tip)[0] * np.pi**2 / 4.0 * bending(of, thickness)
    force = np.zeros(6 * len(of.points))
    force[coordinates(of)[end, X]] = -load / end.sum()
    x = bent(of, of.rest, tip * of.points[:, 0], tip)
    of, x = relaxed(of, x, np.concatenate([across(of), start(of)]), force)
    return float(x[:-2].reshape(-1, 6)[end, 0].mean())


def critical_stretch(n: int, thickness: float) -> float:
    """Stretch at which a hinged strip of length 1, held across, loses its stiffness."""
    of = strip(n, thickness)
    at = coordinates(of)
    ends = (of.points[:, 0] == 0.0) | (of.points[:, 0] == 1.0)
    held = np.concatenate([across(of), at[:, X], at[ends, Y]])
    kept = free(of, held)

    def least(stretch: float) -> float:
        x = of.rest
        x[:-2].reshape(-1, 6)[:, 0] *= stretch
        values = np.linalg.eigvalsh(stiffness(of, x)[kept][:, kept].toarray())
        return float(values[0])

    return float(brentq(least, 0.6, 1.0 - 1e-7, xtol=1e-10))


def exact_stretch(thickness: float) -> float:
    """The same for the solid: flexure of a neo-Hookean plate in plane strain (M. Biot, 1963),
    tanh(K / 2) / tanh(K / (2 l^2)) = (1 + l^4)^2 / (4 l^2), K = pi thickness.
    """
    k = 0.5 * np.pi * thickness

    def apart(stretch: float) -> float:
        q = stretch * stretch
        return float(np.tanh(k) / np.tanh(k / q) - (1 + q * q) ** 2 / (4 * q))

    return float(brentq(apart, 0.54, 0.99999, xtol=1e-14))
