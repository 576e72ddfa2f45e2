"""A case whose failure is its own: an exception is a row, and so is the death of its process.

The process of suspect cases runs this module; function and cases reach it by its standard input.
"""

import os
import pickle
import subprocess
import sys
import threading
import time
from collections.abc import Callable, Sequence

import numpy as np

from sweep.config.case import Case
from sweep.result import Result, Status, failed_result

MOMENT = 0.2  # seconds between two checks for a stop
DIED = "its process died, even with no other case in it; try a smaller model"

Simulate = Callable[[Case, np.ndarray], Result]


def attempt(simulate: Simulate, case: Case, control: np.ndarray) -> Result:
    """Result of a case; an exception is one too."""
    try:
        return simulate(case, control)
    except MemoryError:
        message = "needs more memory than there is; try fewer cells, nodes or steps"
        return failed_result(case, Status.STOPPED, message)
    except Exception as error:  # noqa: BLE001 a defect in one case must not end the sweep
        message = f"unexpected {one_line(error)}; please report it"
        return failed_result(case, Status.STOPPED, message)


def run_alone(
    simulate: Simulate, batch: Sequence[Case], is_stopped: Callable[[], bool] = lambda: False
) -> list[Result]:
    """Results of cases in a process of their own; if it dies, of each half of them in another one.

    A case whose process dies with no other case in it has the status `worker_died`. After a stop
    there are no further results. simulate: a function of a module, by its name.
    """
    results = _run_in_child(simulate, batch, is_stopped)
    if results is not None:
        return results
    if len(batch) == 1:
        return [failed_result(batch[0], Status.WORKER_DIED, DIED)]
    half = len(batch) // 2
    first = run_alone(simulate, batch[:half], is_stopped)
    return first + run_alone(simulate, batch[half:], is_stopped)


def _run_in_child(
    simulate: Simulate, batch: Sequence[Case], is_stopped: Callable[[], bool]
) -> list[Result] | None:
    """Results of cases in a process; None if it dies."""
    words, pipe = [sys.executable, "-P", "-m", __name__], subprocess.PIPE
    places = os.environ | {"PYTHONPATH": os.pathsep.join(filter(None, sys.path))}
    task: bytes | None = pickle.dumps((simulate, batch))
    with subprocess.Popen(  # of a session of its own, which no Ctrl-C reaches
        words, stdin=pipe, stdout=pipe, env=places, start_new_session=True
    ) as process:
        while not is_stopped():
            try:
                output, _ = process.communicate(task, timeout=MOMENT)
            except subprocess.TimeoutExpired:
                task = None
                continue
            return pickle.loads(output) if process.returncode == 0 else None
        process.kill()
    return []


def answer() -> None:
    """Run the cases on standard input; write results to standard output, and nothing else."""
    threading.Thread(target=_end_with, args=(os.getppid(),), daemon=True).start()
    simulate, batch = pickle.load(sys.stdin.buffer)
    channel, sys.stdout = sys.stdout.buffer, sys.stderr
    results = [attempt(simulate, case, np.zeros(2, np.int64)) for case in batch]
    channel.write(pickle.dumps(results))
    channel.flush()


def _end_with(parent: int) -> None:
    """End this process when the one that asks has died."""
    while os.getppid() == parent:
        time.sleep(MOMENT)
    os._exit(1)


def one_line(error: Exception) -> str:
    """An exception in words."""
    return " ".join(f"{type(error).__name__}: {error}".split()).removesuffix(":")


if __name__ == "__main__":
    answer()
