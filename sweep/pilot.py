"""What a sweep will cost, before it starts: a few of its cases are run and scaled to all.

The time of a case is taken to grow with `plan.cost`; kinds of loading are measured one by one. Good
to a factor of two or so: how often walls meet cannot be known before they do.
"""

import time
from bisect import bisect
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from itertools import accumulate

from sweep.grid import Config, case_count, expand
from sweep.params import Case
from sweep.plan import cost
from sweep.result import Result, Status
from sweep.store import finished_ids

BYTES = 4  # of a stored number: single precision
PACKED = 0.75  # what compression leaves of curves and shapes
ROW = 1000  # bytes of the summary of a case

Simulate = Callable[[Case], Result]


@dataclass(frozen=True)
class Estimate:
    """Processor time (s) and disk (bytes) of a sweep, from `pilots` cases that took `seconds`."""

    cpu: float
    disk: float
    pilots: int
    failed: int
    seconds: float


def dry_run(config: Config, out: str, workers: int, retry_failed: bool) -> str:
    """How many cases, how long, how much disk: as text. Writes nothing."""
    cases = expand(config)
    done = finished_ids(out, retry_failed)
    waiting = [case for case in cases if case.case_id not in done]
    counts = (
        f"{config.name}: {case_count(config):,} combinations, {len(cases):,} different cases, "
        f"{len(cases) - len(waiting):,} of them finished in {out}"
    )
    if not waiting:
        return f"{counts}\nnothing is left to run"
    from sweep.simulate import simulate

    found = estimate(waiting, simulate)
    wall = found.cpu / min(workers, len(waiting))
    lines = [
        counts,
        f"estimate for {len(waiting):,} cases, from {found.pilots} pilot cases "
        f"({found.seconds:.1f} s); it may be off by a factor of two:",
        f"  processor time  {duration(found.cpu)}",
        f"  wall time       {duration(wall)} on {workers} workers",
        f"  disk            {found.disk / 1e6:.2g} MB",
        "nothing was written",
    ]
    if found.failed:
        lines.insert(-1, f"  {found.failed} of the pilot cases did not converge")
    return "\n".join(lines)


def estimate(cases: Sequence[Case], simulate: Simulate) -> Estimate:
    """Run one case of each kind of loading and scale it to the others of its kind."""
    started = time.perf_counter()
    simulate(min(cases, key=cost))  # warms up: kernels are compiled or loaded here
    kinds: dict[tuple[str, ...], list[Case]] = {}
    for case in cases:
        kinds.setdefault(_kind(case), []).append(case)
    cpu = disk = failed = 0.0
    for alike in kinds.values():
        pilot = _middle(alike)
        result = simulate(pilot)
        cpu += float(result.summary["cpu_s"]) * sum(map(cost, alike)) / cost(pilot)
        disk += len(alike) * _stored(result)
        failed += result.status != Status.CONVERGED
    return Estimate(cpu, disk, len(kinds), int(failed), time.perf_counter() - started)


def duration(seconds: float) -> str:
    """A time that is only roughly known."""
    for unit, length in {"h": 3600.0, "min": 60.0}.items():
        if seconds >= 2.0 * length:
            return f"{float(f'{seconds / length:.2g}'):g} {unit}"
    return f"{float(f'{seconds:.2g}'):g} s"


def _kind(case: Case) -> tuple[str, ...]:
    """What changes the pace of the solver most, besides the number of elements and steps."""
    return (case.loading.mode, str(case.loading.platen), case.contact.model)


def _middle(cases: Sequence[Case]) -> Case:
    """The case in the order of their costs before which half of all the work is done."""
    ordered = sorted(cases, key=cost)
    done = list(accumulate(map(cost, ordered)))
    return ordered[bisect(done, 0.5 * done[-1])]


def _stored(result: Result) -> float:
    """Bytes that a case takes in the results file."""
    arrays = [*result.history.values(), *result.frames.values()]
    return ROW + PACKED * BYTES * sum(array.size for array in arrays)
