"""What a crush absorbs, loses and passes on in each of its cycles."""

from math import nan

from sweep.columns import cycle_columns
from sweep.config.case import Case, given
from sweep.scene.mesh import Floats


def columns_of_cycles(case: Case, work: Floats, force: Floats) -> dict[str, float]:
    """The columns of `cycle_columns`, and the second cycle's absorbed energy over the first's.

    work (rows,) J done on the lattice so far, force (rows,) N passed on. NaN: the run ended before.
    """
    cycles = case.loading.cycles or 1
    if cycles == 1:
        return {"second_cycle_share": nan}
    steps, found = given(case.solver.load_steps), dict[str, float]()
    for number in range(cycles):
        begun, turned, ended = (steps * (2 * number + stages) for stages in range(3))
        absorbed = _gained(work, begun, turned)
        peak = force[begun : ended + 1].max() if ended < len(force) else nan
        lost = min(_gained(work, begun, ended), absorbed)  # pulling back is no loss
        values = absorbed, lost, float(peak)
        found |= zip(cycle_columns(number + 1), values, strict=True)
    first, second = (found[cycle_columns(number)[0]] for number in (1, 2))
    return found | {"second_cycle_share": second / first}


def _gained(work: Floats, begun: int, ended: int) -> float:
    """Work (J) done between two rows; NaN if the second one is missing."""
    return float(work[ended] - work[begun]) if ended < len(work) else nan
