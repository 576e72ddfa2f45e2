"""Sweeps with poisoned cases, on threads, in processes and on a cluster.

One case kills its process, one needs more memory than there is, and one ends only when it is
requested to. In processes, which can be killed, another one does not end even then. All of them
must become rows with the right status, and none of the others may be lost.
"""

import os
import subprocess
import sys
import time
from collections.abc import Callable
from pathlib import Path
from typing import NamedTuple

import numpy as np

from sweep.config.case import Case
from sweep.report.tables.sheet import Sheet
from sweep.result import Result, Status, failed_result
from sweep.running.child_process import NO_MEMORY
from sweep.running.cluster import open_cluster
from sweep.running.processes import PROCESSES
from sweep.running.sweep import run_sweep
from sweep.simulation.time_limit import WATCH
from sweep.store.read import read_summary
from tests.support.cluster import Processes
from tests.support.results.standin import cases, number_of, simulate

DEADLY, LARGE, LONG, DEAF, FAILING = 3, 4, 5, 6, 7  # numbers of cases
DEATH = 9  # exit status of a process that the deadly case has killed
TOO_MUCH = 1 << 47  # bytes: more than a process can address
LIMIT = 0.3  # seconds for a case
WAIT, LATEST = 60.0, 300.0  # seconds for a worker; for a run that is to die
WORKERS = 2
PROGRAM = "import sys; from tests.studies.torture.poison import die; die({!r}, {})"


class Poisoned(NamedTuple):
    """The outcome of a sweep: cases; lost cases; cases with a wrong status; seconds that it
    took.
    """

    cases: int
    lost: int
    wrong: int
    seconds: float


def poisonous(case: Case, control: np.ndarray) -> Result:
    """A case of 20 ms, or one that is poisoned."""
    number = number_of(case)
    time.sleep(0.02)
    if number == DEADLY:
        os._exit(DEATH)
    if number == LARGE:
        np.empty(TOO_MUCH, np.uint8)
    if number == DEAF:
        time.sleep(LATEST)
    if number == LONG:
        with WATCH.limit(LIMIT, lambda: control.__setitem__(0, 1)):
            while not control[0]:
                time.sleep(0.01)
        return failed_result(case, Status.TIMED_OUT, "")
    return simulate(case)


def batch(count: int, deaf: bool) -> list[Case]:
    """Cases with a time limit; deaf: with the one that only a kill ends."""
    some = [case.changed(solver={"time_limit": LIMIT}) for case in cases(count)]
    return [case for case in some if deaf or number_of(case) != DEAF]


def die(out: str, count: int) -> None:
    """Run a sweep on threads, which ends this process."""
    run_sweep(batch(count, deaf=False), out, WORKERS, simulate=poisonous)


def on_threads(folder: Path, count: int) -> list[Case]:
    """The run dies; the next one finds out why, and runs the rest."""
    out, some = folder / "poisoned.h5", batch(count, deaf=False)
    program = PROGRAM.format(str(out), count)
    ended = subprocess.run([sys.executable, "-c", program], check=False, timeout=LATEST)
    assert ended.returncode == DEATH
    run_sweep(some, out, WORKERS, simulate=poisonous)
    return some


def in_processes(folder: Path, count: int) -> list[Case]:
    """One run, as with `--processes`."""
    some = batch(count, deaf=True)
    run_sweep(some, folder / "poisoned.h5", WORKERS, PROCESSES, simulate=poisonous)
    return some


def on_cluster(folder: Path, count: int) -> list[Case]:
    """One run; the deadly case kills one worker before it runs alone."""
    from distributed.utils import silence_logging_cmgr  # processes of cases do not need it

    some = batch(count, deaf=False)
    with silence_logging_cmgr("CRITICAL"), Processes(folder) as processes:
        processes.add(WORKERS)
        with open_cluster(str(processes.file), WAIT) as cluster:
            run_sweep(some, folder / "poisoned.h5", scheduler=cluster, simulate=poisonous)
    return some


PLACES: dict[str, Callable[[Path, int], list[Case]]] = {
    "threads": on_threads,
    "processes": in_processes,
    "cluster": on_cluster,
}


def torture(folder: Path, place: str, count: int) -> Poisoned:
    """A sweep of ``count`` cases in one of the `PLACES`."""
    started = time.monotonic()
    some = PLACES[place](folder, count)
    seconds = time.monotonic() - started
    table = read_summary(folder / "poisoned.h5")
    ends = dict(
        zip(table["case_id"], zip(table["status"], table["message"], strict=True), strict=True)
    )
    found = [(number_of(case), *ends[case.case_id]) for case in some if case.case_id in ends]
    wrong = sum(not is_right(*each) for each in found)
    return Poisoned(len(some), len(some) - len(found), wrong, seconds)


def is_right(number: int, status: str, message: str) -> bool:
    """Whether a case of this number has to end so."""
    if number == LARGE:
        return (status, message) == (Status.STOPPED, NO_MEMORY)
    special = {DEADLY: Status.WORKER_DIED, FAILING: Status.STOPPED}
    late = dict.fromkeys((LONG, DEAF), Status.TIMED_OUT)
    return status == (special | late).get(number, Status.CONVERGED)


def is_sound(found: dict[str, Poisoned]) -> bool:
    """Whether no case is lost and each ended as it must."""
    return all(each.lost == each.wrong == 0 < each.cases for each in found.values())


def sheet(found: dict[str, Poisoned]) -> Sheet:
    """The table of `torture`, by place."""
    heads = ["where", "cases", "rows lost", "rows wrong", "seconds"]
    rows = [
        [place, str(each.cases), str(each.lost), str(each.wrong), f"{each.seconds:.1f}"]
        for place, each in found.items()
    ]
    return Sheet("Poisoned cases", heads, rows)
