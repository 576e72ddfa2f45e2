"""Sheets for tests: neo-Hookean ones, also given by a curve, and sheets of shipped materials."""

from typing import Any, NamedTuple

import numpy as np

from kernels.compile.jit import jit
from kernels.laws import sheet
from kernels.laws.relaxing_sheet import RelaxingSheet
from kernels.laws.sheet import Sheet
from sweep.array_types import Floats
from sweep.scene.material import StressLaw, stress_law
from tests.support.designs.tables import material_with

MODULUS = 12.0
LEAST = -0.7


def rubber(strain: Floats) -> tuple[Floats, Floats]:
    """Nominal stress mu (l - 1 / l^2) of neo-Hookean rubber and its slope."""
    stretch = 1.0 + strain
    return MODULUS / 3 * (stretch - stretch**-2), MODULUS / 3 * (1.0 + 2.0 * stretch**-3)


class Nominal:
    """A law of `sweep.scene.material` as a function that returns stress and slope."""

    def __init__(self, law: StressLaw):
        self.law = law

    def __call__(self, strain: Floats) -> tuple[Floats, Floats]:
        """Stress and slope (n,) in Pa at strains (n,)."""
        return self.law.with_slope(strain)


def nominal(name: str) -> Nominal:
    """The nominal stress of a shipped material."""
    return Nominal(stress_law(material_with(name=name)))


def measured(name: str) -> Sheet:
    """The sheet of a shipped material, Pa."""
    of = nominal(name)
    return sheet.measured(of, of.law.knots[0], of(np.zeros(1))[1][0])


def sheet_of_rubber() -> Sheet:
    """Neo-Hookean rubber by way of its nominal stress."""
    return sheet.measured(rubber, LEAST, MODULUS)


def strain(stretches: Any, angle: float = 0.0) -> Floats:
    """c11 - 1, c22 - 1, c12 of principal stretches whose first direction is at ``angle``."""
    turn = np.array([[np.cos(angle), -np.sin(angle)], [np.sin(angle), np.cos(angle)]])
    c = turn @ np.diag(np.square(stretches)) @ turn.T
    return np.array([c[0, 0] - 1.0, c[1, 1] - 1.0, c[0, 1]])


def elastic_only(elastic: Any) -> RelaxingSheet:
    """A sheet as a law without branches."""
    return RelaxingSheet(elastic, np.empty(0), np.empty(0), elastic.shear_modulus)


@jit
def _respond(law, a, b, v):
    """Return energy, slopes and second derivatives, as `kernels.laws.sheet.respond`."""
    plane = law.modulus / (1.0 - law.poisson**2)
    shear = 0.5 * law.modulus / (1.0 + law.poisson)
    one, two = 0.5 * a, 0.5 * b
    mixed = one + law.poisson * two, two + law.poisson * one
    return (
        0.5 * plane * (one * mixed[0] + two * mixed[1]) + 0.5 * shear * v * v,
        (0.5 * plane * mixed[0], 0.5 * plane * mixed[1], shear * v),
        (0.25 * plane, 0.25 * plane * law.poisson, 0.0, 0.25 * plane, 0.0, shear),
    )


class Hooke(NamedTuple):
    """St. Venant and Kirchhoff's sheet in plane stress, of any Poisson's ratio, for benchmarks."""

    modulus: float
    poisson: float
    shear_modulus: float

    respond = _respond


def hooke(modulus: float, poisson: float) -> RelaxingSheet:
    """A linear sheet as a law without branches."""
    return elastic_only(Hooke(modulus, poisson, 0.5 * modulus / (1.0 + poisson)))
