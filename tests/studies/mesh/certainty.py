"""Error bars and ties of the default mesh against the errors and the order of the finest one."""

import numpy as np
import pandas as pd

from sweep.running.beside.error_bars import companions, error_bars
from tests.studies.mesh.crushes import usual, work
from tests.studies.rankings.bars import beside_finer, coverage
from tests.support.converged import demand


def covered(cases, rows):
    """How many error bars of the default mesh cover the error, by column: the sheet of `bars`.

    The notes state the cost of the bars, and whether designs that are no ties are in order.
    """
    designs = {design: case for (design, n), case in cases.items() if n == usual(design)}
    known = dict(zip(rows.index, rows.to_dict("records"), strict=True))
    bars = {case.case_id: error_bars(case, known) for case in designs.values()}
    finest = max(n for _, n in cases)
    barred = rows.loc[list(bars)].join(pd.DataFrame(bars).T)
    truth = rows.loc[[cases[design, finest].case_id for design in designs]]
    for table in (barred, truth):
        demand(table.assign(case_id=table.index).to_dict("records"))
    both = [[each.case for each in companions(case)] for case in designs.values()]
    spent = sum(work(case, rows) for pair in both for case in pair)
    alone = sum(work(case, rows) for case in designs.values())
    compared = "absorbed_energy_until_packed_J"
    values, limits = (table[compared] / table["mass_g"] for table in (barred, truth))
    corrections = barred[f"correction_{compared}"] / barred["mass_g"]
    platens = np.array([platen for _, (platen, _) in designs])
    counts = sum(
        order(*(column.to_numpy()[platens == platen] for column in (values, corrections, limits)))
        for platen in set(platens)
    )
    notes = (
        f"With its error bars the sweep is {1.0 + spent / alone:.1f} x the work.",
        "Of {} pairs of designs, {} are in the wrong order; {} of these tie, and {} others.".format(
            *counts
        ),
    )
    return coverage(beside_finer(barred, truth))._replace(notes=notes)


def order(values, corrections, limits):
    """Numbers of pairs: in all, in the wrong order, of these ties, and other ties, (4,)."""
    one, other = np.triu_indices(len(values), 1)
    gap = values[one] - values[other]
    wrong = gap * (limits[one] - limits[other]) < 0.0
    tied = np.abs(gap) <= np.abs(corrections[one] - corrections[other])
    return np.array([len(gap), wrong.sum(), (wrong & tied).sum(), (tied & ~wrong).sum()])
