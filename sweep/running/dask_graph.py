"""Cases on the workers of a Dask cluster.

With one task per case, Dask would need more time to build the graph than the cases need to run.
Therefore a task is a batch of about one second of work, and the number of tasks in flight is
limited.

Each task is bound to one worker, so that Dask runs it on no other: a batch whose worker dies comes
back to the run, whatever the scheduler does with other tasks, and kills no second worker. A worker
gets batches once it has proved that it has the source of the run, and the kernels of its host are
compiled.
"""

import asyncio
import time
from collections.abc import Callable, Iterable, Iterator
from contextlib import suppress
from dataclasses import dataclass, field
from functools import partial
from queue import Empty, SimpleQueue
from threading import Thread
from typing import TYPE_CHECKING, Any, NamedTuple

from sweep.config.case import Case
from sweep.numbers import with_unit
from sweep.result import Result, Status, failed_result
from sweep.running.batches import Plan
from sweep.running.child_process import Simulate, one_line, run_alone
from sweep.running.cluster import Cluster, ClusterError
from sweep.running.fingerprint import OtherSourceError, checked, fingerprint
from sweep.running.threads import Sink, Stop, run_batch
from sweep.running.warming import Kernels, inspect_kernels, load, time_to_compile

if TYPE_CHECKING:
    from distributed import Future

AHEAD = 3  # batches per thread of a worker: one that runs, others so that it need not wait
MOMENT = 0.2  # seconds between two checks for a stop
LOOK = 1.0  # seconds between two looks at the workers
LOSSES = 5  # number of workers that one case may kill
LOST = f"each of {LOSSES} workers that ran it died; try a smaller model"
KEPT = "what is finished is kept, and the same command runs the rest"


class Work(NamedTuple):
    """The function that workers apply to cases, and the kernels that it needs."""

    simulate: Simulate
    kernels: list[str]


class Suspects(NamedTuple):
    """Cases that may have killed a worker, and how many workers were lost while they ran."""

    cases: list[Case]
    losses: int = 0


NONE = Suspects([])


@dataclass(eq=False)
class Worker:
    """The state of a worker in the run. ready: it may have batches; refused: it may have none."""

    address: str
    name: str
    host: str
    threads: int
    ready: bool = False
    refused: bool = False
    tasks: "set[Future]" = field(default_factory=set)


class Task(NamedTuple):
    """A task in flight: its worker, the function that turns its value into results, and its
    cases.
    """

    worker: Worker
    take: Callable[[Any], list[Result]]
    suspects: Suspects


def run_on_cluster(  # noqa: PLR0913  what, where, how
    plan: Plan,
    work: Work,
    sink: Sink,
    stop: Stop,
    cluster: Cluster,
    say: Callable[[str], None],
    suspects: Iterable[Case] = (),
) -> None:
    """Run suspects, each in a process of its own, and all cases of a plan on workers; pass finished
    batches to `sink`, one at a time.

    say: prints a line about the cluster. A `stop` ends the run early.
    """
    run = _Run(cluster, plan, work, stop, say)
    run.suspects += [Suspects([case]) for case in suspects]
    try:
        for results in run.results():
            if results:
                sink(results)
    finally:
        run.cancel([*run.tasks])


class _Run:
    """Batches on workers: enough to keep them busy, few enough to hold in memory."""

    def __init__(
        self, cluster: Cluster, plan: Plan, work: Work, stop: Stop, say: Callable[[str], None]
    ) -> None:
        self.cluster, self.client, self.plan, self.work = cluster, cluster.client, plan, work
        self.stop, self.say = stop, say
        self.workers: dict[str, Worker] = {}  # by address
        self.compiling: dict[str, Worker] = {}  # by host, or by address if it compiles for itself
        self.tasks: dict[Future, Task] = {}
        self.finished: SimpleQueue[tuple[Future, Any]] = SimpleQueue()  # with value or exception
        self.suspects: list[Suspects] = []
        self.idle_since: float | None = None  # since when there is no worker
        self.had_workers = False
        self.refusal = ""  # the last one

    def results(self) -> Iterator[list[Result]]:
        """Results of each batch when it finishes, until all have finished or the run is stopped."""
        look = 0.0
        while self._is_left() and not self.stop.flag:
            if time.monotonic() > look:
                yield self._look()
                look = time.monotonic() + LOOK
            with suppress(Empty):
                yield self._land(*self.finished.get(timeout=MOMENT))
        while not self.finished.empty():
            yield self._land(*self.finished.get())

    def cancel(self, futures: "list[Future]") -> None:
        """Drop tasks, here and in the scheduler."""
        for future in futures:
            self.tasks.pop(future).worker.tasks.discard(future)
        if futures and self.client.status == "running":
            self.client.cancel(futures)

    def _is_left(self) -> bool:
        waiting = len(self.plan) or self.suspects
        return bool(waiting) or any(task.suspects.cases for task in self.tasks.values())

    def _look(self) -> list[Result]:
        """Find out which workers have come and gone; return rows of cases that are given up."""
        present = self._present()
        gone = [self.workers.pop(address) for address in self.workers.keys() - present.keys()]
        rows = [row for worker in gone for row in self._lose(worker)]
        for address in present.keys() - self.workers.keys():
            name, host, threads = present[address]
            called = address if name == address else f"{name} ({address})"
            self.workers[address] = Worker(address, called, host, threads)
            self._inspect(self.workers[address])
        self._watch()
        for worker in self.workers.values():
            self._fill(worker)
        return rows

    def _present(self) -> dict[str, tuple[str, str, int]]:
        """Workers that run, unless paused because their memory is full: address -> name, host,
        threads.

        `Client.scheduler_info` would not do: it sometimes returns an older state, without them.
        """

        def present(dask_scheduler: Any) -> dict[str, tuple[str, str, int]]:
            workers = dask_scheduler.workers.values()
            running = [worker for worker in workers if worker.status.name == "running"]
            return {w.address: (str(w.name), w.host, w.nthreads) for w in running}

        workers: dict[str, tuple[str, str, int]]
        try:
            if self.client.status == "running":
                workers = self.client.run_on_scheduler(present)
                return workers
        except OSError as error:
            raise self._lost_scheduler() from error
        raise self._lost_scheduler()

    def _watch(self) -> None:
        """Report when no worker is left and when there are workers again; give up after a while."""
        usable = [worker for worker in self.workers.values() if not worker.refused]
        self.plan.workers = max(sum(worker.threads for worker in usable), 1)
        address, limit = self.cluster.address, with_unit(self.cluster.wait, "s")
        if usable:
            if self.idle_since is not None and self.had_workers:
                self.say(f"there are workers again: {len(usable)}")
            self.idle_since, self.had_workers = None, True
        elif self.idle_since is None:
            self.idle_since = time.monotonic()
            what = "no worker is left" if self.had_workers else "no worker has joined yet"
            self.say(f"{what} at {address}; waiting {limit} for one")
        elif time.monotonic() - self.idle_since > self.cluster.wait:
            why = f"; {self.refusal}" if self.refusal else ""
            raise ClusterError(f"no worker at {address} for {limit}{why}; {KEPT}")

    def _submit(
        self,
        worker: Worker,
        take: Callable[[Any], list[Result]],
        suspects: Suspects,
        *call: Any,
    ) -> None:
        """Let one worker, and no other, call a function with arguments."""
        future = self.client.submit(
            checked, fingerprint(), *call, workers=[worker.address], pure=False
        )
        self.tasks[future] = Task(worker, take, suspects)
        worker.tasks.add(future)
        future.add_done_callback(
            lambda ended: Thread(target=self._fetch, args=[ended], daemon=True).start()
        )

    def _fetch(self, future: "Future") -> None:
        """Fetch a value: a thread waits, for a long time if a worker dies with the value."""
        try:
            self.finished.put((future, future.result()))
        except (Exception, asyncio.CancelledError) as error:  # noqa: BLE001  `_land` sorts them
            self.finished.put((future, error))

    def _inspect(self, worker: Worker) -> None:
        take = partial(self._inspected, worker)
        self._submit(worker, take, NONE, inspect_kernels, self.work.kernels)

    def _inspected(self, worker: Worker, kernels: Kernels) -> list[Result]:
        """Give a worker batches, let it compile the kernels, or let it wait for another one of its
        host.
        """
        place = worker.host if kernels.lasting else worker.address
        if not kernels.cold:
            worker.ready = True
            self._fill(worker)
        elif place not in self.compiling:
            self.compiling[place] = worker
            takes = f"this takes {time_to_compile()}"
            self.say(f"worker {worker.name} compiles the kernels of its host, once: {takes}")
            self._submit(worker, partial(self._compiled, worker), NONE, load, kernels.cold)
        return []

    def _compiled(self, compiler: Worker, _: None = None) -> list[Result]:
        """Inspect the workers of a host again after one of them has compiled or is lost."""
        self.compiling = {at: worker for at, worker in self.compiling.items() if worker != compiler}
        for worker in self.workers.values():
            waits = not (worker.ready or worker.refused or worker.tasks)
            if waits and worker.host == compiler.host:
                self._inspect(worker)
        return []

    def _fill(self, worker: Worker) -> None:
        """Submit enough batches to keep a worker busy."""
        while worker.ready and not self.stop.flag:
            free = len(worker.tasks) < worker.threads
            ahead = self.plan.is_quick() and len(worker.tasks) < AHEAD * worker.threads
            if free and self.suspects:
                suspects = self.suspects.pop()
                call = run_alone, self.work.simulate, suspects.cases
                self._submit(worker, list, suspects, *call)
            elif (free or ahead) and (batch := self.plan.take()):
                take = partial(self._learn, batch)
                self._submit(worker, take, Suspects(batch), run_batch, self.work.simulate, batch)
            else:
                return

    def _learn(self, batch: list[Case], value: tuple[list[Result], float]) -> list[Result]:
        results, seconds = value
        self.plan.learn(batch, seconds)
        return results

    def _land(self, future: "Future", value: Any) -> list[Result]:
        """Results of a finished task, with a value or an exception."""
        from distributed import CancelledError, KilledWorker

        task = self.tasks.pop(future, None)
        if task is None:  # of a lost worker
            return []
        task.worker.tasks.discard(future)
        if isinstance(value, CancelledError | asyncio.CancelledError):
            raise self._lost_scheduler() from value
        if isinstance(value, KilledWorker):  # again and again, and back under its address
            self.workers.pop(task.worker.address, None)
            return self._suspect(task.suspects) + self._lose(task.worker)
        if isinstance(value, Exception):
            self._refuse(task.worker, value)
            self.plan.put_back(task.suspects.cases)
            return []
        rows = task.take(value)
        self._fill(task.worker)
        return rows

    def _refuse(self, worker: Worker, error: Exception) -> None:
        """Give no further batches to a worker that is not the one that the run needs."""
        if worker.refused:
            return
        worker.ready, worker.refused = False, True
        other = isinstance(error, OtherSourceError)
        why = f"has {error}" if other else f"cannot run Crumple: {one_line(error)}"
        self.refusal = f"worker {worker.name} is refused: it {why}"
        self.say(self.refusal)
        self._compiled(worker)

    def _lose(self, worker: Worker) -> list[Result]:
        """Take back the batches of a lost worker."""
        lost = [self.tasks[future].suspects for future in worker.tasks]
        self.cancel([*worker.tasks])
        self._compiled(worker)
        return [row for suspects in lost for row in self._suspect(suspects)]

    def _suspect(self, suspects: Suspects) -> list[Result]:
        """Run cases whose worker was lost again, in halves; a case that loses too many becomes a
        row.
        """
        cases, losses = suspects.cases, suspects.losses + 1
        half = len(cases) // 2
        if half:
            self.suspects += [Suspects(cases[:half]), Suspects(cases[half:])]
        elif cases and losses < LOSSES:
            self.suspects.append(Suspects(cases, losses))
        else:
            return [failed_result(case, Status.WORKER_DIED, LOST) for case in cases]
        return []

    def _lost_scheduler(self) -> ClusterError:
        return ClusterError(f"lost the Dask scheduler at {self.cluster.address}; {KEPT}")
