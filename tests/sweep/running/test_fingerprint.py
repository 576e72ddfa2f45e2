"""Two processes with the same source and versions have the same fingerprint, others do not."""

import subprocess
import sys
from pathlib import Path

import pytest

from sweep.result import MODEL_VERSION
from sweep.running.fingerprint import (
    OtherSourceError,
    checked,
    differences,
    fingerprint,
    source_hash,
)

ROOT = Path(__file__).parents[3]
OTHER = "from sweep.running.fingerprint import fingerprint; print(fingerprint())"


def test_another_process_has_the_same():
    words = [sys.executable, "-c", OTHER]
    done = subprocess.run(words, cwd=ROOT, capture_output=True, text=True, check=True)
    assert done.stdout.strip() == str(fingerprint())
    assert fingerprint()["model version"] == str(MODEL_VERSION)
    assert "unknown" not in fingerprint().values()


def test_every_change_of_a_source_counts(tmp_path):
    for folder in ("one", "other"):
        (tmp_path / folder / "package" / "inner").mkdir(parents=True)
    one, other = tmp_path / "one" / "package", tmp_path / "other" / "package"
    for package in (one, other):
        (package / "inner" / "a.py").write_text("x = 1\n")
        (package / "notes.txt").write_text(str(package))
    same = source_hash(one)
    assert source_hash(other) == same
    (other / "inner" / "a.py").write_text("x = 2\n")
    assert source_hash(other) != same
    (one / "inner" / "a.py").rename(one / "inner" / "b.py")
    assert source_hash(one) != same


def test_differences_name_both_sides():
    ours = {"numba": "0.61.2", "numpy": "2.2.0", "source": "ab"}
    assert differences(dict(ours), ours) == ""
    theirs = {"numba": "0.60.0", "numpy": "2.2.0"}
    assert (
        differences(theirs, ours)
        == "numba 0.60.0 (this run: 0.61.2), source unknown (this run: ab)"
    )


def test_a_task_of_another_source_does_not_run():
    ran = []
    assert checked(fingerprint(), divmod, 7, 2) == (3, 1)
    with pytest.raises(OtherSourceError, match=r"numba \S+ \(this run: 0\.1\)"):
        checked({**fingerprint(), "numba": "0.1"}, ran.append, 1)
    assert ran == []
