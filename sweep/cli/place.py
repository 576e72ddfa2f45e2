"""Chooses where the cases of a command run, by --workers, --processes, --scheduler and --wait."""

from argparse import Namespace
from collections.abc import Iterator
from contextlib import contextmanager

from sweep.cli.refusals import ArgumentError
from sweep.running.cluster import WAIT, Scheduler
from sweep.running.place import Place, chosen_place, open_place
from sweep.running.processes import PROCESSES


def requested_place(arguments: Namespace) -> tuple[int, Scheduler]:
    """How many cases run at a time on this machine, and where."""
    where = PROCESSES if arguments.processes else arguments.scheduler
    return chosen_place(arguments.processes or arguments.workers, where)


@contextmanager
def place_of(arguments: Namespace) -> Iterator[tuple[int, Place]]:
    """How many cases run at a time on this machine, and where, for the whole of a command."""
    workers, where = requested_place(arguments)
    if arguments.wait is not None and where in (None, PROCESSES):
        raise ArgumentError("--wait is of a cluster; needed: --scheduler or DASK_SCHEDULER_ADDRESS")
    with open_place(where, WAIT if arguments.wait is None else arguments.wait) as place:
        yield workers, place
