"""Cases on threads of this process, or on the workers of a Dask cluster.

With one task per case, Dask would need more time to build the graph than the cases need to run.
Therefore a task is a batch of about one second of work, and the number of tasks in flight is
limited.
"""

import time
from asyncio import wait_for
from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import ThreadPoolExecutor, as_completed
from contextlib import contextmanager
from queue import Empty, SimpleQueue
from threading import Lock
from typing import TYPE_CHECKING, Any

import numpy as np

from sweep.config.case import Case
from sweep.result import Result, Status
from sweep.running.alone import Simulate, attempt, one_line, run_alone
from sweep.running.batches import Plan

if TYPE_CHECKING:
    from distributed import Client, Future

MOST_THREADS = 8  # Python's lock is held 2 ms of a short case
WINDOW = 8  # batches in flight per thread of a cluster
ANSWER = 10  # seconds in which a scheduler must answer
PATIENCE = 60  # seconds in which the first worker of a cluster must join
MOMENT = 0.2  # seconds between two checks for a stop

Sink = Callable[[list[Result]], None]


def usual_workers() -> int:
    """Threads of a run: one for each core that this process may use, as far as more pay."""
    from dask.system import cpu_count

    return min(cpu_count(), MOST_THREADS)


class GraphError(Exception):
    """Dask cannot run the sweep; the text is one line."""


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


def run_plan(
    plan: Plan, simulate: Simulate, sink: Sink, stop: Stop, scheduler: str | None = None
) -> None:
    """Run all cases of a plan, and pass each finished batch to `sink`, one at a time.

    Without the address of a `scheduler`, they run on `plan.workers` threads; then `simulate`
    should release the GIL. A `stop` ends the run early; interrupted cases do not reach the sink.
    """
    if scheduler is None:
        _run_on_threads(plan, simulate, sink, stop)
    else:
        _run_on_cluster(plan, simulate, sink, stop, scheduler)


def _run_on_threads(plan: Plan, simulate: Simulate, sink: Sink, stop: Stop) -> None:
    one_at_a_time = Lock()

    def work() -> None:
        """Batches, each taken when the last has ended: with the newest estimate of the pace."""
        while not stop.flag and (batch := plan.take()):
            results, seconds = run_batch(simulate, batch, stop)
            plan.learn(batch, seconds)
            with one_at_a_time:
                sink(results)

    with ThreadPoolExecutor(plan.workers) as pool:
        try:
            for ended in as_completed([pool.submit(work) for _ in range(plan.workers)]):
                ended.result()
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


def _run_on_cluster(plan: Plan, simulate: Simulate, sink: Sink, stop: Stop, scheduler: str) -> None:
    try:
        with _connected(scheduler, stop) as client, _no_retries(client):
            batches = _BatchesOnCluster(client, plan, simulate, stop)
            for results in batches.results():
                sink(results)
    except OSError as error:
        line = f"lost the Dask scheduler at {scheduler}; the same command runs the rest"
        raise GraphError(line) from error


def check_scheduler(scheduler: str) -> None:
    """Refuse an address at which no Dask scheduler answers: a `Client` could wait forever."""
    from distributed.utils import LoopRunner

    try:
        kind = LoopRunner().run_sync(_identify, scheduler)
    except (ValueError, TypeError) as error:
        allowed = "a Dask scheduler such as tcp://host:8786"
        raise GraphError(f'"{scheduler}" is no address; allowed: {allowed}') from error
    except Exception as error:
        raise GraphError(f"no Dask scheduler answers at {scheduler}") from error
    if kind != "Scheduler":
        raise GraphError(f"{scheduler} is a Dask {kind}; needed: its scheduler")


async def _identify(address: str) -> str:
    """Type of the server at an address: "Scheduler", "Worker", ..."""
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
        raise GraphError(f"the Dask scheduler at {scheduler}: {one_line(error)}") from error
    with client:
        limit = time.monotonic() + PATIENCE
        while not (client.nthreads() or stop.flag):
            if time.monotonic() > limit:
                line = f"no worker joined the Dask scheduler at {scheduler} within {PATIENCE} s"
                raise GraphError(line)
            time.sleep(MOMENT)
        yield client


@contextmanager
def _no_retries(client: "Client") -> Iterator[None]:
    """Let the scheduler give up a task when its worker dies; a retry could kill more workers."""

    def allow(count: int, dask_scheduler: Any = None) -> int:
        before: int = dask_scheduler.allowed_failures
        dask_scheduler.allowed_failures = count
        return before

    before = client.run_on_scheduler(allow, 0)
    try:
        yield
    finally:
        client.run_on_scheduler(allow, before)


class _BatchesOnCluster:
    """Batches on a cluster: enough to keep its workers busy, few enough to hold in memory."""

    def __init__(self, client: "Client", plan: Plan, simulate: Simulate, stop: Stop) -> None:
        self.client, self.plan, self.simulate, self.stop = client, plan, simulate, stop
        self.running: dict[Future, list[Case]] = {}
        self.finished: SimpleQueue[Future] = SimpleQueue()
        self.suspects: list[list[Case]] = []

    def results(self) -> Iterator[list[Result]]:
        """Results of each batch when it finishes, until all have finished or a stop."""
        self._submit()
        while self.running and not self.stop.flag:
            try:
                future = self.finished.get(timeout=MOMENT)
            except Empty:
                continue
            yield self._results(future, self.running.pop(future))
            self._submit()
        for future in [future for future in self.running if future.status == "finished"]:
            yield self._results(future, self.running.pop(future))
        self.client.cancel(list(self.running))

    def _submit(self) -> None:
        self.plan.workers = max(sum(self.client.nthreads().values()), 1)
        while len(self.running) < WINDOW * self.plan.workers and (batch := self._next_batch()):
            future = self.client.submit(run_batch, self.simulate, batch, pure=False)
            self.running[future] = batch
            future.add_done_callback(self.finished.put)

    def _next_batch(self) -> list[Case]:
        """The next batch; one that lost its worker comes last, since it may kill another one."""
        return self.plan.take() or (self.suspects.pop() if self.suspects else [])

    def _results(self, future: "Future", batch: list[Case]) -> list[Result]:
        from distributed import KilledWorker

        try:
            results, seconds = future.result()
        except KilledWorker:
            return self._halve(batch)
        except Exception as error:
            raise GraphError(f"the Dask workers cannot run a batch: {one_line(error)}") from error
        self.plan.learn(batch, seconds)
        return list(results)

    def _halve(self, batch: list[Case]) -> list[Result]:
        """Halve a batch that lost its worker; a single case runs in a process of its own."""
        half = len(batch) // 2
        if half == 0:
            result = run_alone(self.simulate, batch[0], lambda: self.stop.flag)
            return [result] if result else []
        self.suspects += [batch[:half], batch[half:]]
        return []
