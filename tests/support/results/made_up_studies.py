"""Accuracy studies whose errors and orders are known."""

import numpy as np

from sweep.columns import HISTORY_COLUMNS
from sweep.ranking.accuracy import studies
from sweep.result import Result, Status
from sweep.store.read import read_summary
from sweep.store.write import Writer
from tests.support.results.specimens import Named, summary

ORDERS = {"backward_euler": 1, "bdf2": 2, "newmark": 2}
STEPS = (1e-3, 5e-4, 2.5e-4, 1.25e-4, 6.25e-5)
TIME = np.linspace(0.0, 1.0, 11)
ENERGY, PEAK = 0.05, 20.0


def made_up(integrator, step, **other):
    """A case whose energy is off by 40 (step in ms)^p %, its path by half of that."""
    off = 0.4 * (1e3 * step) ** ORDERS[integrator]
    return {
        "loading_mode": "force",
        "force_N": 5.0,
        "solver.integrator": integrator,
        "solver.time_step": step,
        "absorbed_energy_J": ENERGY * (1.0 + off),
        "peak_force_N": PEAK * (1.0 - off),
        "cpu_s": 1e-3 / step * (2.2 if integrator == "bdf2" else 1.0),
        "path": TIME * (1.0 + 0.5 * off),
        **other,
    }


def all_steps(*integrators, **other):
    """Made-up cases of these integrators in every step."""
    return [made_up(name, step, **other) for name in integrators for step in STEPS]


def study(folder, rows):
    """The studies of made-up rows, written to a folder."""
    table = summary(*rows)
    results = []
    for row in table.to_dict("records"):
        case_id, status, message, curve = (
            row.pop(k) for k in ("case_id", "status", "message", "path")
        )
        blank = dict.fromkeys(HISTORY_COLUMNS, np.zeros_like(TIME))
        history = blank | {"time_s": TIME, "strain": curve}
        results.append(Result(Named(case_id), Status(status), message, row, history, {}))
    with Writer(folder / "made_up.h5") as writer:
        writer.append(results)
        writer.fold()
    return studies(folder / "made_up.h5", read_summary(folder / "made_up.h5"))
