"""Conditions under which rows fold one after another: load peaks of the crush across the cells.

The measured load has three peaks, one per row. `python -m tests.studies.khatri_egan.rows FOLDER`
presses the base case of each kind of platens, with the measured curve of the material, and changes
what may part the rows: unequal walls, friction, softening after the first bend, loss at the real
rate, and a stress that hardly rises beyond 4 MPa, which printed TPU does not have. Half a minute.
"""

import sys
from pathlib import Path

from sweep.config.case import Case
from sweep.numbers import three_digits
from sweep.report.tables.sheet import Sheet
from sweep.store.read import read_history
from tests.studies.khatri_egan.across import PLATENS, load_peaks
from tests.studies.tables import publish
from tests.support.converged import swept

BASE = {
    "lattice": {
        **dict.fromkeys(("width", "height", "depth"), 12e-3), "cells_x": 3, "cells_y": 3,
        "wall_thickness": 0.4e-3, "nodes_per_wall": 11,
    },
    "material": {"name": "ultimaker_tpu95a"},
    "loading": {"mode": "displacement", "stroke": 9.6e-3, "unload": False},
    "contact": {"friction": 0.5},
    "solver": {"load_steps": 400},
}  # fmt: skip
SOFTENS = {"softening_r": 1.5, "softening_m": 2e5, "softening_beta": 0.1}
REAL = {"strain_rate": 0.139}  # 1/s: 100 mm/min over 12 mm
FLAT = {
    "name": None, "modulus": 67e6, "density": 1220.0, "stretch": "linear", "bend": "fibres",
    "yield_stress": 4e6, "hardening": 3e6,
}  # fmt: skip
CHANGES = {
    "none": {},
    "walls at top / bottom 1.1": {"lattice": {"grading": 1.1}},
    "1.25": {"lattice": {"grading": 1.25}},
    "1.5": {"lattice": {"grading": 1.5}},
    "no friction": {"contact": {"friction": 0.0}},
    "no friction, 1.25": {"contact": {"friction": 0.0}, "lattice": {"grading": 1.25}},
    "softening": {"material": SOFTENS},
    "loss 0.3": {"material": {"loss": 0.3}, "loading": REAL},
    "loss 0.3, softening, 1.25": {
        "material": {"loss": 0.3, **SOFTENS}, "loading": REAL, "lattice": {"grading": 1.25},
    },
    "flat beyond 4 MPa": {"material": FLAT},
    "flat beyond 4 MPa, 1.1": {"material": FLAT, "lattice": {"grading": 1.1}},
}  # fmt: skip


def cases():
    """The cases by their changes and their platens."""
    return {
        (change, platen): case_of(tables, platen)
        for change, tables in CHANGES.items()
        for platen in PLATENS
    }


def case_of(tables, platen):
    """The base case between these platens, with other values in some tables."""
    values = {name: table | tables.get(name, {}) for name, table in BASE.items()}
    values["loading"]["platen"] = platen
    return Case.of(**values)


def sheet(path):
    """Load peaks and energy, a row for each change. path: of the results file."""
    every = cases()
    table = swept(list(every.values()), path).set_index("case_id")
    rows = []
    for change in CHANGES:
        texts = [change]
        for platen in PLATENS:
            case_id = every[change, platen].case_id
            force = read_history(path, case_id)["reaction_top_N"].to_numpy()
            energy = three_digits(table.loc[case_id, "absorbed_energy_J"])
            texts.append(f"{load_peaks(force)} ({energy})")
        rows.append(texts)
    heads = ["changed", *(f"peaks (J), {words}" for words, _ in PLATENS.values())]
    return Sheet("Load peaks", heads, rows)


if __name__ == "__main__":
    folder = Path(sys.argv[1])
    publish([sheet(folder / "rows.h5")], folder / "rows.md")
