"""The cases of the figures: the report's, ours, and variants of them; each runs once."""

from functools import cache
from pathlib import Path

import numpy as np
from pandas import DataFrame

from sweep.config.grid import expand
from sweep.config.load import load_config
from tests.support.converged import demand
from tests.support.designs.scenes import run as simulated

CONFIG = Path(__file__).parents[3] / "configs" / "seed.toml"
RECORD = ("modulus", "density", "poisson", "curve_strain", "curve_stress", "uncertain")
HELD = 0.137  # s, just before the load is removed


@cache
def _shipped():
    return expand(load_config(CONFIG))


def report():
    """The report's model: the first row of configs/seed.toml."""
    return _shipped()[0]


def ours():
    """Our model of the same specimen: the last row of configs/seed.toml with the same curve."""
    same = [case for case in _shipped() if case.material.stretch == report().material.stretch]
    return same[-1]


def coarse():
    """Our model in steps of 0.1 ms, five times as long; the loaded state at rest is the same."""
    return varied(ours(), solver={"time_step": 1e-4})


def varied(case, **changes):
    """A case with changed keys: table -> key -> value in SI. Its labels say which."""
    axes = {f"{name}.{key}": value for name, keys in changes.items() for key, value in keys.items()}
    if "material" in changes:  # its record is read anew
        changes["material"] = dict.fromkeys(RECORD) | changes["material"]
    return case.changed(axes, **changes)


def converges(case):
    """Whether a case converges, for figures that show for which time steps it does not."""
    return simulated(case).status == "converged"


def run(case):
    """Result of a case, which has to converge."""
    result = simulated(case)
    demand([{**result.summary, "axes": case.axes}])
    return result


def history(case):
    """Curves of a case, which has to converge."""
    return DataFrame(dict(run(case).history))


def at(curves, column, time=HELD):
    """Value of a column at a time (s)."""
    return float(np.interp(time, curves["time_s"], curves[column]))


def first(curves, reached):
    """Time (s) of the first row at which something is ``reached`` (rows,), which happens."""
    if not reached.any():
        raise ValueError("what the caption tells the time of never happens")
    return float(curves["time_s"][reached.idxmax()])


def share(curves, time=HELD):
    """Bending energy / stretching energy at a time (s)."""
    return at(curves, "bend_J", time) / at(curves, "stretch_J", time)
