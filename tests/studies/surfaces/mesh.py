"""How many quads a period a crush of a gyroid needs.

Run by `make gyroid_mesh`: a panel of two periods of 6.25 mm, pressed by half along the print axis
between clamped platens. Finished cases are kept in the given folder.
"""

import sys
from pathlib import Path

import numpy as np

from sweep.config.case import Case
from sweep.numbers import in_unit
from sweep.report.tables.sheet import Sheet
from sweep.result import Status
from sweep.running.sweep import run_sweep
from sweep.store.read import read_history, read_summary
from tests.studies.tables import publish

NODES = (3, 4, 5, 7)  # inside half a period: 8 to 16 quads a period
HEADS = (
    "quads a period", "modulus, MPa", "first peak, kPa", "energy to 50 %, mJ/cm3", "iterations",
    "CPU s", "crossings", "energy left over / absorbed",
)  # fmt: skip


def crush(nodes, strain=0.5):
    """The crush with so many nodes in half a period."""
    lattice = {"kind": "gyroid", "depth": 12.5e-3, "cell_size": 6.25e-3, "wall_thickness": 0.4e-3}
    pressed = {"mode": "displacement", "direction": "out_of_plane", "platen": "clamped"}
    return Case.of(
        lattice=lattice | {"nodes_per_wall": nodes},
        material={"name": "ninjaflex"},
        loading=pressed | {"strain": strain, "unload": False},
        solver={"time_limit": 7200.0},
    )


def stresses(history, row):
    """The modulus of the first step, and the first peak of the stress (NaN without), Pa."""
    stress = np.asarray(history["reaction_top_N"]) / (row["outer_width_m"] * row["depth_m"])
    falls = np.flatnonzero(np.diff(stress) < 0.0)
    peak = float(stress[falls[0]]) if len(falls) else np.nan
    return float(stress[1] / history["strain"][1]), peak


def line(case, history, row):
    """The line of a crush in the table."""
    modulus, peak = stresses(history, row)
    energy = in_unit(row["energy_to_50_J_per_m3"], "kJ/m^3")
    left = abs(row["energy_residual_J"]) / row["absorbed_energy_J"]
    return [
        str(case.lattice.quads_per_period),
        f"{in_unit(modulus, 'MPa'):.3g}",
        f"{in_unit(peak, 'kPa'):.0f}",
        f"{energy:.1f}",
        f"{row['newton_iterations']:,.0f}",
        f"{row['cpu_s']:.0f}",
        f"{row['max_crossings']:.0f}",
        f"{left:.0e}",
    ]


def main(folder, nodes=NODES):
    """Run the missing cases, and print the table; return whether a crush stopped."""
    cases = [crush(count) for count in nodes]
    folder.mkdir(parents=True, exist_ok=True)
    file = str(folder / "mesh.h5")
    run_sweep(cases, file)
    rows = read_summary(file).set_index("case_id", drop=False)
    rows = [rows.loc[case.case_id] for case in cases]
    lines = [
        line(case, read_history(file, row["case_id"]), row)
        for case, row in zip(cases, rows, strict=True)
        if row["status"] == Status.CONVERGED
    ]
    publish([Sheet("A gyroid on finer meshes", list(HEADS), lines)], folder / "mesh.md")
    return len(lines) < len(cases)


if __name__ == "__main__":
    sys.exit(main(Path(sys.argv[1])))
