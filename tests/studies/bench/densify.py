"""A large lattice crushed until it has densified, with contact: time and memory."""

from sweep.scene.lattice import build_scene
from tests.studies.bench.measuring import cases, marching
from tests.studies.bench.measuring.alone import MEMORY, alone
from tests.studies.bench.table import Table
from tests.support.converged import demand

PATIENCE = 4 * 3600.0  # s
COLUMNS = ("CPU s", "march, s", "iterations", "ms of each", "memory, MB", "densified at %")


def table(cells, strain, steps):
    """One row."""
    found = Table(f"{cells} x {cells}, with contact", COLUMNS)
    case = cases.crush(cells, strain, steps, cases.SMOOTH)
    summary = alone(case.changed(solver={"time_limit": PATIENCE}))
    row = f"to {100 * strain:.0f} % in {steps} steps"
    demand([summary])
    march = marching.whole(case, build_scene(case))
    densified = 100.0 * summary["densification_strain"]
    each, memory = 1e3 * march.each, summary[MEMORY]
    figures = summary["cpu_s"], march.seconds, march.iterations, each, memory, densified
    for column, figure in zip(COLUMNS, figures, strict=True):
        found.put(row, column, figure)
    return found
