"""`slurm` with the real dask-jobqueue; a script in place of sbatch starts each job as a process."""

import os
import signal
import sys
import time
from pathlib import Path

import dask
import pytest

from sweep.running.cluster import open_cluster
from sweep.running.sweep import run_sweep
from sweep.store.read import read_statuses
from tests.support.cluster import ROOT
from tests.support.results.standin import cases, simulate

pytestmark = pytest.mark.filterwarnings("ignore")

SBATCH = """#!/bin/sh
# Start a copy of a job script as a process, whose number is that of the job.
here=$(dirname "$0")
cp "$1" "$here/job.$$"
setsid sh "$here/job.$$" >>"$here/log" 2>&1 &
echo $! >>"$here/jobs"
echo "Submitted batch job $!"
"""
SCANCEL = """#!/bin/sh
# End the processes of a job.
kill -TERM -- "-$1"
"""
SETTINGS = {
    "jobqueue.slurm.cores": 1,
    "jobqueue.slurm.processes": 1,
    "jobqueue.slurm.memory": "1GB",
    "distributed.adaptive.maximum": 2,
    "distributed.deploy.lost-worker-timeout": "100 ms",
}
LATEST = 60.0  # seconds


@pytest.fixture
def jobs(tmp_path, monkeypatch):
    """A machine with two SLURM commands; the file with the numbers of its jobs."""
    for name, text in (("sbatch", SBATCH), ("scancel", SCANCEL)):
        (tmp_path / name).write_text(text)
        (tmp_path / name).chmod(0o755)
    monkeypatch.setenv("PATH", f"{tmp_path}{os.pathsep}{os.environ['PATH']}")
    monkeypatch.setenv("PYTHONPATH", os.pathsep.join([str(ROOT), *filter(None, sys.path)]))
    with dask.config.set(SETTINGS):
        yield tmp_path / "jobs"


def brief(case, control=None):
    """A case of 20 ms."""
    time.sleep(0.02)
    return simulate(case)


def numbers(jobs):
    return [int(line) for line in jobs.read_text().split()]


def is_running(number):
    """Whether a job has processes left; processes that have ended and are not waited for do not
    count.
    """
    try:
        os.killpg(number, 0)
    except ProcessLookupError:
        return False
    stat = Path(f"/proc/{number}/stat")
    return not (stat.exists() and stat.read_text().rsplit(")", 1)[1].split()[0] == "Z")


def wait_for(condition):
    limit = time.monotonic() + LATEST
    while not condition():
        assert time.monotonic() < limit
        time.sleep(0.1)


def test_a_sweep_runs_in_jobs_which_are_replaced_and_end_with_it(jobs, tmp_path):
    batch, out = cases(150), tmp_path / "armor.h5"
    with open_cluster("slurm", LATEST) as cluster:
        cluster.client.wait_for_workers(2, timeout=LATEST)
        os.killpg(numbers(jobs)[0], signal.SIGKILL)
        assert run_sweep(batch, out, scheduler=cluster, simulate=brief) == 1  # case 7 fails
        wait_for(lambda: len(numbers(jobs)) > 2)
    assert read_statuses(out).keys() == {case.case_id for case in batch}
    wait_for(lambda: not any(map(is_running, numbers(jobs))))
