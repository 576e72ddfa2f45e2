"""Runs cases in processes of this machine, where more threads would wait for one another."""

from contextlib import AbstractContextManager
from functools import partial

import numpy as np

from sweep.config.case import Case
from sweep.result import Result, Status, failed_result
from sweep.running.child_process import Child, Simulate

PROCESSES = "processes"  # in place of a scheduler


class Processes(AbstractContextManager["Processes"]):
    """As many processes as threads call it at the same time; they end with the block."""

    def __init__(self) -> None:
        self._free: list[Child] = []

    def __exit__(self, *_: object) -> None:
        for child in self._free:
            child.end()

    def runs(self, simulate: Simulate) -> Simulate:
        """The function `simulate`, with a process for each case while it runs."""
        return partial(self._run, simulate)

    def _run(self, simulate: Simulate, case: Case, control: np.ndarray) -> Result:
        try:
            child = self._free.pop()
        except IndexError:
            child = Child()
        try:
            result = child.run(simulate, case, lambda: bool(control[0]))
        finally:
            self._free.append(child)
        return result or failed_result(case, Status.STOPPED, "interrupted")
