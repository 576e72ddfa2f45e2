"""Runs cases on threads of this process; a worker of a cluster runs its batches in the same way."""

import time
from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import FIRST_COMPLETED, ThreadPoolExecutor, wait
from contextlib import contextmanager
from threading import Lock

import numpy as np

from sweep.config.case import Case
from sweep.result import Result, Status
from sweep.running.batches import Plan
from sweep.running.child_process import MOMENT, Simulate, attempt

MOST_THREADS = 8  # a short case holds Python's lock for 2 ms

Sink = Callable[[list[Result]], None]


def usual_workers() -> int:
    """Threads of a run: one for each core that this process may use, as far as more of them pay."""
    from dask.system import cpu_count

    return min(cpu_count(), MOST_THREADS)


class Stop:
    """A request to stop, which also ends running simulations.

    Each running case has its own array `control`, int64 (2,): control[0] = 1 ends the case.
    """

    def __init__(self) -> None:
        self.flag = False
        self._running: dict[int, np.ndarray] = {}

    def ask(self) -> None:
        """End all running cases and start no further ones."""
        self.flag = True
        for control in list(self._running.values()):
            control[0] = 1

    @contextmanager
    def control(self) -> Iterator[np.ndarray]:
        """The array `control` of one case, while the case runs."""
        control = np.zeros(2, dtype=np.int64)
        self._running[id(control)] = control
        control[0] = self.flag
        try:
            yield control
        finally:
            del self._running[id(control)]


def run_on_threads(plan: Plan, simulate: Simulate, sink: Sink, stop: Stop) -> None:
    """Run all cases of a plan on `plan.workers` threads, and pass each finished batch to `sink`,
    one at a time.

    `simulate` should release the GIL. A `stop` ends the run early; interrupted cases do not reach
    the sink.
    """
    one_at_a_time = Lock()

    def work() -> None:
        """Batches, each taken after the last has ended, so that it uses the newest estimate of the
        pace.
        """
        while not stop.flag and (batch := plan.take()):
            results, seconds = run_batch(simulate, batch, stop)
            plan.learn(batch, seconds)
            with one_at_a_time:
                sink(results)

    with ThreadPoolExecutor(plan.workers) as pool:
        try:
            running = {pool.submit(work) for _ in range(plan.workers)}
            while running:  # Windows delivers no Ctrl-C while the main thread waits without a limit
                ended, running = wait(running, MOMENT, FIRST_COMPLETED)
                for thread in ended:
                    thread.result()
        except BaseException:  # of the sink, or a second Ctrl-C: the other threads end too
            stop.ask()
            raise


def run_batch(
    simulate: Simulate, batch: Sequence[Case], stop: Stop | None = None
) -> tuple[list[Result], float]:
    """Results of a batch, without interrupted cases, and the duration of the batch in s."""
    stop = stop or Stop()
    started = time.perf_counter()
    results = []
    for case in batch:
        if stop.flag:
            break
        with stop.control() as control:
            result = attempt(simulate, case, control)
        if not (stop.flag and result.status is Status.STOPPED):
            results.append(result)
    return results, time.perf_counter() - started
