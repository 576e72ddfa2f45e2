"""A case in a process of its own."""

import os
import sys
import threading
import time
from resource import RLIM_INFINITY, RLIMIT_DATA, getrlimit

import numpy as np
import pytest

from sweep.result import Status
from sweep.running.child_process import run_alone
from tests.support.results.standin import cases, number_of, simulate


def poisonous(case, control):
    """Case 1 takes its process with it, case 2 takes long, case 3 has a defect."""
    assert os.getpgid(0) == os.getpid()  # an interruption of the terminal does not reach it
    if number_of(case) == 3:
        raise ZeroDivisionError("of something")
    if number_of(case) == 1:
        os._exit(1)
    if number_of(case) == 2:
        time.sleep(60.0)
    sys.stdout.write("noise")
    return simulate(case)


def test_the_result_is_that_of_the_function_whatever_it_prints():
    (case,) = cases(1)
    (result,) = run_alone(poisonous, [case])
    assert result.case == case
    assert repr(result.summary) == repr(simulate(case).summary)


def test_of_several_only_the_one_that_kills_is_such_a_row():
    batch = [case for case in cases(5) if number_of(case) != 2]
    results = run_alone(poisonous, batch)
    assert [result.case_id for result in results] == [case.case_id for case in batch]
    rows = {number_of(result.case): result for result in results}
    assert [n for n, row in rows.items() if row.status is Status.WORKER_DIED] == [1]
    assert "even with no other case" in rows[1].message
    assert "unexpected ZeroDivisionError: of something" in rows[3].message
    assert rows[0].status is rows[4].status is Status.CONVERGED


def test_a_case_that_does_not_end_by_itself_is_killed_in_time(monkeypatch):
    """Neither the cases before it nor the cases after it are lost."""
    monkeypatch.setattr("sweep.running.child_process.GRACE", 0.2)
    batch = [case.changed(solver={"time_limit": 0.5}) for case in cases(4)]
    started = time.monotonic()
    first, late, defect = run_alone(poisonous, [batch[0], *batch[2:]])
    assert time.monotonic() - started < 30.0
    assert (first.status, defect.status) == (Status.CONVERGED, Status.STOPPED)
    assert (late.case, late.status) == (batch[2], Status.TIMED_OUT)
    assert late.message.startswith("solver.time_limit of 0.5 s reached")


def test_its_memory_is_limited_to_what_is_free():
    (result,) = run_alone(large, cases(1))
    assert result.status is Status.STOPPED
    assert result.message.startswith("needs more memory than there is")


def large(case, control):
    """A case that takes half of its limit twice."""
    limit = getrlimit(RLIMIT_DATA)[0]
    assert limit != RLIM_INFINITY
    return simulate(case), [np.empty(limit // 2, np.uint8) for _ in range(2)]


def test_a_stop_ends_it():
    stopped = threading.Event()
    threading.Timer(0.5, stopped.set).start()
    started = time.monotonic()
    assert run_alone(poisonous, cases(3)[2:], stopped.is_set) == []
    assert time.monotonic() - started < 30.0


@pytest.mark.parametrize("name", ["types", "selectors"])  # is loaded at the start, or later
def test_files_of_the_folder_are_no_modules_of_python(tmp_path, monkeypatch, name):
    """A user's types.py would end the process, and the case would be blamed."""
    (tmp_path / f"{name}.py").write_text("raise SystemExit(3)")
    monkeypatch.setattr(sys, "path", [str(tmp_path), os.getcwd(), *filter(None, sys.path)])
    monkeypatch.chdir(tmp_path)
    (result,) = run_alone(poisonous, cases(1))
    assert result.status is Status.CONVERGED
