"""Estimates the cost of a sweep before it starts, from a few of its cases.

The time of a case is assumed to be proportional to `batches.cost`, with a factor that is measured
for each kind of loading and mesh. The factor depends on the behaviour of a design, such as how
often walls touch: if cases are many or short, each kind is divided by family, wall thickness and
load into groups with factors of their own. A long case is stopped: its later steps are assumed to
be as slow as in the second half of its time. Walls that are pressed along the cells count `FOLDING`
times, since steps are ten times slower after they collapse. Other programs are assumed to use the
cores as they do while the pilots run. The estimate may still be wrong by a factor of two.
"""

import time
from bisect import bisect
from collections.abc import Sequence
from dataclasses import dataclass
from itertools import accumulate, pairwise
from math import isnan, nan
from threading import Timer

import numpy as np

from sweep.config.case import Case
from sweep.config.grid import Config, expand
from sweep.config.kinds.crush import Crush
from sweep.config.kinds.dead_load import DeadLoad
from sweep.config.kinds.impact import Impact
from sweep.config.kinds.sheet import Surface
from sweep.config.kinds.steps import count_of
from sweep.numbers import counted, text_in, to_si
from sweep.result import Result, Status
from sweep.running.batches import Kind, Plan, cost, kind
from sweep.running.beside.error_bars import companions_beside
from sweep.running.beside.run_beside import file_beside
from sweep.running.child_process import Simulate
from sweep.running.sweep import Interrupted, interruptible
from sweep.running.threads import Stop, run_on_threads
from sweep.running.warming import real_simulate
from sweep.store.read import Rerun, finished_ids

BYTES = 4  # per stored number, in single precision
PACKED = 0.9  # compressed / original size, of curves and shapes together
SPENT = 8.0  # s of processor time for the groups of all kinds
LONGEST = 10.0  # s of processor time for a pilot; a longer one is stopped and extrapolated
GROUPS = 9  # most groups of one kind
SHARE = 3  # least number of cases in a group
FOLDING = (
    (0.0, 0.05, 0.1, 0.15, 0.2, 0.25, 0.35, 0.45, 0.5, 1.0),
    (0.0, 0.013, 0.026, 0.064, 0.17, 0.33, 0.6, 0.87, 1.0, 2.3),
)
"""Strain, and the time that crushes along the cells take until then, as a share of the time to 50
%.

The mean of square, brick and hex in `configs/which_way.toml`; beyond 50 % as between 45 and 50 %.
"""
UNFOLDING = 0.25  # share of the time that loading takes
ROW = 1000  # bytes of the summary of a case


@dataclass(frozen=True)
class Estimate:
    """Processor time `cpu` (s) and disk space (bytes) of a sweep.

    The `pilots` are the cases that were run for it, in `seconds`; `failures`: messages of pilots
    that did not converge. The time is NaN if a pilot has no measured time. `stopped`: pilots whose
    time is extrapolated from their first steps. `others`: mean number of cores that other
    programs used at the same time.
    """

    cpu: float
    disk: float
    pilots: int
    failures: list[str]
    seconds: float
    stopped: int = 0
    others: float = 0.0

    def wall(self, workers: int, cores: int) -> float:
        """Time (s) on ``workers``, which share the cores with other programs."""
        return self.cpu / workers * max((workers + self.others) / cores, 1.0)


def dry_run(
    config: Config,
    out: str,
    workers: int,
    rerun: Rerun,
    error_bars: bool,
) -> str:
    """Number of cases, time and disk space of a sweep, as text. Writes no file."""
    from dask.system import cpu_count

    cases = expand(config)
    done = finished_ids(out, rerun)
    waiting = [case for case in cases if case.case_id not in done]
    counts = (
        f"{config.name}: {counted(config.recipe.count, 'combination')}, "
        f"{counted(len(cases), 'different case')}, "
        f"{len(cases) - len(waiting):,} of them finished in {out}"
    )
    if error_bars:
        others = companions_beside(cases, out, rerun)
        ready = others.keys() & finished_ids(file_beside(out, "companions"), rerun)
        waiting += [case for case_id, case in others.items() if case_id not in ready]
        companions = counted(len(others), "companion")
        counts += f"\nerror bars: {companions}, {len(ready):,} of them finished"
    if not waiting:
        return f"{counts}\nnothing is left to run"
    forecast = estimate(waiting, real_simulate(waiting))
    wall = forecast.wall(min(workers, len(waiting)), cpu_count())
    lines = [
        counts,
        f"estimate for {counted(len(waiting), 'case')}, after running {forecast.pilots} of them "
        f"({forecast.seconds:.1f} s); it may be off by a factor of two:",
        f"  processor time  {duration(forecast.cpu)}",
        f"  wall time       {duration(wall)} on {workers} workers",
        f"  disk            {text_in(forecast.disk, 'MB', 2)}",
        "no result was written",
    ]
    if forecast.stopped:
        first = f"{forecast.stopped} of them stopped early; later steps may be slower"
        lines.insert(2, f"  {first}")
    if forecast.failures:
        count = f"{len(forecast.failures)} of the pilot cases did not converge"
        lines.insert(-1, f"  {count}: {forecast.failures[0]}")
    return "\n".join(lines)


def estimate(cases: Sequence[Case], simulate: Simulate) -> Estimate:
    """Run one case of each kind of loading and mesh and, if these are short, one of each of its
    groups; scale their costs to their groups.
    """
    from psutil import cpu_count, cpu_percent

    kinds: dict[Kind, list[Case]] = {}
    for case in cases:
        kinds.setdefault(kind(case), []).append(case)
    first = [(_middle(sorted(alike, key=cost)), alike) for alike in kinds.values()]
    started, seconds = time.perf_counter(), dict[str, float]()
    timed = _timed(simulate, seconds)
    cpu_percent()  # begins to measure
    own = time.process_time()
    results = _run_all([pilot for pilot, _ in first], timed)
    pilots = [
        group
        for pilot, alike in first
        for group in _groups(pilot, alike, SPENT / len(first), seconds.get(pilot.case_id, nan))
    ]
    others = [pilot for pilot, _ in pilots if pilot.case_id not in results]
    results |= _run_all(others, timed) if others else {}
    spent = time.perf_counter() - started
    busy = to_si(cpu_percent(), "%") * (cpu_count() or 1) - (time.process_time() - own) / spent
    cpu = disk = 0.0
    for pilot, alike in pilots:
        case_id = pilot.case_id
        cpu += seconds.get(case_id, nan) * sum(map(cost, alike)) / cost(pilot)
        disk += len(alike) * _stored(results[case_id])
    failures = [
        r.message for r in results.values() if r.status not in (Status.CONVERGED, Status.TIMED_OUT)
    ]
    stopped = sum(r.status is Status.TIMED_OUT for r in results.values())
    return Estimate(cpu, disk, len(results), failures, spent, stopped, max(busy, 0.0))


def _run_all(pilots: Sequence[Case], simulate: Simulate) -> dict[str, Result]:
    """Results by case id, computed one at a time in the same way as in a sweep."""
    stop, results = Stop(), list[Result]()
    with interruptible(stop):
        run_on_threads(Plan(pilots, workers=1), simulate, results.extend, stop)
    if stop.flag:
        raise Interrupted("interrupted; no result was written")
    return {result.case_id: result for result in results}


def _timed(simulate: Simulate, seconds: dict[str, float]) -> Simulate:
    """The function `simulate`, limited to about `LONGEST`; it records the processor time (s) of a
    case.
    """
    from dask.system import cpu_count
    from psutil import getloadavg

    longest = LONGEST * max((1.0 + getloadavg()[0]) / cpu_count(), 1.0)

    def run(case: Case, control: np.ndarray) -> Result:
        limit, middle = min(longest, case.solver.time_limit), [0]
        timer = Timer(0.5 * limit, lambda: middle.append(int(control[1])))
        timer.start()
        try:
            result = simulate(_limited(case, limit), control)
        finally:
            timer.cancel()
        taken = float(result.summary["cpu_s"])
        if result.status is Status.TIMED_OUT:
            taken *= _duration_ratio(case, middle[-1], int(control[1]))
        seconds[case.case_id] = min(taken, case.solver.time_limit)
        return result

    return run


def _duration_ratio(case: Case, middle: int, done: int) -> float:
    """How many times as long a whole case takes as its first `done` steps did, `middle` of them in
    half of that time.
    """
    count, loading = count_of(case.loading, case.solver), case.loading
    if _folds(case) and isinstance(loading, Crush) and case.solver.load_steps:
        strain = loading.strain * min(max(done, 1) / case.solver.load_steps, 1.0)
        until, whole = np.interp([strain, loading.strain], *FOLDING)
        unloading = UNFOLDING if loading.unload else 0.0
        return float(whole / until) * loading.cycles * (1.0 + unloading)
    return 1.0 + 0.5 * max(count - done, 0.0) / max(done - middle, 1)


def _folds(case: Case) -> bool:
    """Whether walls stand upright and are flat at rest: they fold all at once."""
    return case.shells and not isinstance(case.lattice, Surface)


def _limited(pilot: Case, limit: float) -> Case:
    """The case with another time limit (s), which does not enter its id."""
    solver = pilot.solver.model_copy(update={"time_limit": limit})
    return pilot.model_copy(update={"solver": solver})


def duration(seconds: float) -> str:
    """A time with two digits and a unit; "unknown" for NaN."""
    if isnan(seconds):
        return "unknown"
    for unit, length in {"h": 3600.0, "min": 60.0}.items():
        if seconds >= 2.0 * length:
            return f"{float(f'{seconds / length:.2g}'):g} {unit}"
    return f"{float(f'{seconds:.2g}'):g} s"


def _middle(ordered: Sequence[Case]) -> Case:
    """The median of sorted cases, weighted by cost."""
    done = list(accumulate(map(cost, ordered)))
    return ordered[bisect(done, 0.5 * done[-1])]


def _groups(
    pilot: Case, alike: list[Case], spent: float, seconds: float
) -> list[tuple[Case, list[Case]]]:
    """Groups of cases of one kind, each with the case that represents it.

    One group, represented by `pilot`, unless others may run in the time `spent` (s).
    """
    affordable = 1.0 if isnan(seconds) else spent / max(seconds, 1e-3)
    count = int(min(GROUPS, affordable, len(alike) / SHARE))
    if count < 2:
        return [(pilot, alike)]
    ordered = sorted(alike, key=_design)
    ends = [round(k * len(ordered) / count) for k in range(count + 1)]
    parts = [ordered[begin:end] for begin, end in pairwise(ends)]
    return [(_middle(part), part) for part in parts]


def _design(case: Case) -> tuple[str, float, float, float]:
    """The values that determine how a case of its kind behaves: family, wall thickness, load,
    cost.
    """
    load = 0.0
    match case.loading:
        case DeadLoad(force=size) | Impact(energy=size) | Crush(stroke=size):
            load = size
    return case.lattice.name, case.lattice.wall_thickness, load, cost(case)


def _stored(result: Result) -> float:
    """Bytes of a case in the results file."""
    arrays = [*result.history.values(), *result.frames.values()]
    return ROW + PACKED * BYTES * sum(array.size for array in arrays)
