"""Runs cases one at a time in a child process, so that a failure is confined to its case and
becomes a row: an exception as well as the death of the process.

A child process runs `answer`; the function, cases and results pass through a pipe. It receives the
module paths of this process only once it has started: a module there may have a name of Python's
own.
"""

import os
import subprocess
import sys
import threading
import time
from collections.abc import Callable, Iterable
from contextlib import AbstractContextManager, suppress
from math import inf
from multiprocessing import Pipe
from sysconfig import get_path
from typing import Any

import numpy as np

from sweep.config.case import Case
from sweep.result import Result, Status, failed_result
from sweep.running.memory import limited_memory

if sys.platform == "win32":
    from multiprocessing.connection import PipeConnection as Connection
else:
    from multiprocessing.connection import Connection

MOMENT = 0.2  # seconds between two checks for a stop
GRACE = 1.0  # seconds after its time limit in which a case may end by itself
OWN = get_path("stdlib")  # Python's own modules come first: a file may have the name of one
PROGRAM = "import sys; sys.path[:] = {places}; from {module} import answer; answer({})"
BEGUN = "begun"  # is sent before each case
DIED = "its process died, even with no other case in it; try a smaller model"
NO_MEMORY = "needs more memory than there is; try fewer cells, nodes or steps"
KILLED = (
    "solver.time_limit of {:g} s reached, and its process had to be killed; raise it and add "
    "--retry-failed"
)

Simulate = Callable[[Case, np.ndarray], Result]


def attempt(simulate: Simulate, case: Case, control: np.ndarray) -> Result:
    """Result of a case; an exception becomes a result too."""
    try:
        return simulate(case, control)
    except MemoryError:
        return failed_result(case, Status.STOPPED, NO_MEMORY)
    except Exception as error:  # noqa: BLE001 a defect in one case must not end the sweep
        message = f"unexpected {one_line(error)}; please report it"
        return failed_result(case, Status.STOPPED, message)


def run_alone(
    simulate: Simulate, batch: Iterable[Case], is_stopped: Callable[[], bool] = lambda: False
) -> list[Result]:
    """Results of cases, one after the other, in a process of their own; fewer after a stop.

    simulate: a function at the top of a module, which is found by its name.
    """
    with Child() as child:
        results = [child.run(simulate, case, is_stopped) for case in batch]
    return [result for result in results if result]


class Child(AbstractContextManager["Child"]):
    """A process that runs cases one at a time. It starts with the first case, and again after it
    has died or had to be killed.
    """

    def __init__(self) -> None:
        self._process: subprocess.Popen[bytes] | None = None

    def __exit__(self, *_: object) -> None:
        self.end()

    def run(self, simulate: Simulate, case: Case, is_stopped: Callable[[], bool]) -> Result | None:
        """The result of a case; None after a stop.

        A case is `worker_died` if it is the first one of a process that dies. It is killed `GRACE`
        after its time limit.
        """
        limit, is_first = case.solver.time_limit, self._process is None
        if is_first:
            self._begin()
        try:
            self._channel.send((simulate, case))
            begun = self._receive(inf, is_stopped)
            result: Result | None = begun and self._receive(limit + GRACE, is_stopped)
        except TimeoutError:
            self.end()
            return failed_result(case, Status.TIMED_OUT, KILLED.format(limit))
        except (EOFError, OSError):
            self.end()
            if is_first:
                return failed_result(case, Status.WORKER_DIED, DIED)
            return self.run(simulate, case, is_stopped)
        if result is None:
            self.end()
        return result

    def end(self) -> None:
        """Kill the process, if there is one."""
        if self._process:
            self._channel.close()
            self._process.kill()
            self._process.wait()
            self._process = None

    def _begin(self) -> None:
        self._channel, there = Pipe()
        places = sorted(filter(None, sys.path), key=lambda place: not place.startswith(OWN))
        of = f"{there.fileno()}, {os.getpid()}"
        program = PROGRAM.format(of, places=places, module=__name__)
        with there:
            self._process = _started([sys.executable, "-P", "-c", program], there.fileno())

    def _receive(self, seconds: float, is_stopped: Callable[[], bool]) -> Any:
        """The next message from the process; None after a stop. Raises `TimeoutError` after some
        seconds.
        """
        due = time.monotonic() + seconds
        while not self._channel.poll(max(min(MOMENT, due - time.monotonic()), 0.0)):
            if is_stopped():
                return None
            if time.monotonic() > due:
                raise TimeoutError
        return self._channel.recv()


def _started(words: list[str], end: int) -> "subprocess.Popen[bytes]":
    """A process with one end of a pipe, in a session of its own, which Ctrl-C does not reach."""
    if sys.platform == "win32":
        os.set_handle_inheritable(end, True)
        about = subprocess.STARTUPINFO(lpAttributeList={"handle_list": [end]})
        group = subprocess.CREATE_NEW_PROCESS_GROUP
        return subprocess.Popen(words, stdout=2, startupinfo=about, creationflags=group)
    return subprocess.Popen(words, stdout=2, pass_fds=[end], start_new_session=True)


def answer(end: int, parent: int) -> None:
    """Run the cases that come through a pipe, and send their results, until it is closed."""
    threading.Thread(target=_end_with, args=(parent,), daemon=True).start()
    channel = Connection(end)
    with suppress(EOFError):
        while True:
            simulate, case = channel.recv()
            channel.send(BEGUN)
            with limited_memory():
                channel.send(attempt(simulate, case, np.zeros(3, np.int64)))


def _end_with(parent: int) -> None:
    """End this process when its parent has died."""
    while _runs(parent):
        time.sleep(MOMENT)
    os._exit(1)


def _runs(parent: int) -> bool:
    if sys.platform == "win32":  # there a launcher may have started this process
        from psutil import pid_exists

        return pid_exists(parent)
    return os.getppid() == parent


def one_line(error: Exception) -> str:
    """An exception in words."""
    return " ".join(f"{type(error).__name__}: {error}".split()).removesuffix(":")
