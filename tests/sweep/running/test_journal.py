"""Cases that kill the process of a run: found, named and left behind."""

import os
import subprocess
import sys
import time

import numpy as np
import pytest

from sweep.running.journal import Journal
from sweep.running.sweep import run_sweep
from sweep.store.read import read_statuses
from tests.support.results.standin import cases, number_of, simulate

PROGRAM = """
import sys
from sweep.running.sweep import run_sweep
from tests.support.results.standin import cases
from tests.sweep.running.test_journal import poisonous
run_sweep(cases(12), sys.argv[1], simulate=poisonous)
"""


def poisonous(case, control):
    """Case 5 takes its process with it, while others run."""
    if number_of(case) == 5:
        time.sleep(0.1)
        os._exit(9)
    time.sleep(0.02)
    return simulate(case)


def test_the_run_after_a_death_names_the_case_and_keeps_the_others(tmp_path, capsys):
    out = tmp_path / "armor.h5"
    words = [sys.executable, "-c", PROGRAM, str(out)]
    assert subprocess.run(words, capture_output=True, timeout=120).returncode == 9
    assert (tmp_path / ".armor.h5.running").exists()
    assert run_sweep(cases(12), out, simulate=poisonous) == 2  # case 7 fails as always
    assert "ran when the last run died" in capsys.readouterr().err
    statuses = read_statuses(out)
    bad = {case.case_id for case in cases(12) if number_of(case) in (5, 7)}
    assert statuses.pop(cases(12)[5].case_id) == "worker_died"
    assert {case_id for case_id, status in statuses.items() if status != "converged"} < bad
    assert len(statuses) == 11
    assert [path.name for path in tmp_path.iterdir()] == ["armor.h5"]


def test_running_cases_are_written_down_and_ended_ones_are_not(tmp_path):
    one, other = cases(2)
    with Journal(tmp_path / "armor.h5") as journal:
        assert journal.suspects == []

        def look(case, control):
            assert Journal(tmp_path / "armor.h5").__enter__().suspects == [case.case_id]
            return simulate(case)

        for case in (one, other):
            journal.watched(look)(case, np.zeros(3, np.int64))
    assert list(tmp_path.iterdir()) == []


def test_a_case_that_raises_has_ended(tmp_path):
    def broken(case, control):
        raise MemoryError

    with Journal(tmp_path / "armor.h5") as journal:
        with pytest.raises(MemoryError):
            journal.watched(broken)(cases(1)[0], np.zeros(3, np.int64))
        os.rename(tmp_path / ".armor.h5.running", tmp_path / ".b.h5.running")
    with Journal(tmp_path / "b.h5") as left:
        assert left.suspects == []


def test_a_journal_of_something_else_has_no_suspects(tmp_path):
    (tmp_path / ".armor.h5.running").write_bytes(b"\xff\x00 nonsense\n+\n")
    with Journal(tmp_path / "armor.h5") as journal:
        assert journal.suspects == []


def test_suspects_stay_suspects_until_they_have_ended(tmp_path):
    left = tmp_path / ".armor.h5.running"
    left.write_text("+aa\n+bb\n-aa\n+cc\n")
    with Journal(tmp_path / "armor.h5") as journal:
        assert journal.suspects == ["bb", "cc"]
        journal.end("bb")
    with Journal(tmp_path / "armor.h5") as journal:
        assert journal.suspects == ["cc"]
        journal.end("cc")
    assert not left.exists()


def test_a_full_disk_costs_no_result(tmp_path, monkeypatch):
    def full(*_):
        raise OSError(28, "No space left on device")

    with Journal(tmp_path / "armor.h5") as journal:
        monkeypatch.setattr(os, "write", full)
        result = journal.watched(simulate)(cases(1)[0], np.zeros(3, np.int64))
    assert result.status == "converged"


def test_a_link_is_not_followed(tmp_path):
    (tmp_path / "letter.txt").write_text("dear")
    (tmp_path / ".armor.h5.running").symlink_to(tmp_path / "letter.txt")
    with pytest.raises(OSError, match="symbolic"), Journal(tmp_path / "armor.h5"):
        pass
    assert (tmp_path / "letter.txt").read_text() == "dear"
