"""What a worker of a cluster runs: nothing unless it computes the same numbers as the run."""

from collections.abc import Callable, Sequence
from typing import Any, NamedTuple

from sweep.running.fingerprint import Fingerprint, differences, fingerprint
from sweep.running.warming import cold_kernels


class OtherSourceError(Exception):
    """A worker with other source or other versions; the text says what differs."""


class Kernels(NamedTuple):
    """The kernels of a worker: those that it would have to compile, and whether other processes of
    its host find them then.
    """

    cold: list[str]
    lasting: bool


def checked(expected: Fingerprint, task: Callable[..., Any], *arguments: Any) -> Any:
    """What a task returns, if this process has the fingerprint of the run."""
    if wrong := differences(fingerprint(), expected):
        raise OtherSourceError(wrong)
    return task(*arguments)


def inspect_kernels(names: Sequence[str]) -> Kernels:
    """The state of the named kernels here."""
    from kernels.compile.cache import is_lasting

    return Kernels(cold_kernels(names), is_lasting())
