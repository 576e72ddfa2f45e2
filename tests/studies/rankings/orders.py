"""The order of designs in two tables, by the compared column of rankings, scene by scene."""

import numpy as np
from scipy.stats import spearmanr

from sweep.config.load import load_config

CONFIGS = ("armor", "infills", "impact")
BY = {"force": "peak_strain", "impact": "peak_force_N"}  # the least is the best


def cases_of(folder):
    """The cases of the shipped sweeps: name -> cases."""
    return {name: list(load_config(folder / f"{name}.toml").cases) for name in CONFIGS}


def merits(rows):
    """The values by which the designs of one scene are compared, more being better; NaN for failed
    runs.
    """
    mode = rows["loading_mode"].iloc[0]
    energy = rows["absorbed_energy_until_packed_J"] / rows["mass_g"]
    values = -rows[BY[mode]] if mode in BY else energy
    return values.where(rows["status"] == "converged")


def compared(before, after):
    """Rank correlation of two columns where both are known, and whether their best row is the
    same.
    """
    both = before.notna().to_numpy() & after.notna().to_numpy()
    one, two = before.to_numpy()[both], after.to_numpy()[both]
    return float(spearmanr(one, two).statistic), int(np.argmax(one)) == int(np.argmax(two))
