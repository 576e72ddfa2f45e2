"""A sweep survives whatever ends it: nothing finished is computed twice, nothing is lost."""

import os
import signal
import time
from concurrent.futures import Future
from dataclasses import replace
from threading import current_thread, main_thread
from types import SimpleNamespace

import numpy as np
import pandas as pd
import pytest

from sweep.config.grid import Config, Recipe, Written, expanded
from sweep.running.batches import Plan
from sweep.running.cluster import ClusterError, SchedulerError
from sweep.running.progress import Progress
from sweep.running.sweep import Interrupted, run_sweep
from sweep.running.writer_thread import AT_RISK, result_sink
from sweep.store.read import (
    Rerun,
    StoreError,
    read_attributes,
    read_frames,
    read_history,
    read_summary,
)
from sweep.store.write import Writer
from tests.support.results.standin import cases, killed, number_of, parts_of, simulate, slow

SWEEP = """
from tests.support.results.standin import cases, slow
from sweep.running.sweep import run_sweep

if __name__ == "__main__":
    run_sweep(cases(40), {out!r}, simulate=slow)
"""


def test_kill_in_the_middle_loses_only_batches_in_flight(tmp_path, executions):
    out, reference = tmp_path / "killed.h5", tmp_path / "reference.h5"
    killed(SWEEP.format(out=str(out)), executions, 20)
    finished = set(read_summary(out)["case_id"])
    before = executions.read_text().split()
    assert 0 < len(finished) < 40
    assert not out.exists()

    assert run_sweep(cases(40), out, simulate=slow) == 1
    after = executions.read_text().split()[len(before) :]
    assert sorted(after) == sorted({case.case_id for case in cases(40)} - finished)
    run_sweep(cases(40), reference, simulate=simulate)
    pd.testing.assert_frame_equal(read_summary(out), read_summary(reference))
    for case_id in read_summary(out)["case_id"][::9]:
        one, other = (read_history(path, case_id) for path in (out, reference))
        pd.testing.assert_frame_equal(one, other)
        one, other = (read_frames(path, case_id) for path in (out, reference))
        for name, array in one.items():
            np.testing.assert_array_equal(array, other[name])
    assert sorted(p.name for p in tmp_path.iterdir()) == ["executions", "killed.h5", "reference.h5"]


def test_interruption_in_this_process(tmp_path):
    def pressed(case, stop):
        if number_of(case) == 3:
            os.kill(os.getpid(), signal.SIGINT)
            time.sleep(0.05)
        return simulate(case)

    out, usual = tmp_path / "sweep.h5", signal.getsignal(signal.SIGINT)
    with pytest.raises(Interrupted, match="of 100 cases, and the same command runs the") as stop:
        run_sweep(cases(100), out, simulate=pressed)
    assert f"; {out} keeps {len(read_summary(out))} of" in str(stop.value)
    assert out.exists()
    assert signal.getsignal(signal.SIGINT) is usual


def test_interruption_after_the_last_case_loses_nothing_and_is_no_failure(tmp_path, monkeypatch):
    fold = Writer.fold

    def pressed(writer, last):
        os.kill(os.getpid(), signal.SIGINT)
        fold(writer, last)

    monkeypatch.setattr(Writer, "fold", pressed)
    out = tmp_path / "sweep.h5"
    assert run_sweep(cases(3), out, simulate=simulate) == 0
    assert [path.name for path in tmp_path.iterdir()] == ["sweep.h5"]
    assert len(read_summary(out)) == 3


def test_the_results_file_is_finished_however_often_it_is_interrupted(tmp_path, monkeypatch):
    """The first signal is a wish, the second ends the run: not in the midst of HDF5."""
    fold = Writer.fold

    def pressed(writer, last):
        while signal.getsignal(signal.SIGINT) is not signal.default_int_handler:
            os.kill(os.getpid(), signal.SIGINT)  # again, if it came as the main thread fell asleep
            time.sleep(0.2)  # until the wish is heard
        for _ in range(3):
            os.kill(os.getpid(), signal.SIGINT)
            time.sleep(0.05)
        fold(writer, last)

    monkeypatch.setattr(Writer, "fold", pressed)
    out = tmp_path / "sweep.h5"
    usual = signal.signal(signal.SIGINT, signal.default_int_handler)  # a shell may ignore it
    try:
        with pytest.raises(KeyboardInterrupt):
            run_sweep(cases(3), out, simulate=simulate)
    finally:
        signal.signal(signal.SIGINT, usual)
    assert [path.name for path in tmp_path.iterdir()] == ["sweep.h5"]
    assert len(read_summary(out)) == 3


def test_last_results_become_a_part_where_the_one_file_cannot_be_finished(tmp_path, monkeypatch):
    """The growing file has been deleted."""
    fold, out = Writer.fold, tmp_path / "sweep.h5"

    def robbed(writer, last):
        out.with_name("sweep.h5.tmp").unlink()
        fold(writer, last)

    monkeypatch.setattr(Writer, "fold", robbed)
    monkeypatch.setattr("sweep.running.writer_thread.AT_RISK", np.inf)
    with pytest.raises(StoreError, match="cannot be written: No such file"):
        run_sweep(cases(30), out, simulate=simulate)
    assert len(read_summary(out)) == 30
    monkeypatch.undo()
    run_sweep(cases(30), out)
    assert [path.name for path in tmp_path.iterdir()] == ["sweep.h5"]


def test_scheduler_that_cannot_be_is_refused_before_anything_is_written(tmp_path):
    with pytest.raises(SchedulerError, match="nonsense"):
        run_sweep(cases(3), tmp_path / "new" / "sweep.h5", scheduler="nonsense", simulate=slow)
    assert list(tmp_path.iterdir()) == []


def test_finished_cases_do_not_run_again(tmp_path, executions):
    out = tmp_path / "new" / "folder" / "sweep.h5"
    assert run_sweep(cases(6), out, simulate=slow) == 0
    for _ in range(2):
        assert run_sweep(cases(9), out, simulate=slow) == 1
    assert len(executions.read_text().split()) == 9
    assert run_sweep(cases(9), out, simulate=slow, rerun=Rerun(failed=True)) == 1
    assert executions.read_text().split()[9:] == [cases(9)[7].case_id]
    assert len(read_summary(out)) == 9


@pytest.fixture
def progress():
    return Progress(9, {})


def took(share, numbers):
    """Results that each took this share of the time that a worker may lose."""
    found = [simulate(case) for case in cases(len(numbers), numbers[0])]
    return [replace(r, summary=r.summary | {"cpu_s": share * AT_RISK}) for r in found]


def at_once(*_):
    """A pool of threads that runs its calls at once in this thread."""

    def submit(function, *arguments):
        done = Future()
        done.set_result(function(*arguments))
        return done

    return SimpleNamespace(submit=submit, shutdown=lambda: None)


def test_first_result_is_sealed_at_once_and_later_ones_when_they_are_worth_it(
    tmp_path, progress, monkeypatch
):
    """Two workers: the time at risk is at most twice as much. NaN might be any time."""
    monkeypatch.setattr("sweep.running.writer_thread.ThreadPoolExecutor", at_once)
    out, sealed = tmp_path / "sweep.h5", []
    batches = [(0.1, [0]), (0.9, [1, 2]), (0.3, [3]), (1.9, [4]), (np.nan, [5]), (0.1, [6])]
    with Writer(out) as writer, result_sink(writer, Plan([], workers=2), progress) as keep:
        for share, numbers in batches:
            keep(took(share, numbers))
            sealed.append(len(read_summary(out)))
            assert progress.done == sealed[-1]
        assert len(parts_of(out)) == 3
    assert sealed == [1, 1, 4, 4, 6, 6]
    assert len(read_summary(out)) == progress.done == 7
    assert [entry.name for entry in tmp_path.iterdir()] == ["sweep.h5"]


def test_error_of_the_writer_thread_ends_the_sweep_and_keeps_what_is_sealed(tmp_path, monkeypatch):
    """A disk that is full from the second part on."""
    append = Writer.append

    def full(writer, results):
        if parts_of(out):
            raise StoreError("no space left")
        append(writer, results)

    out = tmp_path / "sweep.h5"
    monkeypatch.setattr("sweep.running.writer_thread.AT_RISK", 0.0)
    monkeypatch.setattr(Writer, "append", full)
    with pytest.raises(StoreError, match="no space left"):
        run_sweep(cases(40), out, workers=2, simulate=simulate)
    assert 0 < len(read_summary(out)) < 40


def test_error_in_the_middle_of_a_sweep_loses_no_result_that_has_come_in(tmp_path, progress):
    def broken_off(out):
        with Writer(out) as writer, result_sink(writer, Plan([], workers=2), progress) as keep:
            keep(took(0.1, [0]))
            keep(took(0.1, [1, 2]))
            raise ClusterError("lost the scheduler")

    with pytest.raises(ClusterError):
        broken_off(tmp_path / "sweep.h5")
    assert len(read_summary(tmp_path / "sweep.h5")) == 3


def test_file_says_where_its_results_come_from(tmp_path):
    out = tmp_path / "sweep.h5"
    axis = (Written(0.0, "0"), Written(0.001, "0.001"))
    recipe = Recipe(grid={"lattice.imperfection": axis})
    config = Config("two", expanded(recipe)[0], recipe=recipe)
    run_sweep(config, out, simulate=simulate)
    about = read_attributes(out)
    assert '"lattice.imperfection": [0.0, 0.001]' in about["config"]
    assert about["version_h5py"][0].isdigit()
    assert about["seed"].startswith("none")
    assert len(about["git_revision"]) >= 7
    assert about["compiler"] in {"fast", "stock"}
    assert read_summary(out)["lattice.imperfection"].tolist() == [0.0, 0.001]


def crowded(case, control):
    """Case 3 finds too little memory on a thread, beside others."""
    if number_of(case) == 3 and current_thread() is not main_thread():
        raise MemoryError
    return simulate(case)


def test_a_case_without_memory_beside_others_runs_again_alone(tmp_path):
    out = tmp_path / "armor.h5"
    assert run_sweep(cases(6), out, simulate=crowded) == 0
    assert list(read_summary(out)["case_id"]) == [case.case_id for case in cases(6)]
