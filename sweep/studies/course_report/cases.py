"""The cases of the figures: the report's, ours, and variants of them; each runs once."""

from collections.abc import Mapping
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np
from pandas import DataFrame

from sweep.config.case import TABLES, Case
from sweep.config.grid import expand
from sweep.config.load import load_config
from sweep.result import Result
from sweep.simulation.simulate import simulate

CONFIG = Path(__file__).parents[3] / "configs" / "seed.toml"
HELD = 0.137  # s, just before the load is removed
RECORD = ("modulus", "density", "poisson", "curve_strain", "curve_stress", "uncertain")


@cache
def _shipped() -> list[Case]:
    return expand(load_config(CONFIG))


def report() -> Case:
    """The report's model: the first row of configs/seed.toml."""
    return _shipped()[0]


def ours() -> Case:
    """Our model of the same specimen: the last row of configs/seed.toml with the same curve."""
    same = [case for case in _shipped() if case.material.stretch == report().material.stretch]
    return same[-1]


def coarse() -> Case:
    """Our model in steps of 0.1 ms, five times as long; the loaded state at rest is the same."""
    return varied(ours(), solver={"time_step": 1e-4})


def varied(case: Case, **changes: Mapping[str, Any]) -> Case:
    """A case with changed keys: table -> key -> value in SI. A new mode resets the loading."""
    tables = {name: getattr(case, name).model_dump(exclude_none=True) for name in TABLES}
    for key in RECORD:
        tables["material"].pop(key, None)
    if "mode" in changes.get("loading", {}):
        tables["loading"], tables["solver"] = {}, {**tables["solver"]}
        for key in ("integrator", "time_step"):
            tables["solver"].pop(key)
    for name, change in changes.items():
        tables[name] |= change
    return Case.of(**{name: TABLES[name](**table) for name, table in tables.items()})


_results: dict[str, Result] = {}


def run(case: Case) -> Result:
    """Result of a case."""
    if case.case_id not in _results:
        _results[case.case_id] = simulate(case)
    return _results[case.case_id]


def history(case: Case) -> DataFrame:
    """Curves of a case."""
    return DataFrame(dict(run(case).history))


def at(curves: DataFrame, column: str, time: float = HELD) -> float:
    """Value of a column at a time (s)."""
    return float(np.interp(time, curves["time_s"], curves[column]))


def share(curves: DataFrame, time: float = HELD) -> float:
    """Bending energy / stretching energy at a time (s)."""
    return at(curves, "bend_J", time) / at(curves, "stretch_J", time)
