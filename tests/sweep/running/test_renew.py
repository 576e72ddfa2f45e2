"""Rows of an older model: kept and reported, or computed anew, and never lost on the way."""

import os
import signal
import time
from dataclasses import replace
from pathlib import Path

import h5py
import numpy as np
import pytest

from sweep.result import MODEL_VERSION, Status
from sweep.running.sweep import Interrupted, run_sweep
from sweep.store.read import Rerun, read_history, read_summary
from tests.conftest import CONFIG
from tests.support.command import crumple
from tests.support.results.standin import (
    Logged,
    cases,
    killed,
    make_older,
    simulate,
    slow,
    write,
    write_older,
)

OLDER = Rerun(older=True)
RENEW = """
from tests.support.results.standin import cases, slow
from sweep.running.sweep import run_sweep
from sweep.store.read import Rerun

if __name__ == "__main__":
    run_sweep(cases(60), {out!r}, rerun=Rerun(older=True), simulate=slow)
"""


@pytest.fixture
def out(tmp_path):
    return tmp_path / "sweep.h5"


@pytest.fixture
def logged():
    return Logged(simulate)


def numbers(logged):
    """The numbers of the cases that have run, in order."""
    known = {case.case_id: number for number, case in enumerate(cases(9))}
    return sorted(known[case_id] for case_id in logged)


def versions(out, batch):
    """The model of each case."""
    table = read_summary(out).set_index("case_id")
    return [int(table["model_version"][case.case_id]) for case in batch]


def test_rows_of_an_older_model_stay_and_are_told_of(out, logged, capsys):
    write_older(out, cases(3))
    run_sweep(cases(5), out, simulate=logged)
    told = "3 of 3 finished cases are of an older model; crumple run CONFIG --renew computes older"
    assert told in capsys.readouterr().err
    assert numbers(logged) == [3, 4]
    assert versions(out, cases(5)) == [1, 1, 1, MODEL_VERSION, MODEL_VERSION]
    run_sweep(cases(5, first=3), out, simulate=logged)
    assert "older model" not in capsys.readouterr().err  # these rows are of another sweep


def test_renewing_computes_the_older_rows_and_only_those(out, logged, capsys):
    write_older(out, cases(3))
    write(out, cases(2, first=3), fold=True)
    run_sweep(cases(6), out, rerun=OLDER, simulate=logged)
    assert numbers(logged) == [0, 1, 2, 5]
    assert versions(out, cases(6)) == [MODEL_VERSION] * 6
    assert "older model" not in capsys.readouterr().err
    run_sweep(cases(6), out, rerun=OLDER, simulate=logged)
    assert len(logged) == 4


def test_a_row_of_a_newer_model_is_not_renewed(out, logged, monkeypatch):
    write(out, cases(3), fold=True)
    monkeypatch.setattr("sweep.store.read.MODEL_VERSION", MODEL_VERSION - 1)
    run_sweep(cases(3), out, rerun=OLDER, simulate=logged)
    assert logged == []


def test_an_older_row_gives_way_to_a_failure_of_the_new_model(out):
    def fails(case, stop):
        return replace(simulate(case), status=Status.STOPPED, message="No.")

    write_older(out, cases(2))
    assert run_sweep(cases(2), out, rerun=OLDER, simulate=fails) == 2
    assert versions(out, cases(2)) == [MODEL_VERSION] * 2
    assert set(read_summary(out)["status"]) == {"stopped"}


def test_an_interruption_keeps_the_rows_that_are_not_renewed_yet(out, logged):
    def pressed(case, stop):
        if len(logged) == 3:
            os.kill(os.getpid(), signal.SIGINT)
            time.sleep(0.05)
        return logged(case, stop)

    write_older(out, cases(6))
    with pytest.raises(Interrupted, match="of 6 cases, and the same command runs the rest"):
        run_sweep(cases(6), out, workers=1, rerun=OLDER, simulate=pressed)
    found = versions(out, cases(6))
    assert 1 in found
    assert MODEL_VERSION in found
    assert [len(read_history(out, case.case_id)) for case in cases(6)] == [*range(10, 16)]
    logged.clear()
    run_sweep(cases(6), out, rerun=OLDER, simulate=logged)
    assert numbers(logged) == [k for k, version in enumerate(found) if version == 1]
    assert versions(out, cases(6)) == [MODEL_VERSION] * 6


def test_a_kill_keeps_the_rows_that_are_not_renewed_yet(out, executions):
    write_older(out, cases(60))
    killed(RENEW.format(out=str(out)), executions, 30)
    found = versions(out, cases(60))
    assert 0 < found.count(MODEL_VERSION) < 60
    assert found.count(1) + found.count(MODEL_VERSION) == 60
    begun = len(executions.read_text().split())
    run_sweep(cases(60), out, rerun=OLDER, simulate=slow)
    assert len(executions.read_text().split()) - begun == found.count(1)
    assert versions(out, cases(60)) == [MODEL_VERSION] * 60


def test_the_command_line_tells_of_older_rows_and_renews_them(capsys, config):
    crumple(capsys, "run", config)
    make_older("results/trial.h5")
    renew = "crumple run CONFIG --renew computes older ones again"
    told = f"rows of model version 1 (3); {renew}\n"
    assert told in crumple(capsys, "status", "results/trial.h5")[1]
    assert "Ranked together" not in crumple(capsys, "rank", "results/trial.h5")[1]

    Path(config).write_text(CONFIG.format(values=[0.006, 0.007, 0.008, 0.009]))
    assert "older model" in crumple(capsys, "run", config)[2]
    _, said, _ = crumple(capsys, "status", "results/trial.h5")
    assert f"rows of model version 1 (3), {MODEL_VERSION} (1); {renew}\n" in said
    mixed = f"Ranked together: rows of model version 1 (2), {MODEL_VERSION} (1); {renew}.\n"
    for form, stream in (([], 1), (["--csv"], 2), (["--out", "folder"], 2)):
        assert mixed in crumple(capsys, "rank", "results/trial.h5", *form)[stream]

    assert "1 of them finished" in crumple(capsys, "run", config, "--renew", "--dry-run")[1]
    assert "older" not in crumple(capsys, "run", config, "--renew")[2]
    assert "model version" not in crumple(capsys, "status", "results/trial.h5")[1]


def test_a_row_that_holds_another_case_runs_again(out, logged, capsys):
    write(out, cases(5), fold=True)
    with h5py.File(out, "r+") as file:
        texts = file["cases/values/json"]
        other = texts[:].tobytes().replace(b'"imperfection":0.003', b'"imperfection":0.009', 1)
        texts[:] = np.frombuffer(other, np.uint8)
    assert run_sweep(cases(5), out, simulate=logged) == 0
    assert numbers(logged) == [3]
    assert f"damaged rows in {out}: 1" in capsys.readouterr().err
    assert crumple(capsys, "verify", str(out), "--again", "0")[0] == 0
    run_sweep(cases(5), out, simulate=logged)
    assert numbers(logged) == [3]
