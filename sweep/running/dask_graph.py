"""Cases on Dask: on threads of this process, or on the workers of a `distributed` scheduler.

A graph of one task per case would take Dask longer to build than the cases take to run. Here a task
is a batch of about a second of work, and only a limited number of tasks exists at a time.
"""

import time
from asyncio import wait_for
from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import ProcessPoolExecutor
from concurrent.futures.process import BrokenProcessPool
from contextlib import contextmanager
from multiprocessing import get_context
from queue import Empty, SimpleQueue
from threading import Lock
from typing import TYPE_CHECKING, Any

import numpy as np
from dask.threaded import get

from sweep.config.case import Case
from sweep.result import Result, Status, failed_result
from sweep.running.batches import Plan

if TYPE_CHECKING:
    from distributed import Client, Future

WAVE = 256  # tasks of one graph on threads
WINDOW = 8  # batches in flight per thread of a cluster
ANSWER = 10  # seconds in which a scheduler has to answer
PATIENCE = 60  # seconds until a cluster has its first worker
MOMENT = 0.2  # seconds after which a wish to stop is noticed

Simulate = Callable[[Case, np.ndarray], Result]
Sink = Callable[[list[Result]], None]


class GraphError(Exception):
    """Dask cannot run the sweep; the text is one clear line."""


class Stop:
    """A wish to stop that reaches simulations while they run.

    Each running case has an array `control`, int64 (2,), of its own: control[0] = 1 ends the case.
    """

    def __init__(self) -> None:
        self.asked = False
        self._running: dict[int, np.ndarray] = {}

    def ask(self) -> None:
        """End all running cases and start no other."""
        self.asked = True
        for control in list(self._running.values()):
            control[0] = 1

    @contextmanager
    def control(self) -> Iterator[np.ndarray]:
        """The array of one case, while it runs."""
        control = np.zeros(2, dtype=np.int64)
        self._running[id(control)] = control
        control[0] = self.asked
        try:
            yield control
        finally:
            del self._running[id(control)]


def run(
    plan: Plan, simulate: Simulate, sink: Sink, stop: Stop, scheduler: str | None = None
) -> None:
    """Run all cases of a plan, and hand each finished batch to `sink`, one at a time.

    Without the address of a `scheduler`, on `plan.workers` threads: `simulate` should release the
    GIL. Returns early when `stop` is asked for; cases that it interrupted do not reach the sink.
    """
    if scheduler is None:
        _run_on_threads(plan, simulate, sink, stop)
    else:
        _run_on_cluster(plan, simulate, sink, stop, scheduler)


def _run_on_threads(plan: Plan, simulate: Simulate, sink: Sink, stop: Stop) -> None:
    one_at_a_time = Lock()
    troubles: list[Exception] = []

    def next_batch() -> None:
        """One task. It takes its batch only now, when the pace is known best."""
        batch = [] if stop.asked else plan.take()
        if not batch:
            return
        results, seconds = run_batch(simulate, batch, stop)
        plan.learn(batch, seconds)
        try:
            with one_at_a_time:
                sink(results)
        except Exception as error:  # noqa: BLE001 raised below, once no thread is at work any more
            troubles.append(error)
            stop.ask()

    while len(plan) and not stop.asked:
        wave = dict.fromkeys(range(min(WAVE, len(plan))), (next_batch,))
        get(wave, list(wave), num_workers=plan.workers)
    if troubles:
        raise troubles[0]


def run_batch(
    simulate: Simulate, batch: Sequence[Case], stop: Stop | None = None
) -> tuple[list[Result], float]:
    """Results of a batch, without cases that were interrupted, and the seconds that it took."""
    stop = stop or Stop()
    started = time.perf_counter()
    results = []
    for case in batch:
        if stop.asked:
            break
        with stop.control() as control:
            result = _attempt(simulate, case, control)
        if not (stop.asked and result.status is Status.STOPPED):
            results.append(result)
    return results, time.perf_counter() - started


def _attempt(simulate: Simulate, case: Case, control: np.ndarray) -> Result:
    try:
        return simulate(case, control)
    except MemoryError:
        message = "needs more memory than there is; try fewer cells, nodes or steps"
        return failed_result(case, Status.STOPPED, message)
    except Exception as error:  # noqa: BLE001 a defect that one case meets must not end the sweep
        message = f"unexpected {_one_line(error)}; please report it"
        return failed_result(case, Status.STOPPED, message)


def _run_on_cluster(plan: Plan, simulate: Simulate, sink: Sink, stop: Stop, scheduler: str) -> None:
    try:
        with _connected(scheduler, stop) as client, _blame_at_once(client):
            flight = _Flight(client, plan, simulate, stop)
            for results in flight.landings():
                sink(results)
    except OSError as error:
        line = f"lost the Dask scheduler at {scheduler}; the same command runs the rest"
        raise GraphError(line) from error


def check_scheduler(scheduler: str) -> None:
    """Refuse an address at which no Dask scheduler answers soon: a `Client` of it may never end."""
    from distributed.utils import LoopRunner

    try:
        found = LoopRunner().run_sync(_identify, scheduler)
    except (ValueError, TypeError) as error:
        allowed = "a Dask scheduler such as tcp://host:8786"
        raise GraphError(f'"{scheduler}": {error}; allowed: {allowed}') from error
    except Exception as error:
        raise GraphError(f"no Dask scheduler answers at {scheduler}") from error
    if found != "Scheduler":
        raise GraphError(f"{scheduler} is a Dask {found}; needed: its scheduler")


async def _identify(address: str) -> str:
    """What answers at an address: a `Scheduler`, a `Worker`, ..."""
    from distributed import Security, rpc

    security = Security().get_connection_args("client")
    async with rpc(address, timeout=ANSWER, connection_args=security) as server:
        identity = await wait_for(server.identity(), ANSWER)
    return str(identity["type"])


@contextmanager
def _connected(scheduler: str, stop: Stop) -> "Iterator[Client]":
    from distributed import Client

    try:
        client = Client(scheduler, set_as_default=False, timeout=ANSWER)
    except ImportError as error:
        raise GraphError(f"the Dask scheduler at {scheduler}: {_one_line(error)}") from error
    with client:
        limit = time.monotonic() + PATIENCE
        while not (client.nthreads() or stop.asked):
            if time.monotonic() > limit:
                line = f"no worker joined the Dask scheduler at {scheduler} within {PATIENCE} s"
                raise GraphError(line)
            time.sleep(MOMENT)
        yield client


@contextmanager
def _blame_at_once(client: "Client") -> Iterator[None]:
    """Let the scheduler give up a task whose worker died, and not kill three more with it."""

    def allow(count: int, dask_scheduler: Any = None) -> int:
        before: int = dask_scheduler.allowed_failures
        dask_scheduler.allowed_failures = count
        return before

    before = client.run_on_scheduler(allow, 0)
    try:
        yield
    finally:
        client.run_on_scheduler(allow, before)


class _Flight:
    """Batches in flight on a cluster: enough to keep its workers busy, few enough to hold."""

    def __init__(self, client: "Client", plan: Plan, simulate: Simulate, stop: Stop) -> None:
        self.client, self.plan, self.simulate, self.stop = client, plan, simulate, stop
        self.flying: dict[Future, list[Case]] = {}
        self.landed: SimpleQueue[Future] = SimpleQueue()
        self.suspects: list[list[Case]] = []

    def landings(self) -> Iterator[list[Result]]:
        """Results of each batch as it lands, until all have or a stop is asked for."""
        self._launch()
        while self.flying and not self.stop.asked:
            try:
                future = self.landed.get(timeout=MOMENT)
            except Empty:
                continue
            yield self._results(future, self.flying.pop(future))
            self._launch()
        for future in [future for future in self.flying if future.status == "finished"]:
            yield self._results(future, self.flying.pop(future))
        self.client.cancel(list(self.flying))

    def _launch(self) -> None:
        self.plan.workers = max(sum(self.client.nthreads().values()), 1)
        while len(self.flying) < WINDOW * self.plan.workers and (batch := self._next_batch()):
            future = self.client.submit(run_batch, self.simulate, batch, pure=False)
            self.flying[future] = batch
            future.add_done_callback(self.landed.put)

    def _next_batch(self) -> list[Case]:
        """A lost batch goes after all others: it may take its neighbours down again."""
        return self.plan.take() or (self.suspects.pop() if self.suspects else [])

    def _results(self, future: "Future", batch: list[Case]) -> list[Result]:
        from distributed import KilledWorker

        try:
            results, seconds = future.result()
        except KilledWorker:
            return self._narrow(batch)
        except Exception as error:
            raise GraphError(f"the Dask workers cannot run a batch: {_one_line(error)}") from error
        self.plan.learn(batch, seconds)
        return list(results)

    def _narrow(self, batch: list[Case]) -> list[Result]:
        """Halve a batch that lost its worker, until a case is left that can prove itself alone."""
        half = len(batch) // 2
        if half == 0:
            return _run_alone(self.simulate, batch, self.stop)
        self.suspects += [batch[:half], batch[half:]]
        return []


def _run_alone(simulate: Simulate, suspect: list[Case], stop: Stop) -> list[Result]:
    """Run a case in a process of its own, so that only the case can be to blame for its end."""
    with ProcessPoolExecutor(1, mp_context=get_context("spawn")) as process:
        try:
            results, _ = process.submit(run_batch, simulate, suspect).result()
        except BrokenProcessPool:
            message = "took its worker process down, even alone; try a smaller model"
            died = failed_result(suspect[0], Status.WORKER_DIED, message)
            return [] if stop.asked else [died]
    return results


def _one_line(error: Exception) -> str:
    return " ".join(f"{type(error).__name__}: {error}".split()).removesuffix(":")
