"""A journal of the cases that run at the moment, which names the suspects if the process dies."""

import os
from contextlib import suppress
from pathlib import Path
from threading import Lock
from typing import Self

import numpy as np

from sweep.config.case import Case
from sweep.result import Result
from sweep.running.child_process import Simulate
from sweep.store.damage import ID
from sweep.store.lock import HOW

BEGUN, ENDED = "+", "-"
LARGEST = 1 << 28  # most bytes that are read


class Journal:
    """A file beside the results file while a run writes to it, deleted when the run ends, unless
    suspects still wait.

    suspects: ids of the cases that were running when the last run died, if it did. If a journal
    cannot be written, as the disk is full, suspects remain unknown, but no result is lost.
    """

    def __init__(self, out: str | os.PathLike[str]) -> None:
        out = Path(out)
        self._path, self._lock = out.with_name(f".{out.name}.running"), Lock()
        self._file = -1
        self.suspects: list[str] = []

    def __enter__(self) -> Self:
        self._file = os.open(self._path, HOW | os.O_APPEND, 0o644)
        self.suspects = _running(self._text())
        os.ftruncate(self._file, 0)
        for case_id in self.suspects:
            self._write(BEGUN, case_id)
        return self

    def __exit__(self, *_: object) -> None:
        suspects = _running(self._text())
        os.close(self._file)
        if not suspects:
            self._path.unlink(missing_ok=True)

    def end(self, case_id: str) -> None:
        """Record that a suspect has ended, or is none."""
        self._write(ENDED, case_id)

    def watched(self, simulate: Simulate) -> Simulate:
        """The function `simulate`, with an entry in the journal while a case runs."""

        def run(case: Case, control: np.ndarray) -> Result:
            self._write(BEGUN, case.case_id)
            try:
                return simulate(case, control)
            finally:
                self._write(ENDED, case.case_id)

        return run

    def _write(self, mark: str, case_id: str) -> None:
        """Write a line to the file at once, so that it survives the death of the process."""
        with self._lock, suppress(OSError):
            os.write(self._file, f"{mark}{case_id}\n".encode())

    def _text(self) -> str:
        os.lseek(self._file, 0, os.SEEK_SET)
        return os.read(self._file, LARGEST).decode("ascii", "replace")


def _running(text: str) -> list[str]:
    """The ids of cases that a journal has begun but not ended."""
    running: dict[str, None] = {}
    for line in text.splitlines():
        if line.startswith(BEGUN):
            running[line[1:]] = None
        elif line.startswith(ENDED):
            running.pop(line[1:], None)
    return [case_id for case_id in running if ID.fullmatch(case_id)]
