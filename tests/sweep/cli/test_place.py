"""--processes, --scheduler and --wait: where a command runs, and its messages on impossible
places.
"""

from contextlib import contextmanager

import dask
import pytest

from sweep.running.cluster import ClusterError
from tests.support.command import crumple

CRUSH = "[lattice]\ncells = 2\n[loading]\nstrain = 0.1\n[solver]\nload_steps = 4\n"


@pytest.fixture
def opened(monkeypatch, tmp_path):
    """A folder with a config, and the schedulers that a command opens there."""
    calls = []

    @contextmanager
    def open_place(where, wait):
        calls.append((where, wait))
        yield

    monkeypatch.setattr("sweep.cli.place.open_place", open_place)
    monkeypatch.chdir(tmp_path)
    (tmp_path / "trial.toml").write_text(CRUSH)
    return calls


@pytest.mark.parametrize(
    ("words", "expected"),
    [
        (["--wait", "2 h"], "--wait is of a cluster; needed: --scheduler or DASK_SCHEDULER_ADDR"),
        (["--scheduler", "slurm", "--wait", "2"], '--wait: "2": a bare number; allowed: a time'),
        (["--scheduler", "slurm", "--wait", "2 kg"], "is a unit of another kind; allowed: a time"),
        (["--scheduler", "slurm", "--wait=-2 s"], "'-2 s'; allowed: a time of 0 s or more"),
        (["--scheduler", ""], "--scheduler: an empty path"),
    ],
)
def test_wrong_arguments_exit_with_2(capsys, opened, words, expected):
    status, _, err = crumple(capsys, "run", "trial.toml", *words)
    assert status == 2
    assert expected in err
    assert opened == []


def test_a_cluster_that_fails_is_a_sentence_and_exits_with_1(capsys, opened, monkeypatch):
    def fail(*_):
        raise ClusterError("lost the Dask scheduler; what is finished is kept")

    monkeypatch.setattr("sweep.cli.run.run_sweep", fail)
    said = crumple(capsys, "run", "trial.toml", "--scheduler", "tcp://host:1")
    assert said == (1, "", "crumple run: lost the Dask scheduler; what is finished is kept\n")


@pytest.mark.parametrize(
    ("words", "expected"),
    [
        ([], [(None, 60.0)]),
        (["--processes", "2"], [("processes", 60.0)]),
        (["--scheduler", "tcp://host:8786"], [("tcp://host:8786", 60.0)]),
        (["--scheduler", "slurm", "--wait", "2 h"], [("slurm", 7200.0)]),
        (["--scheduler", "s.json", "--wait", "0 s"], [("s.json", 0.0)]),
        (["--scheduler", "slurm", "--dry-run"], []),
    ],
)
def test_a_command_opens_one_place_and_an_estimate_none(capsys, opened, words, expected):
    assert crumple(capsys, "run", "trial.toml", *words)[0] == 0
    assert opened == expected


def test_a_wait_is_also_of_the_scheduler_of_the_environment(capsys, opened):
    with dask.config.set({"scheduler-address": "tcp://host:1"}):
        crumple(capsys, "run", "trial.toml", "--wait", "1 min")
    assert opened == [("tcp://host:1", 60.0)]
