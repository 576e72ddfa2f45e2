"""Error against run time with each part of the material, by the number of load steps."""

import time

from sweep.config.case import Case
from sweep.numbers import tenths
from sweep.report.tables.sheet import Sheet
from tests.studies.memory.variants import PARTS
from tests.support.converged import converged

STEPS, FINEST = (25, 50, 100, 200, 400), 1600
ENERGIES = ("absorbed_energy_J", "returned_energy_J")
REPEATS = 5
USUAL = 200
ELASTIC = {"elastic": {}}


def crush(part, steps):
    """A crush of the default lattice to 60 % and back."""
    return Case.of(
        lattice={},
        material=part,
        loading=dict(mode="displacement", strain=0.6),
        solver=dict(load_steps=steps),
    )


def timed(case, repeats=REPEATS):
    """The summary of a case, and the least processor time of its runs, s."""
    spent = []
    for _ in range(repeats):
        start = time.process_time()
        row = converged(case).summary
        spent.append(time.process_time() - start)
    return row, min(spent)


def costs(parts=PARTS, steps=STEPS, finest=FINEST):
    """Errors of the absorbed and of the returned energy by number of steps, and the cost."""
    heads = ["material", *(f"{n} steps" for n in steps), f"time at {USUAL}"]
    body, base = [], None
    for name, part in (ELASTIC | parts).items():
        truth = converged(crush(part, finest)).summary
        row, spending = [name], {}
        for n in steps:
            found, spent = timed(crush(part, n), REPEATS if n == USUAL else 1)
            errors = [abs(found[key] / truth[key] - 1.0) for key in ENERGIES]
            row.append(" / ".join(map(tenths, errors)))
            spending[n] = spent
        base = spending[USUAL] if base is None else base
        body.append([*row, f"{spending[USUAL] / base:.2f}"])
    notes = (
        f"Errors of absorbed / returned energy in %, beside {finest} steps; 3 x 3 cells to 60 %.",
        "Time: processor time over that of elastic walls.",
    )
    return Sheet("Error against steps, and the price of a memory", heads, body, notes=notes)
