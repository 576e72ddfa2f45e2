"""Tables of cases from a few of their values."""

from sweep.config.kinds.lattice import lattice_of
from sweep.config.kinds.material import material

DENSITY = 1190.0  # kg/m^3, as ninjaflex


def material_with(**values):
    """The material of these values."""
    return material(values)


MATERIAL = material_with(modulus=12e6, density=1190.0, poisson=0.48, plane="stress")
"""The linear material of closed forms and of the numbers of the README."""


def lattice_with(**values):
    """The lattice of these values, pressed across its cells."""
    return lattice_of(values, DENSITY, along=False)
