"""Refuses values that no record of a printed coupon can have, with the option that corrects a
unit.
"""

import numpy as np

from sweep.array_types import Floats
from sweep.config.faults import MisfitError
from sweep.config.materials.material_file import SECANT
from sweep.config.materials.plausibility import in_percent, suspicion, unit_meant
from sweep.config.units import in_si
from sweep.numbers import text_in, to_si, with_unit

FORCE = "kN"  # a unit of mass that is sometimes recorded as N


def doubts(strain: Floats, stress: Floats, words: dict[str, str]) -> list[str]:
    """Options for units that are probably wrong; raises `MisfitError` for values that no unit
    explains.

    strain, stress (n,) in Pa: positive in tension, negative in compression. words: heads with their
    units, by quantity.
    """
    advice = []
    if strain.min() <= -1.0 and not in_percent(np.abs(strain).tolist()):
        raise MisfitError("a strain of -1 or less; allowed: above -1")
    strain = strain if strain.max() > -strain.min() else -strain
    most = float(strain.max())
    if in_percent(strain.tolist()):
        wrong = f"strains up to {most:.4g} would be {text_in(most, '%')}"
        if "strain" not in words:
            raise MisfitError(f"{wrong}; needed: another --gauge, or --units displacement=...")
        advice.append(f"--units strain=% if it is in percent: {wrong}")
        strain = to_si(strain, "%")
    if strain.max() < SECANT[1]:
        wrong = f"strains up to {strain.max():.3g}; needed: at least {SECANT[1]:g}"
        raise MisfitError(f"{wrong}; are the gauge length and the unit of the strain right?")
    modulus = coarse_modulus(strain, np.abs(stress))
    if modulus <= 0.0:
        span = " to ".join(f"{end:g}" for end in SECANT)
        raise MisfitError(f"the stress does not rise from a strain of {span}; needed: that it does")
    if why := suspicion("curve_modulus", modulus):
        advice.append(_of_stress(modulus, why, words))
    return advice


def _of_stress(modulus: float, why: str, words: dict[str, str]) -> str:
    """The option for the unit of a stress or a force."""
    quantity = "stress" if "stress" in words else "force"
    unit = unit_meant("curve_modulus", modulus)
    if quantity == "force":
        larger = modulus * in_si(f"1 {FORCE}", "N")
        unit = None if suspicion("curve_modulus", larger) else FORCE
    wrong = f"a modulus of {with_unit(modulus, 'Pa')}; allowed: {why.split(';')[0]}"
    if unit is None:
        raise MisfitError(f"{wrong}; are the units and the size of the specimen right?")
    return f"--units {quantity}={unit} if it is in {unit}: {wrong}"


def coarse_modulus(strain: Floats, stress: Floats) -> float:
    """Slope of a first loading between 1 and 4 %, Pa, by a straight line through its rows; both
    (n,) are positive.
    """
    end = int(np.argmax(strain >= SECANT[1])) + 1
    rows = strain[:end] >= SECANT[0]
    if rows.sum() < 2:
        return float(stress[end - 1] / strain[end - 1])
    return float(np.polyfit(strain[:end][rows], stress[:end][rows], 1)[0])
