"""A case whose failure is its own: an exception is a row, and so is the death of its process.

The process of suspect cases runs this module; function, cases and results pass through a socket.
"""

import os
import subprocess
import sys
import threading
import time
from collections.abc import Callable, Iterator, Sequence
from math import inf
from multiprocessing import Pipe
from multiprocessing.connection import Connection
from typing import Any

import numpy as np

from sweep.config.case import Case
from sweep.result import Result, Status, failed_result
from sweep.running.memory import limited_memory

MOMENT = 0.2  # seconds between two checks for a stop
GRACE = 1.0  # seconds after its time limit in which a case may end by itself
BEGUN = "begun"  # is sent before each case
DIED = "its process died, even with no other case in it; try a smaller model"
NO_MEMORY = "needs more memory than there is; try fewer cells, nodes or steps"
KILLED = "solver.time_limit of {:g} s reached, and its process had to be killed; raise it"

Simulate = Callable[[Case, np.ndarray], Result]


class _StoppedError(Exception):
    """The run ends."""


def attempt(simulate: Simulate, case: Case, control: np.ndarray) -> Result:
    """Result of a case; an exception is one too."""
    try:
        return simulate(case, control)
    except MemoryError:
        return failed_result(case, Status.STOPPED, NO_MEMORY)
    except Exception as error:  # noqa: BLE001 a defect in one case must not end the sweep
        message = f"unexpected {one_line(error)}; please report it"
        return failed_result(case, Status.STOPPED, message)


def run_alone(
    simulate: Simulate, batch: Sequence[Case], is_stopped: Callable[[], bool] = lambda: False
) -> list[Result]:
    """Results of cases in a process of their own; the case with which it ends begins another one.

    A case whose process dies with no other case before it has the status `worker_died`. The process
    is killed `GRACE` after the time limit of a case. After a stop there are no further results.
    simulate: a function of a module, by its name.
    """
    results: list[Result] = []
    while len(results) < len(batch) and not is_stopped():
        results += _run_in_child(simulate, batch[len(results) :], is_stopped)
    return results


def _run_in_child(
    simulate: Simulate, batch: Sequence[Case], is_stopped: Callable[[], bool]
) -> Iterator[Result]:
    """Results of cases in one process until it ends, at least one unless there is a stop."""
    here, there = Pipe()
    words = [sys.executable, "-P", "-m", __name__, str(there.fileno())]
    places = os.environ | {"PYTHONPATH": os.pathsep.join(filter(None, sys.path))}
    with subprocess.Popen(  # of a session of its own, which no Ctrl-C reaches
        words, stdout=2, env=places, pass_fds=[there.fileno()], start_new_session=True
    ) as process:
        there.close()
        case, before = batch[0], 0
        try:
            here.send((simulate, batch))
            for before, case in enumerate(batch):
                _receive(here, inf, is_stopped)
                yield _receive(here, case.solver.time_limit + GRACE, is_stopped)
        except _StoppedError:
            pass
        except TimeoutError:
            yield failed_result(case, Status.TIMED_OUT, KILLED.format(case.solver.time_limit))
        except (EOFError, OSError):
            if not before:
                yield failed_result(case, Status.WORKER_DIED, DIED)
        finally:
            here.close()
            process.kill()


def _receive(channel: Connection, seconds: float, is_stopped: Callable[[], bool]) -> Any:
    """What comes within some time."""
    due = time.monotonic() + seconds
    while not channel.poll(max(min(MOMENT, due - time.monotonic()), 0.0)):
        if is_stopped():
            raise _StoppedError
        if time.monotonic() > due:
            raise TimeoutError
    return channel.recv()


def answer(channel: Connection) -> None:
    """Receive cases, run them, send their results."""
    threading.Thread(target=_end_with, args=(os.getppid(),), daemon=True).start()
    simulate, batch = channel.recv()
    with limited_memory():
        for case in batch:
            channel.send(BEGUN)
            channel.send(attempt(simulate, case, np.zeros(2, np.int64)))


def _end_with(parent: int) -> None:
    """End this process when the one that asks has died."""
    while os.getppid() == parent:
        time.sleep(MOMENT)
    os._exit(1)


def one_line(error: Exception) -> str:
    """An exception in words."""
    return " ".join(f"{type(error).__name__}: {error}".split()).removesuffix(":")


if __name__ == "__main__":
    answer(Connection(int(sys.argv[1])))
