"""The command line as a process: what its terminal, its pipes and its disk do to it."""

import os
import subprocess
import sys
from pathlib import Path

import pytest

from tests.support.specimens import summary, write

ROOT = Path(__file__).parents[3]


@pytest.fixture
def file(tmp_path):
    return write(tmp_path / "trial.h5", summary({}, {"status": "stopped"}))


def started(*arguments, **options):
    """A call in a process of its own, in a usual environment, and killed if it hangs."""
    usual = {k: v for k, v in os.environ.items() if not k.startswith("PYTHON")}
    options["env"] = usual | {"PYTHONPATH": str(ROOT)} | options.pop("env", {})
    command = [sys.executable, "-m", "sweep", *arguments]
    return subprocess.run(
        command, stderr=subprocess.PIPE, text=True, timeout=60, check=False, **options
    )


def test_scheduler_that_is_none_ends_the_command(tmp_path):
    (tmp_path / "trial.toml").write_text("")
    done = started("run", "trial.toml", "--scheduler", "nonsense", cwd=tmp_path)
    assert done.returncode == 2
    assert done.stderr.startswith('crumple run: "nonsense": missing port')
    assert done.stderr.count("\n") == 1
    assert [path.name for path in tmp_path.iterdir()] == ["trial.toml"]


def test_output_that_nobody_reads_is_no_error(file):
    read, write = os.pipe()
    os.close(read)
    with os.fdopen(write, "w") as pipe:
        done = started("status", file, stdout=pipe)
    assert (done.returncode, done.stderr) == (0, "")


def test_output_that_is_closed_is_no_error(file):
    done = started("status", file, preexec_fn=lambda: os.close(1))
    assert (done.returncode, done.stderr) == (1, "")


def test_disk_that_is_full(file):
    with Path("/dev/full").open("w") as full:
        done = started("status", file, stdout=full)
    assert done.returncode == 2
    assert done.stderr == "crumple status: [Errno 28] No space left on device\n"


def test_terminal_that_knows_only_ascii(tmp_path):
    file = write(tmp_path / "trial.h5", summary({"material": "gomme élastique"}, {}))
    ascii_only = {"PYTHONIOENCODING": "ascii"}
    done = started("show", file, stdout=subprocess.PIPE, env=ascii_only)
    assert (done.returncode, done.stderr) == (0, "")
    assert "gomme ?lastique" in done.stdout
