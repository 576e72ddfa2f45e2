"""The law of a sheet for the kernels, from the uniaxial curve of a material."""

from functools import lru_cache

import numpy as np

from kernels.laws import sheet
from kernels.plates.shear import KAPPA
from sweep.config.case import Material
from sweep.scene.material import Floats, StressLaw, stress_law


@lru_cache(maxsize=64)
def law_of_sheet(material: Material) -> sheet.Sheet:
    """The law of an incompressible sheet in plane stress; neo-Hookean if the material is linear.

    The curve is followed down to its least strain, beyond which the sheet stiffens.
    """
    if material.stretch == "linear":
        return sheet.neo_hookean(material.modulus)
    curve = stress_law(material)
    slope = float(_with_slope(curve, np.zeros(1))[1][0])
    return sheet.measured(lambda strain: _with_slope(curve, strain), curve.knots[0], slope)


def shear_modulus(material: Material) -> float:
    """Kappa G of an incompressible wall, Pa."""
    return KAPPA * law_of_sheet(material).shear_modulus


def _with_slope(curve: StressLaw, strain: Floats) -> tuple[Floats, Floats]:
    """Stress and its slope (n,) in Pa at strains (n,)."""
    last = len(curve.coefficients) - 1
    piece = np.clip(np.searchsorted(curve.knots, strain, side="right") - 1, 0, last)
    c, s = curve.coefficients[piece].T, np.clip(strain, *curve.knots[[0, -1]]) - curve.knots[piece]
    return curve.at(strain), np.asarray(c[1] + s * (2.0 * c[2] + s * 3.0 * c[3]))
