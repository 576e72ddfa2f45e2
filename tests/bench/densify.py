"""A large lattice crushed until it has packed down, with contact: how long, with what memory."""

from sweep.scene import build_scene
from tests.bench import cases
from tests.bench.alone import MEMORY, alone
from tests.bench.clock import seconds
from tests.bench.sweeps import changed
from tests.bench.table import Table

PATIENCE = 4 * 3600.0  # s
COLUMNS = ("CPU s", "building, s", "iterations", "ms an iteration", "memory, MB", "packed at, %")


def table(cells, strain, steps):
    """One row; why there is none, if the crush did not get through."""
    found = Table(f"{cells} x {cells} crushed in {steps} steps, with contact", COLUMNS)
    case = cases.crush(cells, strain, steps, cases.SMOOTH)
    summary = alone(changed(case, solver={"time_limit": PATIENCE}))
    row = f"to {100 * strain:.0f} %"
    if summary["status"] != "converged":
        found.lack(row, summary["message"])
        return found
    spent, often = summary["cpu_s"], summary["newton_iterations"]
    building, packed = seconds(lambda: build_scene(case)), 100.0 * summary["densification_strain"]
    figures = spent, building, often, 1e3 * spent / often, summary[MEMORY], packed
    for column, figure in zip(COLUMNS, figures, strict=True):
        found.put(row, column, figure)
    return found
