"""One writer at a time, also where the file system has no locks."""

import errno
import os
import socket
import subprocess
import sys

import pytest

from sweep.store.lock import exclusive
from sweep.store.read import StoreError, read_summary
from sweep.store.write import Writer
from tests.support.results.standin import cases, write

fcntl = pytest.importorskip("fcntl")  # Windows has none


@pytest.fixture(params=[errno.ENOLCK, errno.EOPNOTSUPP])
def without_locks(request, monkeypatch):
    def refuse(*_):
        raise OSError(request.param, os.strerror(request.param))

    monkeypatch.setattr(fcntl, "flock", refuse)


def dead_process():
    with subprocess.Popen([sys.executable, "-c", ""]) as process:
        process.wait()
    return process.pid


def test_there_is_one_holder_and_nothing_is_left(tmp_path, without_locks):
    with exclusive(tmp_path / "a.h5"):
        with pytest.raises(StoreError) as refusal, exclusive(tmp_path / "a.h5"):
            pass
        (left,) = tmp_path.iterdir()
        process = f"{os.getpid()} on {socket.gethostname()}"
        told = f"a.h5 (process {process}). If it has ended, delete {left}."
        assert str(refusal.value).endswith(told)
    assert list(tmp_path.iterdir()) == []


def test_a_run_writes_and_another_is_told_which_file_to_delete(tmp_path, without_locks):
    path = tmp_path / "armor.h5"
    with Writer(path), pytest.raises(StoreError, match=r"process \d+ on .*delete .*\.owner"):
        write(path, cases(1))
    write(path, cases(2), fold=True)
    assert len(read_summary(path)) == 2


def test_what_a_kill_has_left_is_taken_over(tmp_path, without_locks):
    left = tmp_path / ".a.h5.lock.owner"
    left.write_text(f"{dead_process()} on {socket.gethostname()}")
    with exclusive(tmp_path / "a.h5"):
        assert left.read_text().startswith(f"{os.getpid()} on ")
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize(
    "holder", [f"{2**22 + 1} on elsewhere", f"{10**30} on {socket.gethostname()}", ""]
)
def test_what_cannot_be_known_to_be_dead_is_not(tmp_path, without_locks, holder):
    left = tmp_path / ".a.h5.lock.owner"
    left.write_text(holder)
    with pytest.raises(StoreError, match="Another run"), exclusive(tmp_path / "a.h5"):
        pass
    assert left.exists()


def test_the_system_releases_the_lock_of_a_dead_holder(tmp_path):
    """The file that it has left behind is no lock; other errors are errors."""
    (tmp_path / ".a.h5.lock").write_text(str(dead_process()))
    with exclusive(tmp_path / "a.h5"):
        pass
    assert list(tmp_path.iterdir()) == []
    with pytest.raises(FileNotFoundError), exclusive(tmp_path / "no folder" / "a.h5"):
        pass
