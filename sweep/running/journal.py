"""Which cases run at the moment, written down: a process that dies has left its suspects."""

import os
from pathlib import Path
from threading import Lock
from typing import Self

import numpy as np

from sweep.config.case import Case
from sweep.result import Result
from sweep.running.alone import Simulate

BEGUN, ENDED = "+", "-"


class Journal:
    """A file beside the results file while a run writes to it; it goes when the run ends.

    suspects: ids of the cases that were running when the last run died, if it did.
    """

    def __init__(self, out: str | os.PathLike[str]) -> None:
        out = Path(out)
        self._path, self._lock = out.with_name(f".{out.name}.running"), Lock()
        self._file = -1
        self.suspects: list[str] = []

    def __enter__(self) -> Self:
        self._file = os.open(self._path, os.O_RDWR | os.O_CREAT | os.O_APPEND, 0o644)
        self.suspects = _running(self._path.read_text("utf-8", "replace"))
        os.truncate(self._file, 0)
        return self

    def __exit__(self, *_: object) -> None:
        self._path.unlink(missing_ok=True)
        os.close(self._file)

    def watched(self, simulate: Simulate) -> Simulate:
        """The function `simulate`, whose cases are written down while they run."""

        def run(case: Case, control: np.ndarray) -> Result:
            self._write(BEGUN, case)
            try:
                return simulate(case, control)
            finally:
                self._write(ENDED, case)

        return run

    def _write(self, mark: str, case: Case) -> None:
        """A line reaches the file before the case runs, and survives the death of the process."""
        with self._lock:
            os.write(self._file, f"{mark}{case.case_id}\n".encode())


def _running(text: str) -> list[str]:
    """The ids of cases that a journal has begun but not ended."""
    begun: dict[str, None] = {}
    for line in text.splitlines():
        if line.startswith(BEGUN):
            begun[line[1:]] = None
        elif line.startswith(ENDED):
            begun.pop(line[1:], None)
    return list(begun)
