"""The budget of a ranking: the mass that it limits, its tolerance, and the designs within it.

Designs are often made for a budget, from a wall thickness that gives just this mass. Round-off must
not exclude them.
"""

from pandas import DataFrame, Series

ROUND_OFF = 1e-9  # relative; `merit` and `requirements` allow it for other limits too


def greatest_mass(budget: float) -> float:
    """The greatest mass within a budget: the budget, with a tolerance for round-off."""
    return budget * (1.0 + ROUND_OFF)


def within_budget(masses: Series, budget_g: float) -> Series:
    """Which of the masses (g) are within a budget."""
    return masses <= greatest_mass(budget_g)


def counted_mass(finished: DataFrame) -> tuple[str, Series]:
    """The column of the mass that counts, and its values, g: as extruded if there is a slicer."""
    printed = finished["printed_mass_g"]
    if printed.isna().all():
        return "mass_g", finished["mass_g"]
    return "counted_mass_g", printed.fillna(finished["mass_g"])
