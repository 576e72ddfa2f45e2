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
LONG = 10.0  # seconds after which the progress shows how far a case is

Sink = Callable[[list[Result]], None]


def usual_workers() -> int:
    """Threads of a run: one for each core that this process may use, as far as more of them pay."""
    from dask.system import cpu_count

    return min(cpu_count(), MOST_THREADS)


class Stop:
    """A request to stop, which also ends running simulations.

    Each running case has its own array `control`, int64 (3,): control[0] = 1 ends the case;
    control[1] counts its steps, of control[2] that are planned.
    """

    def __init__(self) -> None:
        self.flag = False
        self._running: dict[int, tuple[float, np.ndarray]] = {}  # start, s, and `control`

    def ask(self) -> None:
        """End all running cases and start no further ones."""
        self.flag = True
        for _, control in list(self._running.values()):
            control[0] = 1

    @contextmanager
    def control(self) -> Iterator[np.ndarray]:
        """The array `control` of one case, while the case runs."""
        control = np.zeros(3, dtype=np.int64)
        self._running[id(control)] = time.monotonic(), control
        control[0] = self.flag
        try:
            yield control
        finally:
            del self._running[id(control)]

    def shares(self) -> list[float]:
        """Share of its steps that each case has done which runs for more than `LONG`."""
        before = time.monotonic() - LONG
        return [
            done / steps
            for begun, (_, done, steps) in list(self._running.values())
            if steps and begun < before
        ]


def run_on_threads(
    plan: Plan,
    simulate: Simulate,
    sink: Sink,
    stop: Stop,
    tick: Callable[[], object] = lambda: None,
) -> None:
    """Run all cases of a plan on `plan.workers` threads, and pass each finished batch to `sink`,
    one at a time.

    `simulate` should release the GIL. A `stop` ends the run early; interrupted cases do not reach
    the sink. tick: is called every `MOMENT`.
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
                tick()
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
