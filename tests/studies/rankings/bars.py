"""Whether error bars cover the error: designs of two sweeps against much finer runs of them.

Run by `make bars`: the small lattices of a sweep, or every few of its cases, with error bars, and
the same with 24 elements a wall and steps a quarter as long, which are the reference. Finished
cases are kept in the given folder.
"""

import sys
from pathlib import Path

import pandas as pd

from sweep.columns import ERROR
from sweep.config.grid import expand
from sweep.config.load import load_config
from sweep.report.tables.sheet import Sheet
from sweep.result import Status
from sweep.running.beside.error_bars import add_error_bars
from sweep.running.beside.refinement import refined
from sweep.running.beside.run_beside import How
from sweep.running.sweep import run_sweep
from sweep.store.read import read_summary
from tests.studies.tables import publish

CONFIGS = Path(__file__).parents[3] / "configs"
EVERY = {"armor.toml": 1, "impact.toml": 3}  # cases: as many of each scene
CELLS = 6  # across, at most: with 24 elements a wall a larger crush takes minutes
ELEMENTS, STEPS = 24, 4  # of a wall; for one of the design
PATIENCE = 1800.0  # s for a case
DIGITS, ROUND_OFF = 9, 1e-6  # of shares; below the second there is no error to cover
NAMES = {"displacement": "crushed", "force": "dead load", "impact": "struck"}


def finer(case):
    """The case with many elements a wall and short steps."""
    fine = refined(case, elements=ELEMENTS / min(case.lattice.pieces), steps=STEPS)
    solver = fine.solver.model_copy(update={"time_limit": PATIENCE})
    return fine.model_copy(update={"solver": solver, "axes": {}})


def beside_finer(designs, references):
    """A row for each error bar: its column, the bar and the error, as shares of the value.

    Columns of a case that carry the same information, such as energy and energy per gram, count
    once.
    """
    rows = []
    for (_, design), (_, fine) in zip(designs.iterrows(), references.iterrows(), strict=True):
        if not design["status"] == fine["status"] == Status.CONVERGED:
            continue
        for name in (match[1] for match in map(ERROR.fullmatch, designs) if match):
            value, bar = design[name], design[f"error_{name}"]
            error = abs(value - fine[name])
            if error > ROUND_OFF * abs(value) and bar == bar:
                row = {"case": design.name, "scene": NAMES[design["loading_mode"]], "column": name}
                rows.append(row | {"bar": bar / abs(value), "error": error / abs(value)})
    return pd.DataFrame(rows).round(DIGITS).drop_duplicates(["case", "bar", "error"])


def coverage(bars):
    """How many bars cover the error, and how wide they are, by scene and column, and in all."""
    rows = []
    for scene, group in bars.groupby("scene"):
        for column, alike in [("all", group), *group.groupby("column", sort=False)]:
            covered = (alike["bar"] >= alike["error"]).mean()
            ratio = (alike["bar"] / alike["error"]).median()
            error, bar = alike["error"].median(), alike["bar"].median()
            shares = [f"{100 * share:.1f}" for share in (error, bar)]
            rows.append(
                [scene, column, str(len(alike)), f"{100 * covered:.0f}", f"{ratio:.1f}", *shares]
            )
    heads = ["scene", "column", "bars", "cover %", "bar / error", "error %", "bar %"]
    return Sheet("Error bars beside errors (medians)", heads, rows)


def main(folder):
    """Run the missing cases, and print the table."""
    sweeps = [expand(load_config(CONFIGS / name))[::every] for name, every in EVERY.items()]
    designs = [design for cases in sweeps for design in cases if design.lattice.cells_x <= CELLS]
    missing = NAMES.keys() - {design.loading.mode for design in designs}
    if missing:
        raise SystemExit(f"no lattice of at most {CELLS} cells across has this loading: {missing}")
    references = [finer(design) for design in designs]
    files = folder / "designs.h5", folder / "references.h5"
    run_sweep(designs, files[0])
    add_error_bars(designs, files[0], How())
    run_sweep(references, files[1])
    tables = [
        read_summary(file).set_index("case_id").loc[[case.case_id for case in cases]]
        for file, cases in zip(files, (designs, references), strict=True)
    ]
    bars = beside_finer(*tables)
    told = f"{bars['case'].nunique()} of {len(designs)} cases; the others did not converge."
    publish([coverage(bars)._replace(notes=(told,))], folder / "bars.md")


if __name__ == "__main__":
    main(Path(sys.argv[1]))
