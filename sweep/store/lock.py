"""One writer at a time: a lock that the system releases when its holder ends, also by a kill.

Some network file systems have no locks. There the file itself is the lock: it exists while its
holder runs, and names it. One that a kill has left behind is taken over on the same host, and on
another one has to be deleted by hand.
"""

import errno
import fcntl
import os
import socket
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path

NO_LOCKS = {errno.ENOLCK, errno.ENOSYS, errno.EOPNOTSUPP}
OWNED = ".owner"  # suffix of the lock where there are no locks
LONGEST = 300  # bytes of the name of a holder


class LockedError(Exception):
    """Another process holds the lock; `holder`: its process id, or "" if unknown.

    left: the file to delete, if that process runs no more; None where the system knows.
    """

    def __init__(self, holder: str, left: Path | None = None) -> None:
        super().__init__(holder)
        self.holder, self.left = holder, left


@contextmanager
def exclusive(path: Path) -> Iterator[None]:
    """Hold the lock file `path`, or raise LockedError at once; the file is deleted at the end."""
    try:
        descriptor = _acquire(path)
    except OSError as error:
        if error.errno not in NO_LOCKS:
            raise
        path = path.with_name(path.name + OWNED)
        descriptor = _own(path)
    try:
        os.truncate(descriptor, 0)
        os.write(descriptor, f"{os.getpid()} on {socket.gethostname()}".encode())
        yield
    finally:
        path.unlink(missing_ok=True)
        os.close(descriptor)


def _acquire(path: Path) -> int:
    while True:
        descriptor = os.open(path, os.O_RDWR | os.O_CREAT | os.O_NOFOLLOW | os.O_NONBLOCK, 0o644)
        try:
            fcntl.flock(descriptor, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except BlockingIOError:
            holder = _holder(descriptor)
            os.close(descriptor)
            raise LockedError(holder) from None
        except OSError:
            os.close(descriptor)
            path.unlink(missing_ok=True)
            raise
        if _is_still(path, descriptor):
            return descriptor
        os.close(descriptor)  # the previous holder has just deleted this file


def _own(path: Path) -> int:
    """Make the file `path`; one that a dead process of this host has left is removed before."""
    if _is_dead(holder := _owner(path)):
        aside = path.with_name(f"{path.name}.{os.getpid()}")
        with suppress(FileNotFoundError):
            path.rename(aside)
            if _owner(aside) != holder:  # another process has just taken over
                aside.rename(path)
            aside.unlink(missing_ok=True)
    try:
        return os.open(path, os.O_RDWR | os.O_CREAT | os.O_EXCL, 0o644)
    except FileExistsError:
        raise LockedError(_owner(path), path) from None


def _owner(path: Path) -> str:
    with suppress(FileNotFoundError), path.open("rb") as file:
        return _holder(file.fileno())
    return ""


def _is_dead(holder: str) -> bool:
    """Whether a holder, "PROCESS on HOST", is a process of this host that runs no more."""
    process, _, host = holder.partition(" on ")
    if host != socket.gethostname() or not process.isdecimal():
        return False
    try:
        os.kill(int(process), 0)
    except ProcessLookupError:
        return True
    except (OSError, OverflowError):  # of another user; no number of a process
        pass
    return False


def _holder(descriptor: int) -> str:
    return os.pread(descriptor, LONGEST, 0).decode(errors="replace")


def _is_still(path: Path, descriptor: int) -> bool:
    try:
        return os.path.samestat(os.stat(path), os.fstat(descriptor))
    except FileNotFoundError:
        return False
