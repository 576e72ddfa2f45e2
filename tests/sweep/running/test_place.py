"""Where cases run if few or no options say so."""

import dask
import pytest

from sweep.config.faults import MisfitError
from sweep.running.place import chosen_place, open_place
from sweep.running.processes import PROCESSES, Processes
from sweep.running.threads import usual_workers

HERE = None


@pytest.mark.parametrize(
    ("cores", "workers", "where", "expected"),
    [
        (2, None, HERE, (2, HERE)),
        (8, None, HERE, (8, HERE)),
        (16, None, HERE, (16, PROCESSES)),
        (16, 4, HERE, (4, HERE)),
        (2, 4, PROCESSES, (4, PROCESSES)),
        (16, None, "slurm", (16, "slurm")),
    ],
)
def test_threads_as_far_as_they_pay_and_then_processes(
    monkeypatch, cores, workers, where, expected
):
    monkeypatch.setattr("dask.system.cpu_count", lambda: cores)
    assert chosen_place(workers, where) == expected
    assert usual_workers() == min(cores, 8)


def test_the_environment_names_a_scheduler_unless_something_else_is_asked(monkeypatch):
    monkeypatch.setenv("DASK_SCHEDULER_ADDRESS", "tcp://10.0.0.1:8786")
    with dask.config.set(dask.config.collect()):
        assert chosen_place(None, HERE)[1] == "tcp://10.0.0.1:8786"
        assert chosen_place(4, HERE)[1] is HERE
        assert chosen_place(None, PROCESSES)[1] == PROCESSES
    assert chosen_place(None, HERE)[1] != "tcp://10.0.0.1:8786"


def test_processes_that_are_open_stay_open():
    with open_place(PROCESSES) as place:
        assert isinstance(place, Processes)
        with open_place(place) as same:
            assert same is place
    with open_place(HERE) as place:
        assert place is HERE


@pytest.mark.parametrize("workers", [0, -3, "two", 1.5])
def test_a_run_needs_a_worker(workers):
    with pytest.raises(MisfitError, match="allowed: a whole number above 0"):
        chosen_place(workers, None)
