"""A case that stops is simulated again with other steps, then with another imperfection.

The advice of a failure is tried before it is given. An impact is retried with the usual integrator
and steps, then with quarters of these steps and, where these would be too many, for a shorter
duration, by whose end the striker has to be back. Another imperfection would not resolve it. Other
motions by an integrator of second order are also tried by backward Euler. The row has the numbers
of the first retry that converges, else of the attempt that reached farthest; its column `retry`
says what was changed. The id remains the id of the requested case.
"""

import time
from collections.abc import Iterator
from dataclasses import replace
from typing import Any

import numpy as np

from sweep.config.case import Case
from sweep.config.kinds.crush import Crush, steps_in
from sweep.config.kinds.custom_structure import CustomStructure
from sweep.config.kinds.dead_load import DeadLoad
from sweep.config.kinds.impact import Impact
from sweep.config.kinds.solver import MAX_STEPS, TIME_STEP, Arcs, InTime
from sweep.config.kinds.table import RefusedError
from sweep.numbers import with_unit
from sweep.result import Result, Status
from sweep.simulation.failures import faster_than_sound
from sweep.simulation.simulate import EXPIRED, simulate
from sweep.simulation.time_resolution import resolving_step

SHORTER = 4  # ratio of the numbers of steps
TIMES = 4  # retries of an impact, each with a quarter of the previous time step
FIRST = 0.25  # share of the time limit for a motion in steps much longer than usual
ALMOST = 1.0 - 1e-9
ENDED = Status.CONVERGED, Status.SLIPPED
ROBUST = "backward_euler"  # creates no energy, whatever its steps
BOWED, BOW = 1.5, 0.01  # factor of the imperfection; if there is none, wall thicknesses


def simulate_again(case: Case, stop: np.ndarray | None = None) -> Result:
    """The result of ``case``, or of the retry that reached farthest; as pure as `simulate`.

    All attempts together may take `solver.time_limit`. stop: as in `simulate`.
    """
    stop = np.zeros(3, np.int64) if stop is None else stop
    due, coarse = time.monotonic() + case.solver.time_limit, _is_coarse(case)
    best = last = simulate(case, stop, case.solver.time_limit * (FIRST if coarse else 1.0))
    if coarse and best.status is Status.TIMED_OUT:
        best = replace(best, curable=True)
        stop[0] *= stop[0] != EXPIRED
    spent, attempts = float(best.summary["cpu_s"]), list[str]()
    for words, changed in _changes(best) if best.curable and case.solver.retry else ():
        left = due - time.monotonic()
        # A lattice that tips over is curable: it may stand in shorter load steps.
        if stop[0] or left <= 0.0 or (best.status in ENDED and not best.curable):
            break
        last = simulate(changed, stop, left)
        spent += float(last.summary["cpu_s"])
        attempts.append(words)
        if _reach(last) > _reach(best) and not _is_cut_short(last, case):
            best = replace(last, summary={**last.summary, "retry": words})
    return _final_result(case, best, attempts, spent)


def _is_coarse(case: Case) -> bool:
    """Whether a motion that may be retried has steps far longer than usual.

    The solver takes hundreds of shares of each of them: the usual steps of an impact, and backward
    Euler in a crush or under a dead load, finish sooner.
    """
    if not (isinstance(case.solver, InTime) and case.solver.retry):
        return False
    match case.loading:
        case Impact():
            usual = resolving_step(case)
        case DeadLoad() if case.solver.integrator != ROBUST:
            usual = TIME_STEP
        case Crush(stroke=stroke, speed=float(speed)) if case.solver.integrator != ROBUST:
            usual = stroke / speed / steps_in(stroke / speed, None)
        case _:
            return False
    return SHORTER * usual < case.solver.time_step


def _is_cut_short(retry: Result, case: Case) -> bool:
    """Whether the striker of an impact was not back when a retry of shorter duration ended."""
    if not isinstance(case.loading, Impact) or not isinstance(retry.case.loading, Impact):
        return False
    followed = retry.case.loading.duration
    return followed < case.loading.duration and retry.history["time_s"][-1] >= ALMOST * followed


def _reach(result: Result) -> tuple[bool, bool, bool, bool]:
    """How far a run came: whether it converged, completed its loading, lost its striker, or failed
    for a reason that no other steps cure, as a striker that still moves at the end.
    """
    converged, slipped = (result.status is status for status in ENDED)
    certain = result.status is Status.STOPPED and not result.curable
    return converged, result.summary["loaded"] == 1, slipped, certain


def _final_result(case: Case, best: Result, attempts: list[str], spent: float) -> Result:
    """The best result under the id of ``case``, with the processor time of all attempts (s).

    Its message says what was tried without success, instead of advising it.
    """
    message = best.message
    attempts = [words for words in attempts if words != best.summary["retry"]]
    if attempts and best.status is not Status.CONVERGED:
        what, _, advice = message.partition("; try ")
        repeats = any(words.split(" = ")[0] in advice for words in attempts)
        message = f"{what if repeats else message} (tried without success: {'; '.join(attempts)})"
    if best.status is not Status.CONVERGED:
        message += faster_than_sound(case)
    own: dict[str, float | str] = {"case_id": case.case_id, "message": message, "cpu_s": spent}
    return replace(best, case=case, message=message, summary={**best.summary, **own})


def _changes(result: Result) -> Iterator[tuple[str, Case]]:
    """Retries in order: the changed keys with their values, and the changed case."""
    case = result.case
    for table, key, words, value in _values(result):
        change: dict[str, Any] = {key: value}
        if key == "load_steps" and isinstance(case.solver, InTime):
            change["time_step"] = None  # follows
        others: dict[str, Any] = {}
        if isinstance(case.loading, Impact):
            change["integrator"] = None  # the usual one
            if MAX_STEPS * float(value) < case.loading.duration:  # most is after contact
                others["loading"] = {"duration": MAX_STEPS * float(value)}
        try:
            changed = case.changed(**{table: change}, **others)
        except RefusedError:
            continue
        setting = f"{table}.{key} = {words}"
        if key != "integrator" and changed.solver.integrator != case.solver.integrator:
            setting += f', solver.integrator = "{changed.solver.integrator}"'
        yield setting, changed


def _values(result: Result) -> Iterator[tuple[str, str, str, float | str]]:
    """The changed keys: table, key, value in words, value in SI."""
    case, bowed = result.case, not isinstance(result.case.lattice, CustomStructure)
    moves = isinstance(case.solver, InTime) and not isinstance(case.loading, Impact)
    if not (moves and result.status is Status.TIMED_OUT):
        for key, unit, value in _shorter(case):
            yield "solver", key, with_unit(value, unit), value
    if moves and case.solver.integrator != ROBUST:
        yield "solver", "integrator", f'"{ROBUST}"', ROBUST
    if bowed and result.status is Status.STOPPED:
        bow = BOWED * case.lattice.imperfection or BOW
        yield "lattice", "imperfection", with_unit(bow, ""), bow


def _shorter(case: Case) -> Iterator[tuple[str, str, float]]:
    """Shorter steps: key, unit in SI, value."""
    match case.solver:
        case Arcs(arc_length=length):
            yield "arc_length", "m", length / SHORTER
        case InTime() if isinstance(case.loading, Impact):
            first = resolving_step(case)
            yield from (("time_step", "s", first / SHORTER**k) for k in range(TIMES))
        case InTime(load_steps=None, time_step=step):
            yield "time_step", "s", step / SHORTER
        case solver:
            yield "load_steps", "", SHORTER * (solver.load_steps or 1)
