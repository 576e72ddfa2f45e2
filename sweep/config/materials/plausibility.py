"""Finds implausible numbers of a material, and the unit that was probably meant: one check for
curves, configs and fits.

A mistaken unit changes a number by a power of ten, without a fault that a simulation would show: a
modulus of 19 Pa is one of 19 MPa, a density of 1.2 kg/m3 one of 1.2 g/cm3, a strain of 15 one of 15
%. The ranges are wide: from gels to steel, from foamed filament to tungsten.
"""

from collections.abc import Sequence
from typing import NamedTuple


class Range(NamedTuple):
    """The range of printed materials, from low to high in SI, and in words.

    units: other units that may be meant, with their sizes in SI. usual: range in which a number in
    another unit is sought.
    """

    low: float
    high: float
    words: str
    units: tuple[tuple[str, float], ...]
    usual: tuple[float, float]


_STRESSES = (("MPa", 1e6), ("kPa", 1e3), ("GPa", 1e9))
RANGES = {
    "modulus": Range(1e3, 1e12, "1 kPa to 1000 GPa", _STRESSES, (1e6, 5e9)),
    "curve_modulus": Range(1e5, 1e12, "0.1 MPa to 1000 GPa", _STRESSES, (1e6, 5e9)),
    "yield_stress": Range(1e5, 1e10, "0.1 MPa to 10 GPa", _STRESSES, (5e6, 2e9)),
    "density": Range(50.0, 25e3, "50 to 25,000 kg/m3", (("g/cm3", 1e3),), (200.0, 25e3)),
}
"""By the key of a material; curve_modulus: slope of a curve, whose unit only a head states."""
MOST_STRAIN = 10.0  # printed TPU breaks at 5 to 8
FIRST_STRAIN = 0.5  # greatest first strain of a curve: its modulus is taken at some percent


def suspicion(key: str, value: float) -> str | None:
    """Why a number of a material is implausible: the range, and the unit that was probably meant;
    None if it is plausible, or if nothing is known about its key.
    """
    if key not in RANGES or RANGES[key].low <= value <= RANGES[key].high:
        return None
    unit = unit_meant(key, value)
    return RANGES[key].words + (f"; is it in {unit}?" if unit else "")


def unit_meant(key: str, value: float) -> str | None:
    """The unit in which an implausible number would be a usual one, if there is one."""
    low, high = RANGES[key].usual
    return next((unit for unit, size in RANGES[key].units if low <= size * value <= high), None)


def in_percent(strain: Sequence[float]) -> bool:
    """Whether the positive strains of a curve are probably in percent: 15 would be 1500 %."""
    pulled = [value for value in strain if value > 0.0]
    return bool(pulled) and (max(pulled) > MOST_STRAIN or min(pulled) > FIRST_STRAIN)
