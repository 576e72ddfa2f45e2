"""How much each headline column moves with the mesh, the imperfection and the steps.

Run by `make spread`: the designs of `DESIGNS`, crushed to 60 %, with the settings of `SETTINGS`,
one of them varied at a time. A column that jumps shows a spread far above the spread of the work
itself. Finished cases are kept in the given folder.
"""

import sys
from itertools import product
from pathlib import Path

import numpy as np
import pandas as pd

from sweep.columns import ABSORBED_AT
from sweep.config.case import Case
from sweep.numbers import tenths
from sweep.report.tables.sheet import Sheet
from sweep.result import Status
from sweep.running.beside.error_bars import HEADLINE
from sweep.running.sweep import run_sweep
from sweep.store.read import read_summary
from tests.studies.tables import publish

SETTINGS = {
    "elements": (4, 6, 8, 12, 16, 24),  # of a wall
    "imperfection": (0.0025, 0.005, 0.01, 0.02, 0.04),  # of the wall thickness
    "steps": (50, 100, 200, 400, 800, 1600),
}
USUAL = {"elements": 6, "imperfection": 0.01, "steps": 200}  # of settings that are not varied
CELLS = {
    "square": 4,
    "brick": 4,
    "hex": 4,
    "reentrant": 4,
    "diamond": 3,
    "circle": 4,
    "triangle": 3,
    "kagome": 2,
}
SCENES = (("glued", 1.4e-3), ("contact", 1.4e-3), ("glued", 0.7e-3))  # platens, mass in kg
ALLOWED = (20.0, 50.0, 100.0)  # N
PATIENCE = 600.0  # s for a case
DESIGNS = tuple(product(CELLS, SCENES))


def crush(design, elements, imperfection, steps):
    """The crush of a design, ``(pattern, (platens, mass))``, to 60 %."""
    kind, (platen, mass) = design
    box = {"width": 20e-3, "height": 20e-3, "cells_x": CELLS[kind], "cells_y": CELLS[kind]}
    numerics = {"nodes_per_wall": elements - 1, "imperfection": imperfection}
    return Case.of(
        lattice=dict(kind=kind, mass=mass, **box, **numerics),
        loading=dict(
            mode="displacement", strain=0.6, platen=platen, unload=False, allowed_forces=ALLOWED
        ),
        contact=dict(friction=0.3),
        solver=dict(load_steps=steps, time_limit=PATIENCE),
    )


def families(designs=DESIGNS, settings=SETTINGS, usual=USUAL):
    """The cases of each design and each varied setting: (design, setting) -> cases."""
    return {
        (design, name): [crush(design, **{**usual, name: value}) for value in values]
        for design in designs
        for name, values in settings.items()
    }


def spreads(cases, rows):
    """Range / median of each column, by (design, setting): a row for each.

    rows: the summary by case id. A lattice that has not packed counts as packed at the end.
    Cases that did not converge are left out; one value alone has no spread.
    """
    found = []
    for (design, name), alike in cases.items():
        group = rows.loc[[case.case_id for case in alike]]
        group = group[group["status"] == Status.CONVERGED]
        row = {"design": design, "setting": name, "failed": len(alike) - len(group)}
        for column in headline(group):
            values = group[column]
            if column == "densification_strain":
                values = values.fillna(group["peak_strain"])
            known = len(values) > 1 and values.notna().all() and values.median() != 0.0
            row[column] = np.ptp(values) / abs(values.median()) if known else np.nan
        found.append(row)
    return pd.DataFrame(found)


def headline(table):
    """The headline columns of a table."""
    return [name for name in table if name in HEADLINE or ABSORBED_AT.fullmatch(name)]


def sheet(found):
    """Median, nine of ten and greatest spread of each column over the designs, by setting."""
    by_setting = dict(list(found.groupby("setting", sort=False)))
    shown = ("median", "9/10", "most")
    heads = ["column", *(f"{name}: {what}" for name in by_setting for what in shown)]
    columns = [name for name in headline(found) if found[name].notna().any()]
    rows = []
    for column in columns:
        groups = [group[column].dropna() for group in by_setting.values()]
        shares = [f(group) for group in groups for f in (np.median, nine_of_ten, max)]
        rows.append([column, *map(tenths, shares)])
    failed = f"{found['failed'].sum()} cases did not converge and are left out."
    return Sheet("Range of a column / its median, in %", heads, rows, notes=(failed,))


def nine_of_ten(values):
    """The ninth decile of the values."""
    return np.quantile(values, 0.9)


def main(folder):
    """Run the missing cases, and print the table."""
    folder.mkdir(parents=True, exist_ok=True)
    cases, file = families(), folder / "spread.h5"
    run_sweep([case for alike in cases.values() for case in alike], file)
    found = spreads(cases, read_summary(file).set_index("case_id"))
    publish([sheet(found)], folder / "spread.md")


if __name__ == "__main__":
    main(Path(sys.argv[1]))
