"""A long, simply supported plate after buckling: length of its waves, and remaining stiffness.

One half wave of a plate of width 1 represents all. At both ends, where the plate crosses its plane,
all points move alike along z, and are free along x. The sides stay straight, or are free to wave.

Expected of the amplitude squared, A, in w = A^(1/2) sin(pi x) sin(pi z): the mean stress is
Y (e - pi^2 A / 8), and the rest of the stress stores c Y A^2, so that

    dstress / de = Y r / (1 + r),    r = 128 c / pi^4,

r = 1 with straight sides (1/2 remains). `waving` finds r for sides without stress.
"""

import numpy as np
from scipy.optimize import minimize_scalar

from tests.studies.plates import model, square
from tests.studies.plates.square import SUPPORTED
from tests.studies.plates.tied import Platen, Tied
from tests.support.kernels.shells import at_rest, element_hessians, plate

STRAIGHT, WAVING = "straight", "waving"
BUCKLING_STRAIN = 4.0 * np.pi**2 / 9.0  # over (t / b)^2
BOW = 0.002  # in thicknesses
WATCHED = (1.15, 1.35)  # shortenings / shortening at buckling, between which the tangent is taken
X, Y, Z, ABOUT_S, ABOUT_Z, ABOUT_N = range(6)


def waving():
    """Share of the stiffness that is left where the sides are free of stress.

    Stress function (cos 2 pi x + cos k z) / 32 + f(x) cos k z, k = 2 pi, of A = Y = 1; f is
    biharmonic, and makes both stresses of the sides vanish.
    """
    k, at = 2.0 * np.pi, 0.5
    (x, weight), sinh, cosh = np.polynomial.legendre.leggauss(40), np.sinh, np.cosh
    x, weight = at * x, at * weight
    even = [[cosh(k * at), at * sinh(k * at)],
            [k * sinh(k * at), sinh(k * at) + k * at * cosh(k * at)]]  # fmt: skip
    a, b = np.linalg.solve(even, [-1.0 / 32.0, 0.0])
    f = a * cosh(k * x) + b * x * sinh(k * x)
    first = (a * k + b) * sinh(k * x) + b * k * x * cosh(k * x)
    second = (a * k + 2.0 * b) * k * cosh(k * x) + b * k * k * x * sinh(k * x)
    along = 0.5 * (np.pi**2 / 8.0) ** 2 + 0.5 * weight @ second**2
    across = 0.5 * weight @ (np.pi**2 / 8.0 + k * k * f) ** 2
    shear = weight @ (k * first) ** 2
    r = 128.0 / np.pi**4 * 0.5 * (along + across + shear)
    return r / (1.0 + r)


LEFT = {STRAIGHT: 0.5, WAVING: waving()}


class Shells:
    """Shells by the displacements u (6 n,) of their nodes from a bowed shape without stress."""

    def __init__(self, of, shape):
        self.shape, self.of = shape, at_rest(of, shape)
        quads = of.walls.quads
        self.places = (6 * quads[:, :, None] + np.arange(6)).reshape(len(quads), 24)

    def _moved(self, u):
        return self.shape + np.append(u, [0.0, 0.0])

    def energy(self, u):
        """Energy in J."""
        return model.energy(self.of, self._moved(u))

    def gradient(self, u):
        """Derivatives (6 n,)."""
        return model.slopes(self.of, self._moved(u))

    def hessians(self, u):
        """Second derivatives of the quads, (m, 24, 24)."""
        return element_hessians(self.of, self._moved(u))


def half_wave(n, sides, thickness):
    """A `Tied` half wave of n quads each way, n even."""
    of = plate(n, n, 1.0, 1.0, thickness)
    (x, _, z), at = of.points.T, model.coordinates(of)
    unknown, ratio = at.copy(), np.ones(at.shape)
    side, top, platen = (x == 0.0) | (x == 1.0), z == 1.0, at.size
    ratio[:, ABOUT_N] = 0.0
    ratio[np.isclose(x, 0.5), X] = ratio[z == 0.0, Z] = 0.0
    for edge, held in ((side, (Y, ABOUT_S)), ((z == 0.0) | top, (Y, ABOUT_Z))):
        ratio[np.ix_(edge, held)] = 0.0
    unknown[top, Z] = platen
    if sides == STRAIGHT:
        unknown[side, X] = at[x == 1.0, X][0]
        ratio[x == 0.0, X] = -1.0
    shape = of.rest
    shape[at[:, Y]] = BOW * thickness * np.sin(np.pi * x) * np.sin(np.pi * z)
    return Tied(Shells(of, shape), unknown.ravel(), ratio.ravel())


def left(n, sides, thickness=0.02):
    """Tangent of the load-shortening curve after buckling over that before."""
    strain = BUCKLING_STRAIN * thickness**2
    press = Platen(half_wave(n, sides, thickness), 1.0)
    press.tolerance = 1e-10
    at, force, _ = np.array(press.crush(strain * np.array([0.1, 0.8, 1.0, *WATCHED])).rows).T
    return (force[-1] - force[-2]) / (at[-1] - at[-2]) / (force[1] / at[1])


def wave(n):
    """Length of the half waves in which a long plate buckles, at the least load."""
    found = minimize_scalar(
        lambda length: square.factor(n, SUPPORTED, SUPPORTED, height=length),
        bounds=(0.6, 1.6), method="bounded", options={"xatol": 1e-4},
    )  # fmt: skip
    return float(found.x)
