"""How long a case holds Python's lock: all the time that it spends outside of compiled kernels."""

import time
from collections.abc import Iterator
from contextlib import contextmanager
from typing import NamedTuple

import numpy as np

from kernels.compile.kernel import Kernel
from sweep.config.load import load_config
from sweep.report.tables.sheet import Sheet
from sweep.running.warming import real_simulate

CONFIGS = {"thousand": 40, "smoke": 6, "armor": 12}  # and how many of their cases


class Held(NamedTuple):
    """Processor time of a case in the mean, and the time in which it holds the lock, s."""

    case: float
    lock: float

    @property
    def share(self) -> float:
        """Share of its time in which a case holds the lock."""
        return self.lock / self.case


@contextmanager
def timed_kernels() -> Iterator[list[float]]:
    """The processor times (s) of the calls of kernels from Python, which release the lock."""
    call, spent = Kernel.__call__, list[float]()

    def timed(kernel: Kernel, *arguments: object) -> object:
        started = time.thread_time()
        try:
            return call(kernel, *arguments)
        finally:
            spent.append(time.thread_time() - started)

    Kernel.__call__ = timed
    try:
        yield spent
    finally:
        Kernel.__call__ = call


def held(name: str, count: int) -> Held:
    """Mean time for about `count` cases of a config."""
    cases = load_config(name).cases
    chosen = cases[:: max(len(cases) // count, 1)]
    simulate = real_simulate(chosen)
    simulate(chosen[0], np.zeros(3, np.int64))  # loads the modules that the first call loads
    with timed_kernels() as spent:
        started = time.thread_time()
        for case in chosen:
            simulate(case, np.zeros(3, np.int64))
        total = time.thread_time() - started
    return Held(total / len(chosen), (total - sum(spent)) / len(chosen))


def sheet(counts: dict[str, Held]) -> Sheet:
    """The table of `held`: beyond 1 / share threads wait for one another."""
    heads = ["config", "a case, ms", "holds the lock, ms", "share, %", "threads that it keeps busy"]
    rows = [
        [name, f"{1e3 * each.case:.3g}", f"{1e3 * each.lock:.2g}", f"{1e2 * each.share:.2g}",
         f"{1.0 / each.share:.2g}"]
        for name, each in counts.items()
    ]  # fmt: skip
    return Sheet("Python's lock", heads, rows)
