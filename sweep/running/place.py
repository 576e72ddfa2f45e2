"""Chooses where the cases of a run are computed: threads or processes of this machine, or a Dask
cluster.
"""

from collections.abc import Iterator
from contextlib import contextmanager
from typing import TypeAlias

from sweep.config.faults import MisfitError
from sweep.running.cluster import WAIT, Cluster, Scheduler, open_cluster
from sweep.running.processes import PROCESSES, Processes
from sweep.running.threads import MOST_THREADS

Place: TypeAlias = Cluster | Processes | None
"""An open place; None for threads of this process."""


def chosen_place(workers: int | None, where: Scheduler) -> tuple[int, Scheduler]:
    """How many cases run at a time on this machine, and where, if at most one of the two is given.

    If neither is given, the scheduler of Dask's configuration counts, usually set by
    DASK_SCHEDULER_ADDRESS. Without it all cores are used: by threads as far as more of them pay,
    beyond that by processes. Raises `MisfitError` for a number of workers below 1.
    """
    import dask
    from dask.system import cpu_count

    if workers is not None and (not isinstance(workers, int) or workers < 1):
        raise MisfitError(f"workers = {workers!r}; allowed: a whole number above 0")
    cores = cpu_count()
    if where is None and workers is None:
        beyond = PROCESSES if cores > MOST_THREADS else None
        where = dask.config.get("scheduler-address", None) or beyond
    return workers or cores, where


@contextmanager
def open_place(where: Scheduler, wait: float = WAIT) -> Iterator[Place]:
    """The place where cases run; an open cluster, and a `Client` of the user, stay open.

    wait: as in `Cluster`.
    """
    if isinstance(where, Processes):
        yield where
    elif where == PROCESSES:
        with Processes() as processes:
            yield processes
    else:
        with open_cluster(where, wait) as cluster:
            yield cluster
