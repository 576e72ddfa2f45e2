"""Cases in processes of this machine: each has one for itself, and none ends the run."""

import os
import subprocess
import sys
import time
from dataclasses import replace

from sweep.result import Status
from sweep.running.place import open_place
from sweep.running.processes import PROCESSES
from sweep.running.sweep import run_sweep
from sweep.store.read import read_statuses
from tests.support.results.standin import cases, number_of, simulate


def poisonous(case, control):
    """Case 3 ends its process, and with it the test if that runs it."""
    if number_of(case) == 3:
        os._exit(9)
    return simulate(case)


def test_a_case_that_ends_its_process_is_named_at_once(tmp_path):
    out = tmp_path / "armor.h5"
    assert run_sweep(cases(12), out, 2, PROCESSES, simulate=poisonous) == 2
    statuses = list(read_statuses(out).values())
    assert (statuses[3], statuses[7]) == ("worker_died", "stopped")  # case 7 fails as always
    assert statuses.count("converged") == 10
    assert [path.name for path in tmp_path.iterdir()] == ["armor.h5"]


def pid_of(case, control):
    """A row that says which process computed it, with a moment for others."""
    time.sleep(0.2)
    return replace(simulate(case), message=str(os.getpid()))


def test_processes_stay_for_the_next_sweep(tmp_path):
    """A search has many short sweeps."""
    ids = []
    with open_place(PROCESSES) as place:
        for first in (0, 20):
            one = place.runs(pid_of)
            ids.append({one(case, [0]).message for case in cases(3, first)})
    assert ids[0] == ids[1]
    assert len(ids[0]) == 1
    assert str(os.getpid()) not in ids[0]


def endless(case, control):
    """A case that heeds no stop."""
    time.sleep(60.0)


def test_a_stop_ends_a_case_with_its_process():
    started = time.monotonic()
    with open_place(PROCESSES) as place:
        result = place.runs(endless)(cases(1)[0], [1])
    assert result.status is Status.STOPPED
    assert time.monotonic() - started < 30.0


UNGUARDED = """
import multiprocessing
multiprocessing.set_start_method("spawn")  # that of macOS and Windows
from sweep.running.sweep import run_sweep
from tests.support.results.standin import cases, simulate
print(run_sweep(cases(3), "armor.h5", 2, "processes", simulate=simulate))
"""


def test_a_script_needs_no_guard_of_its_main_part(tmp_path):
    """Wherever processes begin anew: none runs the script of the user again."""
    script = tmp_path / "script.py"
    script.write_text(UNGUARDED)
    words, here = [sys.executable, str(script)], os.environ | {"PYTHONPATH": os.getcwd()}
    ran = subprocess.run(words, cwd=tmp_path, env=here, capture_output=True, text=True, timeout=120)
    assert (ran.stdout, ran.returncode) == ("0\n", 0), ran.stderr
