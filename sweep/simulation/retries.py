"""A case that stops is simulated again with shorter steps, then with another imperfection.

The advice of a failure is tried before it is given. Steps of an impact are at first the usual ones,
then quarters of them; another imperfection would not resolve it. What converges first has the
numbers of the row; its column `retry` says what was changed. The id stays that of the case asked
for.
"""

import time
from collections.abc import Iterator
from dataclasses import replace
from typing import Any

import numpy as np

from sweep.config.case import Case
from sweep.config.kinds.custom_structure import CustomStructure
from sweep.config.kinds.impact import Impact
from sweep.config.kinds.solver import Arcs, InTime
from sweep.config.kinds.table import RefusedError
from sweep.numbers import with_unit
from sweep.result import Result, Status
from sweep.simulation.simulate import EXPIRED, simulate
from sweep.simulation.time_resolution import resolving_step

SHORTER = 4  # times as many steps
TIMES = 4  # retries of an impact, each with a quarter of the time step before
FIRST = 0.25  # of the time limit, for an impact in steps that are much longer than usual
BOWED, BOW = 1.5, 0.01  # times the imperfection; in place of none, in wall thicknesses


def simulate_again(case: Case, stop: np.ndarray | None = None) -> Result:
    """The result of ``case``, or of the retry that came farthest; pure as `simulate` is.

    All together may take `solver.time_limit`. stop: as of `simulate`.
    """
    stop = np.zeros(2, np.int64) if stop is None else stop
    due, coarse = time.monotonic() + case.solver.time_limit, _is_coarse(case)
    best = last = simulate(case, stop, case.solver.time_limit * (FIRST if coarse else 1.0))
    if coarse and best.status is Status.TIMED_OUT:
        best = replace(best, curable=True)
        stop[0] *= stop[0] != EXPIRED
    spent, tried = float(best.summary["cpu_s"]), list[str]()
    for words, changed in _changes(best) if best.curable and case.solver.retry else ():
        left = due - time.monotonic()
        if stop[0] or left <= 0.0 or _reach(best)[0]:
            break
        last = simulate(changed, stop, left)
        spent += float(last.summary["cpu_s"])
        tried.append(words)
        if _reach(last) > _reach(best):
            best = replace(last, summary={**last.summary, "retry": words})
    return _told(case, best, tried, spent)


def _is_coarse(case: Case) -> bool:
    """Whether an impact that may be retried has steps far longer than usual.

    The solver takes hundreds of shares of each of them: the usual ones are sooner at the end.
    """
    if not (isinstance(case.loading, Impact) and isinstance(case.solver, InTime)):
        return False
    return case.solver.retry and SHORTER * resolving_step(case) < case.solver.time_step


def _reach(result: Result) -> tuple[bool, bool]:
    """How far a run came: to its end, and to the end of a loading that counts."""
    ended = result.status in (Status.CONVERGED, Status.SLIPPED)
    return ended, result.summary["loaded"] == 1


def _told(case: Case, best: Result, tried: list[str], spent: float) -> Result:
    """The result as that of ``case``, with all processor time (s).

    Its message says what was tried without success, in place of advice to try that.
    """
    message = best.message
    if tried and best.status is not Status.CONVERGED:
        what, _, advice = message.partition("; try ")
        repeats = any(words.split(" = ")[0] in advice for words in tried)
        message = f"{what if repeats else message} (tried without success: {'; '.join(tried)})"
    own: dict[str, float | str] = {"case_id": case.case_id, "message": message, "cpu_s": spent}
    return replace(best, case=case, message=message, summary={**best.summary, **own})


def _changes(result: Result) -> Iterator[tuple[str, Case]]:
    """What is tried in turn: the changed key with its value, and the case with it."""
    case = result.case
    for table, key, unit, value in _values(result):
        change: dict[str, Any] = {key: value}
        if key == "load_steps" and isinstance(case.solver, InTime):
            change["time_step"] = None  # follows
        try:
            yield f"{table}.{key} = {with_unit(value, unit)}", case.changed(**{table: change})
        except RefusedError:
            continue


def _values(result: Result) -> Iterator[tuple[str, str, str, float]]:
    """The changed keys: table, key, unit in SI, value."""
    case, bowed = result.case, not isinstance(result.case.lattice, CustomStructure)
    match case.solver:
        case Arcs(arc_length=length):
            yield "solver", "arc_length", "m", length / SHORTER
        case InTime() if isinstance(case.loading, Impact):
            first = resolving_step(case)
            yield from (("solver", "time_step", "s", first / SHORTER**k) for k in range(TIMES))
        case InTime(load_steps=None, time_step=step):
            yield "solver", "time_step", "s", step / SHORTER
        case solver:
            yield "solver", "load_steps", "", SHORTER * (solver.load_steps or 1)
    if bowed and result.status is Status.STOPPED:
        bow = case.lattice.imperfection
        yield "lattice", "imperfection", "", BOWED * bow if bow else BOW
