"""The Pareto front: designs such that no lighter one absorbs as much."""

import numpy as np
from pandas import Series


def pareto(mass: Series, energy: Series) -> Series:
    """True for designs such that none lighter absorbs as much and none as light absorbs more."""
    mass = mass.round(9)  # designs of equal mass may differ by round-off
    best = energy.groupby(mass).max().dropna()
    lighter = best.cummax().shift(fill_value=-np.inf)
    return (energy == mass.map(best)) & (energy > mass.map(lighter))
