"""The Dask cluster of a run: an address, a scheduler file, SLURM, or an object of Dask."""

import json
import os
from asyncio import wait_for
from collections.abc import Iterator
from contextlib import ExitStack, contextmanager
from math import inf
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple, TypeAlias

from sweep.config.faults import ReportedError
from sweep.running.child_process import one_line
from sweep.running.progress import announce

if TYPE_CHECKING:
    from distributed import Client

ANSWER = 10  # seconds in which a scheduler must answer
WAIT = 60.0  # seconds that a run waits for a worker, as long as there is none
SLURM = "slurm"
ALLOWED = (
    "an address such as tcp://host:8786 or tls://host:8786, the file of dask scheduler "
    f"--scheduler-file, or {SLURM}"
)
NO_JOBQUEUE = f'"{SLURM}" needs dask-jobqueue: pip install "crumple[slurm]"'
NO_MAXIMUM = (
    "distributed.adaptive.maximum, the number of workers, is not set; needed: a number, in a file "
    "of ~/.config/dask or as DASK_DISTRIBUTED__ADAPTIVE__MAXIMUM"
)

Scheduler: TypeAlias = Any
"""Where cases run: text as in `ALLOWED`, a path, a `distributed.Client` or one of Dask's clusters,
a `Cluster`; "processes" or open `Processes` of this machine; None for threads of this process."""


class ClusterError(ReportedError):
    """A cluster that fails during a run, which keeps its finished cases; the text is one line."""

    exit_status = 1


class SchedulerError(ClusterError):
    """The given scheduler cannot be used."""

    exit_status = 2


class Cluster(NamedTuple):
    """A connected scheduler, and the number of seconds for which a run waits for a worker."""

    client: "Client"
    address: str
    wait: float


@contextmanager
def open_cluster(where: Scheduler, wait: float = WAIT) -> Iterator[Cluster | None]:
    """The cluster of a run, and a line that names it; None if there is no scheduler.

    An open cluster, and a `Client` of the user, stay open.
    """
    if where is None or isinstance(where, Cluster):
        yield where
        return
    with ExitStack() as stack:
        client = _client(where, stack)
        cluster = Cluster(client, str(client.scheduler.address), wait)
        by = f" of {where}" if where == SLURM else ""
        announce(f"running on the Dask cluster{by} at {cluster.address}")
        yield cluster


def _client(where: Scheduler, stack: ExitStack) -> "Client":
    from distributed import Client
    from distributed.utils import silence_logging_cmgr

    if isinstance(where, Client):
        if where.asynchronous:
            raise SchedulerError("an asynchronous Client; allowed: one with asynchronous=False")
        return where
    stack.enter_context(silence_logging_cmgr("CRITICAL"))
    if where == SLURM:
        where = stack.enter_context(_slurm())
    elif isinstance(where, str | os.PathLike):
        where = address_of(os.fspath(where))
        check_scheduler(where)
    try:
        client = Client(where, set_as_default=False, timeout=ANSWER)
    except (ImportError, TypeError, ValueError) as error:
        raise SchedulerError(f"the Dask scheduler {where}: {one_line(error)}") from error
    return stack.enter_context(client)


def address_of(where: str) -> str:
    """The address of a scheduler: the text itself, or the address in its scheduler file."""
    if "://" in where:
        return where
    if not Path(where).is_file():
        raise SchedulerError(f'"{where}" is no scheduler and no file; allowed: {ALLOWED}')
    try:
        return str(json.loads(Path(where).read_text("utf-8"))["address"])
    except (OSError, ValueError, LookupError, TypeError) as error:
        raise SchedulerError(f'"{where}" is no scheduler file; allowed: {ALLOWED}') from error


def check_scheduler(address: str) -> None:
    """Refuse an address at which no Dask scheduler answers: a `Client` could wait forever."""
    from distributed.utils import LoopRunner

    try:
        kind = LoopRunner().run_sync(_identify, address)
    except (ValueError, TypeError) as error:
        raise SchedulerError(f'"{address}" is no address; allowed: {ALLOWED}') from error
    except Exception as error:
        raise SchedulerError(f"no Dask scheduler answers at {address}") from error
    if kind != "Scheduler":
        raise SchedulerError(f"{address} is a Dask {kind}; needed: its scheduler")


async def _identify(address: str) -> str:
    """Type of the server at an address: "Scheduler", "Worker", ..."""
    from distributed import Security, rpc

    security = Security().get_connection_args("client")
    async with rpc(address, timeout=ANSWER, connection_args=security) as server:
        identity = await wait_for(server.identity(), ANSWER)
    return str(identity["type"])


def _slurm() -> Any:
    """Workers in jobs of SLURM, as dask-jobqueue is configured; jobs that end are replaced."""
    import dask

    try:
        from dask_jobqueue.slurm import SLURMCluster
    except ImportError as error:
        raise SchedulerError(NO_JOBQUEUE) from error
    count = dask.config.get("distributed.adaptive.maximum", inf)
    if count == inf:
        raise SchedulerError(f"{SLURM}: {NO_MAXIMUM}")
    try:
        cluster = SLURMCluster()
    except (TypeError, ValueError) as error:
        line = " ".join(f"{error}; needed: jobqueue.slurm in a file of ~/.config/dask".split())
        raise SchedulerError(f"{SLURM}: {line}") from error
    cluster.adapt(minimum=count, maximum=count)
    return cluster
