"""The law of a sheet for the kernels, from the uniaxial curve of a material."""

from functools import lru_cache

import numpy as np

from kernels.laws import sheet
from kernels.laws.relaxing_sheet import RelaxingSheet
from kernels.plates.element.shear import KAPPA
from sweep.array_types import Floats
from sweep.config.kinds.material import Material
from sweep.scene.material import stress_law
from sweep.scene.relaxation import relaxation_of

UNSTABLE = """\
walls that are shells need a stable rubber, and the curve of this material is none: its Cauchy \
stress falls in tension, or at its last compressive strain; try another curve"""


class UnstableMaterialError(ValueError):
    """The curve of a material is unstable as a rubber."""


@lru_cache(maxsize=64)
def law_of_sheet(material: Material) -> RelaxingSheet:
    """The law of an incompressible sheet in plane stress; neo-Hookean if the material is linear.

    Raises `UnstableMaterialError`.

    The curve, times the ratio of the instantaneous modulus to the modulus at the reference time, is
    followed down to its least strain, beyond which the sheet stiffens.
    """
    shares, times, instant = relaxation_of(material)
    elastic = _elastic(material, instant)
    return RelaxingSheet(elastic, shares, times, elastic.shear_modulus)


def _elastic(material: Material, factor: float) -> sheet.Sheet:
    """The sheet of the curve with all stresses times ``factor``."""
    if material.stretch == "linear":
        return sheet.neo_hookean(factor * material.modulus)
    curve = stress_law(material)

    def instantaneous(strain: Floats) -> tuple[Floats, Floats]:
        stress, slope = curve.with_slope(strain)
        return factor * stress, factor * slope

    at_rest = float(instantaneous(np.zeros(1))[1][0])
    try:
        return sheet.measured(instantaneous, curve.knots[0], at_rest)
    except ValueError as error:
        raise UnstableMaterialError(UNSTABLE) from error


def shear_moduli(material: Material) -> tuple[float, float]:
    """Shear moduli kappa G of an incompressible wall, instantaneous and at the reference time,
    Pa.
    """
    instant = KAPPA * law_of_sheet(material).shear_modulus
    return instant, instant / relaxation_of(material).instant
