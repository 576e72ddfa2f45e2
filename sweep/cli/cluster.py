"""The cluster of a command, by --scheduler and --wait."""

from __future__ import annotations

from contextlib import contextmanager
from typing import TYPE_CHECKING

from sweep.cli.refusals import ArgumentError

if TYPE_CHECKING:
    from argparse import Namespace
    from collections.abc import Iterator

    from sweep.running.cluster import Cluster


@contextmanager
def cluster_of(arguments: Namespace) -> Iterator[Cluster | None]:
    """The cluster on which cases run, for the whole of a command; None for threads."""
    from sweep.running.cluster import WAIT, open_cluster, usual_scheduler

    where = arguments.scheduler or (None if arguments.workers else usual_scheduler())
    if arguments.wait is not None and not where:
        raise ArgumentError("--wait is of a cluster; needed: --scheduler or DASK_SCHEDULER_ADDRESS")
    with open_cluster(where, WAIT if arguments.wait is None else arguments.wait) as cluster:
        yield cluster
