"""Strains of dead loads in long time steps against short ones, by the local error of their path.

python -m tests.studies.rankings.loads (six minutes): loads of configs/armor.toml in fixed steps,
and with a stated error of steps, against newmark in steps of 5 us.
"""

import sys
from itertools import pairwise, product
from statistics import median
from typing import NamedTuple

from sweep.config.grid import expand
from sweep.config.load import load_config
from tests.studies.tables import head, line
from tests.support.converged import converged

MATERIALS = ("ninjaflex", "ultimaker_tpu95a")
CELLS, WALLS, FORCES = (6.2e-3, 4.2e-3, 2.5e-3), (4e-4, 8e-4), (125.0, 500.0)
STEPS, ERRORS = (1e-4, 2e-5), (1e-6, 5e-6, 25e-6)
REFERENCE = {"integrator": "newmark", "time_step": 5e-6, "step_error": None}
INTEGRATORS = ("backward_euler", "bdf2", "newmark")
EDGES = (0.0, 0.1, 0.2, 0.5, 1.0, 2.0, float("inf"))  # of the local error, %


class Run(NamedTuple):
    """A run: its settings, its local error and the error of its greatest strain, %."""

    how: str
    local: float
    strain: float


def loads():
    """The loads of armor, released after 25 ms: all have their greatest strain before."""
    for case in expand(load_config("armor")):
        axes, loading = case.axes, case.loading
        chosen = (
            loading.mode == "force"
            and axes["material.name"] in MATERIALS
            and axes["lattice.cell_size"] in CELLS
            and case.lattice.wall_thickness in WALLS
            and loading.force in FORCES
        )
        if chosen:
            yield case.changed(loading={"release_time": 25e-3, "duration": 25e-3})


def runs(case, steps=STEPS, errors=ERRORS, integrators=INTEGRATORS):
    """The runs of one load."""
    right = converged(case.changed(solver=REFERENCE)).summary["peak_strain"]
    fixed = [
        (scheme, {"integrator": scheme, "time_step": step, "step_error": None})
        for scheme, step in product(integrators, steps)
    ]
    stated = [
        ("stated", {"integrator": scheme, "step_error": error})
        for scheme, error in product(integrators[1:], errors)
    ]
    for how, solver in fixed + stated:
        row = converged(case.changed(solver=solver)).summary
        error = abs(row["peak_strain"] / right - 1.0)
        yield Run(how, 100.0 * row["path_error"], 100.0 * error)


def cell(found):
    """Number of runs, and the middle and the greatest error of strain."""
    errors = [run.strain for run in found]
    return f"{len(errors)}: {median(errors):.2g} ({max(errors):.2g})" if errors else "–"


def table(every):
    """Errors of fixed steps by local error and integrator, then of steps with a stated error."""
    yield from head(["local error, %", *(name.replace("_", " ") for name in INTEGRATORS)])
    for low, high in pairwise(EDGES):
        inside = [run for run in every if low <= run.local < high]
        what = f"> {low:g}" if high == float("inf") else f"{low:g} to {high:g}"
        yield line([what, *(cell([r for r in inside if r.how == name]) for name in INTEGRATORS)])
    for words, marked in (("not marked", False), ("marked", True)):
        stated = [run for run in every if run.how == "stated" and (run.local > 0.5) == marked]
        yield f"with step_error, {words}: {cell(stated)}"


def main():
    """Print the table."""
    every = [run for case in loads() for run in runs(case)]
    sys.stdout.write("\n".join([*table(every), ""]))


if __name__ == "__main__":
    main()
