"""Limits the memory of a process to the free memory of the machine.

A case that needs more gets a `MemoryError`, which is recorded in its row. Without a limit, Linux
would promise it the memory, and kill a process when it is used: this one, or another one of the
machine. Other systems need no such limit: Windows promises only what it has, macOS swaps.
"""

import sys
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path

OWN_GROUPS, GROUPS = Path("/proc/self/cgroup"), Path("/sys/fs/cgroup")
GROUP_FILES = ("memory.max", "memory.limit_in_bytes")  # of versions 2 and 1 of control groups
USED = 0.95  # the share of a control group that is data


@contextmanager
def limited_memory() -> Iterator[None]:
    """Limit the data of this process to its present size plus the free memory."""
    if sys.platform == "linux":
        from resource import RLIM_INFINITY, RLIMIT_DATA, getrlimit, setrlimit

        soft, hard = getrlimit(RLIMIT_DATA)
        limits = [limit for limit in (soft, hard) if limit != RLIM_INFINITY]
        setrlimit(RLIMIT_DATA, (min([most_data(), *limits]), hard))
        try:
            yield
        finally:
            setrlimit(RLIMIT_DATA, (soft, hard))
    else:
        yield


def most_data() -> int:
    """Bytes of data that this process may have: in the machine, and in its control groups, which
    are limits of containers and of jobs.
    """
    from psutil import Process, virtual_memory

    free = virtual_memory().available + Process().memory_info().data
    return min([free, *(int(USED * limit) for limit in _group_limits())])


def _group_limits() -> Iterator[int]:
    """Memory limits (bytes) of the control groups of this process, and of the groups above them."""
    for line in OWN_GROUPS.read_text("utf-8").splitlines():
        _, controllers, path = line.split(":", 2)
        root = GROUPS / controllers
        group = root / path.lstrip("/")
        for folder in (group, *group.parents):
            for name in GROUP_FILES:
                with suppress(OSError, ValueError):  # no such file; "max"
                    yield int((folder / name).read_text("ascii"))
            if folder == root:
                break
