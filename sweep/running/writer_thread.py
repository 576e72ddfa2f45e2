"""The thread that writes results while others compute, and when it writes them."""

from collections.abc import Iterator
from concurrent.futures import Future, ThreadPoolExecutor, wait
from contextlib import contextmanager

from sweep.result import Result
from sweep.running.batches import Plan
from sweep.running.dask_graph import Sink
from sweep.running.progress import Progress
from sweep.store.read import StoreError
from sweep.store.write import Writer

AT_RISK = 2.0  # seconds of each worker's time in results that a kill may take


@contextmanager
def clerk() -> Iterator[ThreadPoolExecutor]:
    """A thread that writes files while others compute.

    Signals never interrupt it, which HDF5 would not survive, and it ends before what it writes to
    is closed, however often someone presses Ctrl-C.
    """
    pool = ThreadPoolExecutor(1, "clerk")
    try:
        yield pool
    finally:
        last, interrupted = pool.submit(lambda: None), None
        while not last.done():
            try:
                wait([last])  # CPython may take a thread for ended whose join was interrupted
            except KeyboardInterrupt as again:
                interrupted = again
        pool.shutdown()
        if interrupted:
            raise interrupted


@contextmanager
def keeping(writer: Writer, plan: Plan, progress: Progress) -> Iterator[Sink]:
    """A sink that seals results and then counts them aloud: the first at once, as a sign of life.

    Later ones wait until they are worth it: a part takes about 80 ms to write. The last ones need
    no part: in the end all is folded.
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
        settle()
        seals.append(pool.submit(write, unsealed[:]))
        unsealed.clear()

    def settle() -> None:
        if seals:
            seals[-1].result()

    def keep(results: list[Result]) -> None:
        unsealed.extend(results)
        worth = sum(float(result.summary["cpu_s"]) for result in unsealed)
        if not seals or not worth < AT_RISK * plan.workers:  # NaN: cannot be told
            seal()

    with clerk() as pool:
        try:
            yield keep
            settle()
        except Exception:
            seal()
            raise
        pool.submit(fold).result()
