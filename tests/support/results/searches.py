"""A search whose designs cost nothing: their energy is a formula of walls, cells and pattern."""

from math import exp, nan

import numpy as np

from sweep.columns import COLUMNS, HISTORY_COLUMNS, absorbed_energy_column
from sweep.result import Result, Status, design_columns

TOML = """
name = "sought"

[lattice]
width = "25 mm"

[loading]
mode = "displacement"
strain = 0.6

[search]
"lattice.kind" = ["square", "hex", "diamond"]
lattice.cells_x = {from = 2, to = 6}
"lattice.wall_thickness" = {from = "0.4 mm", to = "1.2 mm"}
"""
THIN = 0.55e-3
BEST = ("hex", 5, 0.71)  # pattern, cells across, walls in mm


def energy(case):
    """A peak of 1 J; a tenth of it remains where walls are 0.07 mm off."""
    kind, cells, walls = BEST
    off = 1e3 * case.lattice.wall_thickness - walls
    share = 1.0 if case.lattice.kind == kind else 0.6
    return share * (1.0 - 0.1 * abs(case.lattice.cells_x - cells)) * exp(-((off / 0.047) ** 2))


def simulate(case, control=None, seconds=None):
    """A result of that energy; brick fails, and walls below 0.55 mm are beyond the model."""
    joules = energy(case)
    failed = case.lattice.kind == "brick"
    measures = dict.fromkeys(list(COLUMNS)[3:], 0.0) | design_columns(case)
    measures |= {name: joules for name in COLUMNS if name.startswith("absorbed_energy_")}
    measures |= {absorbed_energy_column(force): joules for force in case.loading.allowed_forces}
    grams = 1e3 * case.lattice.wall_thickness
    measures |= {"mass_g": grams, "printed_mass_g": nan, "cpu_s": 0.01}
    if case.lattice.wall_thickness < THIN:
        measures |= {"absorbed_energy_within_model_J": 0.5 * joules}
    measures |= {"loaded": int(not failed), "retry": ""}
    status = Status.STOPPED if failed else Status.CONVERGED
    why = "no equilibrium" if failed else ""
    return Result(case, status, why, measures, {} if failed else history(joules))


def history(joules):
    """A force of `joules` x 100 N / J over 10 mm, in two rows."""
    rows = {name: np.zeros(2) for name in HISTORY_COLUMNS}
    force, work = np.full(2, 100.0 * joules), np.array([0.0, joules])
    shown = {"top_displacement_m": np.array([0.0, 0.01]), "work_in_J": work}
    return rows | shown | {"reaction_top_N": force, "reaction_bottom_N": force}
