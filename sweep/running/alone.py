"""A case in a process of its own: what kills the process is the case.

The process runs this module; function and case reach it by its standard input.
"""

import os
import pickle
import subprocess
import sys
from collections.abc import Callable

import numpy as np

from sweep.config.case import Case
from sweep.result import Result, Status, failed_result

MOMENT = 0.2  # seconds between two checks for a stop
DIED = "its process died, even with no other case in it; try a smaller model"


def run_alone(
    simulate: Callable[[Case, np.ndarray], Result], case: Case, is_stopped: Callable[[], bool]
) -> Result | None:
    """Result of a case, with the status `worker_died` if its process dies; None after a stop.

    simulate: a function of a module, by its name.
    """
    words, pipe = [sys.executable, "-m", __name__], subprocess.PIPE
    places = os.environ | {"PYTHONPATH": os.pathsep.join(filter(None, ["", *sys.path]))}
    task: bytes | None = pickle.dumps((simulate, case))
    with subprocess.Popen(words, stdin=pipe, stdout=pipe, env=places) as process:
        while not is_stopped():
            try:
                answer, _ = process.communicate(task, timeout=MOMENT)
            except subprocess.TimeoutExpired:
                task = None
                continue
            if process.returncode == 0:
                result: Result = pickle.loads(answer)
                return result
            return failed_result(case, Status.WORKER_DIED, DIED)
        process.kill()
    return None


def answer() -> None:
    """Run the case on standard input; write its result to standard output, and nothing else."""
    simulate, case = pickle.load(sys.stdin.buffer)
    channel, sys.stdout = sys.stdout.buffer, sys.stderr
    channel.write(pickle.dumps(simulate(case, np.zeros(2, np.int64))))
    channel.flush()


if __name__ == "__main__":
    answer()
