"""Whether a ranking with failed cases names another first design than one with four times the
effort, and says nothing.

Run by `make effort`: random small grids of crushes that may take so few Newton iterations a step
that many stop, and the same with `MORE` times as many. A first design that changes must have been
named among the unfinished cases that could be first, or share the first place, or the steps of one
of the two were marked as coarse. The table also has the grids with `MORE` times as many load steps
beside: there values themselves change a little.
"""

import sys
from concurrent.futures import ProcessPoolExecutor
from dataclasses import dataclass
from functools import partial
from pathlib import Path

import numpy as np
import pandas as pd

from sweep.config.case import Case
from sweep.numbers import tenths
from sweep.ranking.rank import ranked
from sweep.report.tables.sheet import Sheet
from sweep.simulation.retries import simulate_again
from tests.studies.rankings.spread import CELLS
from tests.studies.tables import publish

GRIDS, MORE, SEED = 300, 4, 38
ITERATIONS, STEPS = (2, 3, 4, 20), (25, 50)  # of the small effort
PATIENCE = 10.0  # s for a case: with few iterations some go on in very short steps
BY = ("absorbed_energy_until_packed_J", "specific_absorption_J_per_g", "peak_force_N")


@dataclass(frozen=True)
class Grid:
    """Designs, the loading and material that they share, the small effort, the sorting column."""

    designs: tuple[dict[str, object], ...]
    strain: float
    platen: str
    material: str
    iterations: tuple[int, ...]  # of each design
    steps: int
    by: str

    def cases(self, iterations=1, steps=1):
        """The cases with so many times the effort."""
        loading = {"mode": "displacement", "strain": self.strain, "platen": self.platen}
        solver = {"load_steps": steps * self.steps, "retry": False}
        solver["time_limit"] = PATIENCE
        return [
            Case.of(
                lattice=design,
                loading=loading | {"unload": False},
                material={"name": self.material},
                solver=solver | {"max_iterations": iterations * few},
            )
            for design, few in zip(self.designs, self.iterations, strict=True)
        ]


def drawn(number):
    """The grid of a number."""
    rng = np.random.default_rng([SEED, number])
    pick = partial(_picked, rng)
    designs = tuple(
        {
            "kind": pick(CELLS),
            "cells_x": int(rng.integers(2, 4)),
            "cells_y": int(rng.integers(2, 4)),
            "wall_thickness": float(rng.uniform(0.4e-3, 0.8e-3)),
            "width": 16e-3,
            "height": 16e-3,
        }
        for _ in range(int(rng.integers(2, 6)))
    )
    strain, platen = float(rng.uniform(0.2, 0.6)), pick(("glued", "contact"))
    material = pick(("ninjaflex", "cheetah"))
    iterations = tuple(pick(ITERATIONS) for _ in designs)
    return Grid(designs, strain, platen, material, iterations, pick(STEPS), pick(BY))


def _picked(rng, values):
    values = list(values)
    return values[int(rng.integers(len(values)))]


def outcome(number):
    """The outcome of the first place of a grid: a row of the study."""
    grid = drawn(number)
    few = _ranked(grid, grid.cases())
    row = {"grid": number, "cases": few.cases, "failed": few.failed}
    for name, steps in (("iterations", 1), ("steps", MORE)):
        many = _ranked(grid, grid.cases(MORE, steps))
        row[name] = compared(few, many)
        row[f"{name}_failed"] = many.failed
        row[f"{name}_gap"] = _gap(few, many, grid.by)
    return row


def _ranked(grid, cases):
    """The ranking of the cases; ids are replaced by numbers, which do not change with effort."""
    summary = pd.DataFrame([simulate_again(case).summary for case in cases])
    ids = [f"{number:016x}" for number in range(len(cases))]
    return ranked(summary.assign(case_id=ids), by=grid.by, top=None)


def compared(few, many):
    """How the first place with more effort stands in the ranking with less, in a word."""
    first, before = _first(many), _first(few)
    unfinished = few.unfinished
    could = {*unfinished["case_id"][unfinished["best_place"] == 1]}
    if not before:
        return "nothing ranked"
    if first & before:
        return "same"
    if first <= could:
        return "named"
    ranked_too = few.table["case_id"].isin(first | before)
    return "marked" if few.table.loc[ranked_too, "coarse"].any() else "changed"


def _first(ranking):
    """Ids of the first place."""
    return {*ranking.table["case_id"][ranking.table["place"] == 1]}


def _gap(few, many, by):
    """The share by which the former first design is worse in the ranking with more effort."""
    values = many.table.set_index("case_id")[by]
    before = values.reindex(sorted(_first(few))).dropna()
    if before.empty or values.empty:
        return np.nan
    return float((abs(before - values.iloc[0]) / abs(values.iloc[0])).min())


def sheet(rows):
    """How many grids have the same first design, one that was named, or another."""
    words = ("same", "named", "marked", "changed", "nothing ranked")
    table = []
    for name in ("iterations", "steps"):
        counts = rows[name].value_counts()
        gaps = rows[f"{name}_gap"][rows[name] == "changed"]
        worst = tenths(gaps.max()) if len(gaps) else "-"
        table.append([name, *(str(counts.get(word, 0)) for word in words), worst])
    failed = int(rows["failed"].sum())
    note = f"{failed} of {rows['cases'].sum()} cases stop with the small effort."
    heads = ["four times the", *words, "greatest gap, %"]
    return Sheet("The first design with more effort", heads, table, notes=(note,))


def main(folder, grids=GRIDS):
    """Print the table; return whether a first design changes without a word."""
    folder.mkdir(parents=True, exist_ok=True)
    with ProcessPoolExecutor() as pool:
        rows = pd.DataFrame(pool.map(outcome, range(grids), chunksize=4))
    rows.to_csv(folder / "effort.csv", index=False)
    publish([sheet(rows)], folder / "effort.md")
    return int((rows["iterations"] == "changed").any())


if __name__ == "__main__":
    sys.exit(main(Path(sys.argv[1]), *map(int, sys.argv[2:])))
