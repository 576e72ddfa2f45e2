"""Kills workers and schedulers below two runs, and looks whether their files come out as they must.

The runs share a scheduler. Each has a case that kills its process, and one that fails. A worker of
another source wants to take part, and must be refused.
"""

import io
import os
import re
import shutil
import sys
import time
from concurrent.futures import Future, ThreadPoolExecutor
from contextlib import redirect_stderr
from pathlib import Path
from typing import NamedTuple, TextIO

import numpy as np
from distributed import Client
from distributed.utils import silence_logging_cmgr

from sweep.config.case import Case
from sweep.report.tables.sheet import Sheet
from sweep.result import Result, Status
from sweep.running.cluster import ClusterError, open_cluster
from sweep.running.sweep import run_sweep
from sweep.store.read import read_statuses
from tests.support.cluster import ROOT, Processes
from tests.support.results.standin import cases, number_of, simulate

WORKERS = 2
LONGEST = 2.0  # seconds between two kills
POISON, FAILING = 11, 7
WAIT = 60.0  # seconds for a worker
PACKAGES = ("kernels", "sweep", "tests/support", "tests/studies/torture")  # of a worker
OTHER = "other"  # name of the worker of another source
REFUSED = re.compile(rf"worker {OTHER} .*is refused: it has source ")


class Killed(NamedTuple):
    """Kills of workers and of schedulers; rows that a run lost, and rows that are not as they must.

    sentences: how often runs ended with the sentence of a lost scheduler. refused: how often runs
    said that they refuse the worker of another source.
    """

    workers: int
    schedulers: int
    sentences: int
    lost: int
    wrong: int
    refused: int


class _Heard(io.StringIO):
    """A stream that also records the text that is written to it."""

    def __init__(self, stream: TextIO) -> None:
        super().__init__()
        self._stream = stream

    def write(self, text: str) -> int:
        self._stream.write(text)
        return super().write(text)


def poisonous(case: Case, control: np.ndarray | None = None) -> Result:
    """A case of 20 ms; one kills its process."""
    if number_of(case) == POISON:
        os._exit(1)
    time.sleep(0.02)
    return simulate(case)


def expected(batch: list[Case]) -> dict[str, str]:
    """The status of each case."""
    special = {POISON: Status.WORKER_DIED, FAILING: Status.STOPPED}
    return {case.case_id: special.get(number_of(case), Status.CONVERGED) for case in batch}


def complete(batch: list[Case], out: Path, processes: Processes) -> tuple[int, int]:
    """Run cases again and again until all are there; return how often a sentence ended the run, and
    how many rows it lost.
    """
    sentences, lost, before = 0, 0, {}
    while before.keys() != expected(batch).keys():
        try:
            with open_cluster(str(processes.file), WAIT) as cluster:
                run_sweep(batch, out, scheduler=cluster, simulate=poisonous)
        except ClusterError as error:  # lost, or not there again yet
            sentences += str(error).startswith("lost the Dask scheduler")
            time.sleep(0.2)
        after = read_statuses(out)
        lost += len(before.keys() - after.keys())
        before = after
    return sentences, lost


def kill(
    processes: Processes, other: Path, kills: int, schedulers: int, runs: list[Future]
) -> tuple[int, int]:
    """Kill workers at random moments and start others, some with a scheduler, until the runs end;
    return how many of each were killed. other: source of the worker that is to be refused.
    """
    rng, workers, lost = np.random.default_rng(1), 0, 0
    while workers < kills and not all(run.done() for run in runs):
        time.sleep(rng.uniform(0.0, LONGEST))
        victim = processes.workers.pop(int(rng.integers(len(processes.workers))))
        victim.kill()
        victim.wait()
        workers += 1
        if lost < schedulers and workers > (lost + 1) * kills // (schedulers + 1):
            processes.scheduler.kill()
            processes.scheduler.wait()
            lost += 1
            processes.start_scheduler()
            processes.add(WORKERS - 1)
            processes.add(source=other, name=OTHER)
        processes.add()
    return workers, lost


def torture(folder: Path, kills: int, schedulers: int = 1, count: int = 400) -> Killed:
    """Two runs of about `count` cases each, while workers and schedulers are killed."""
    other, heard = folder / OTHER, _Heard(sys.stderr)
    for package in PACKAGES:
        shutil.copytree(ROOT / package, other / package)
    with (other / "sweep" / "result.py").open("a") as file:
        file.write("# changed\n")
    files = {folder / "one.h5": cases(count), folder / "two.h5": cases(count + 1)}
    with (
        silence_logging_cmgr("CRITICAL"),
        redirect_stderr(heard),
        Processes(folder) as processes,
        ThreadPoolExecutor(len(files)) as pool,
    ):
        processes.add(WORKERS)
        processes.add(source=other, name=OTHER)
        with Client(processes.address) as client:
            client.wait_for_workers(WORKERS + 1, WAIT)
        runs = [pool.submit(complete, batch, out, processes) for out, batch in files.items()]
        killed = kill(processes, other, kills, schedulers, runs)
        sentences, lost = map(sum, zip(*(run.result() for run in runs), strict=True))
    wrong = sum(
        read_statuses(out).get(case_id) != status
        for out, batch in files.items()
        for case_id, status in expected(batch).items()
    )
    refused = sum(map(bool, map(REFUSED.search, heard.getvalue().splitlines())))
    return Killed(*killed, sentences, lost, wrong, refused)


def sheet(found: Killed) -> Sheet:
    """The table of `torture`."""
    heads = ["killed workers", "killed schedulers", "runs that ended so", "rows lost", "rows wrong"]
    heads += ["refusals of the other source"]
    return Sheet("Two runs on a cluster", heads, [[str(count) for count in found]])
