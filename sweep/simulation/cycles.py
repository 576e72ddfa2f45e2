"""Energy absorbed and lost, and force transmitted, in each cycle of a crush."""

from math import nan

from sweep.array_types import Floats
from sweep.columns import cycle_columns
from sweep.scene.loading import CycleRows


def columns_of_cycles(cycles: list[CycleRows], work: Floats, force: Floats) -> dict[str, float]:
    """The columns of `cycle_columns`, and the absorbed energy of the second cycle over the first.

    work (rows,): done on the lattice so far, J; force (rows,): on the lattice, N. NaN: the run
    ended before.
    """
    if len(cycles) == 1:
        return {"second_cycle_share": nan}
    columns = dict[str, float]()
    for number, (start, loaded, _, end) in enumerate(cycles, 1):
        absorbed = _work_between(work, start, loaded)
        peak = force[start : end + 1].max() if end < len(force) else nan
        lost = min(_work_between(work, start, end), absorbed)  # pulling back is no loss
        values = absorbed, lost, float(peak)
        columns |= zip(cycle_columns(number), values, strict=True)
    first, second = (columns[cycle_columns(number)[0]] for number in (1, 2))
    return columns | {"second_cycle_share": second / first}


def _work_between(work: Floats, start: int, end: int) -> float:
    """Work (J) done between two rows; NaN if the second one is missing."""
    return float(work[end] - work[start]) if end < len(work) else nan
