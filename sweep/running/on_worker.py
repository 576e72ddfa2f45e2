"""Functions that run on a worker of a cluster, if it computes the same numbers as the run."""

from collections.abc import Callable, Sequence
from typing import Any, NamedTuple

from sweep.running.fingerprint import Fingerprint, differences, fingerprint
from sweep.running.warming import cold_kernels


class OtherSourceError(Exception):
    """A worker with other source or other versions; the text says what differs."""


class Kernels(NamedTuple):
    """The kernels of a worker: those that it would have to compile, and whether other processes of
    its host can then use them.
    """

    cold: list[str]
    lasting: bool


def checked(expected: Fingerprint, task: Callable[..., Any], *arguments: Any) -> Any:
    """The result of a task, if this process has the fingerprint of the run."""
    if wrong := differences(fingerprint(), expected):
        raise OtherSourceError(wrong)
    return task(*arguments)


def inspect_kernels(names: Sequence[str]) -> Kernels:
    """The state of the named kernels in this process."""
    from kernels.compile.cache import is_lasting

    return Kernels(cold_kernels(names), is_lasting())
