"""The thread that writes results while other threads compute, and its schedule."""

from collections.abc import Iterator
from concurrent.futures import Future, ThreadPoolExecutor, wait
from contextlib import contextmanager

from sweep.result import Result
from sweep.running.batches import Plan
from sweep.running.progress import Progress
from sweep.running.threads import Sink
from sweep.store.read import StoreError
from sweep.store.write import Writer

AT_RISK = 2.0  # seconds of work per worker in unsealed results, which a kill would lose


@contextmanager
def writer_thread() -> Iterator[ThreadPoolExecutor]:
    """A thread that writes files while others compute.

    HDF5 does not survive an interrupted write, so signals never reach this thread. It ends before
    its files are closed, even after repeated Ctrl-C.
    """
    thread = ThreadPoolExecutor(1, "writer")
    try:
        yield thread
    finally:
        last, interrupted = thread.submit(lambda: None), None
        while not last.done():
            try:
                wait([last])  # after an interrupted join, CPython may regard a thread as ended
            except KeyboardInterrupt as again:
                interrupted = again
        thread.shutdown()
        if interrupted:
            raise interrupted


@contextmanager
def result_sink(writer: Writer, plan: Plan, progress: Progress) -> Iterator[Sink]:
    """A sink that seals results and then reports them as progress; the first ones at once.

    Later results wait until they have taken enough time to compute, since a part takes about 80 ms
    to write. The last results are folded into the results file without a part.
    """
    unsealed: list[Result] = []
    seals: list[Future[None]] = []

    def write(batch: list[Result]) -> None:
        writer.append(batch)
        progress.advance(batch)

    def fold() -> None:
        try:
            writer.fold(unsealed)
        except StoreError:
            writer.append(unsealed)
            raise
        progress.advance(unsealed)

    def seal() -> None:
        wait_for_last_seal()
        seals.append(thread.submit(write, unsealed[:]))
        unsealed.clear()

    def wait_for_last_seal() -> None:
        if seals:
            seals[-1].result()

    def sink(results: list[Result]) -> None:
        unsealed.extend(results)
        seconds = sum(float(result.summary["cpu_s"]) for result in unsealed)
        if not seals or not seconds < AT_RISK * plan.workers:  # also if the time is NaN
            seal()

    with writer_thread() as thread:
        try:
            yield sink
            wait_for_last_seal()
        except Exception:
            seal()
            raise
        thread.submit(fold).result()
