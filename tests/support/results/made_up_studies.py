"""Accuracy studies whose errors and orders are known."""

import numpy as np

from sweep.columns import HISTORY_COLUMNS
from sweep.ranking.accuracy import studies
from sweep.store.read import read_summary
from tests.support.results.specimens import summary, write

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
    blank = dict.fromkeys(HISTORY_COLUMNS, np.zeros_like(TIME))
    curves = [row["path"] for row in rows]
    table = summary(*({key: row[key] for key in row if key != "path"} for row in rows))

    def ran(_, number):
        return blank | {"time_s": TIME, "strain": curves[number]}, {}

    file = write(folder / "made_up.h5", table, ran=ran)
    return studies(file, read_summary(file))
