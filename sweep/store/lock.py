"""One writer at a time: a lock that the system releases when its holder ends, also by a kill.

Some network file systems have no locks. There the file itself is the lock: it exists while its
holder runs, and names the holder. A lock that a killed process has left behind is taken over on the
same host; on another host it has to be deleted by hand.
"""

import errno
import os
import socket
import sys
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path

from sweep.store.errors import StoreError

if sys.platform == "win32":
    import msvcrt
else:
    import fcntl

# Follows no link, waits for no pipe; Windows has neither word.
HOW = os.O_RDWR | os.O_CREAT | getattr(os, "O_NOFOLLOW", 0) | getattr(os, "O_NONBLOCK", 0)
NO_LOCKS = {errno.ENOLCK, errno.ENOSYS, errno.EOPNOTSUPP}
OWNED = ".owner"  # suffix of the lock where there are no locks
LONGEST = 300  # bytes of the name of a holder
LOCKED_BYTE = 1 << 30  # of the file, on Windows: others cannot read a locked byte


@contextmanager
def exclusive(path: Path) -> Iterator[None]:
    """Hold the lock of a results file, or refuse at once; the lock is deleted at the end."""
    lock = path.with_name(f".{path.name}.lock")
    try:
        descriptor = _acquire(path, lock)
    except OSError as error:
        if error.errno not in NO_LOCKS:
            raise
        lock = lock.with_name(lock.name + OWNED)
        descriptor = _own(path, lock)
    try:
        os.ftruncate(descriptor, 0)
        os.lseek(descriptor, 0, os.SEEK_SET)
        os.write(descriptor, f"{os.getpid()} on {socket.gethostname()}".encode())
        yield
    finally:
        _release(lock, descriptor)


def _refusal(path: Path, holder: str, left: Path | None = None) -> StoreError:
    """Another process writes; left: the file to delete if it no longer runs; None where the system
    knows.
    """
    process = f" (process {holder})" if holder else ""
    gone = f" If it has ended, delete {left}." if left else ""
    return StoreError(f"Another run is writing into {path}{process}.{gone}")


def _acquire(path: Path, lock: Path) -> int:
    while True:
        descriptor = os.open(lock, HOW, 0o644)
        try:
            _lock(descriptor)
        except (BlockingIOError, PermissionError):  # the second one on Windows
            holder = _holder(descriptor)
            os.close(descriptor)
            raise _refusal(path, holder) from None
        except OSError:
            os.close(descriptor)
            lock.unlink(missing_ok=True)
            raise
        if _is_still(lock, descriptor):
            return descriptor
        os.close(descriptor)  # the previous holder has just deleted this file


if sys.platform == "win32":

    def _lock(descriptor: int) -> None:
        os.lseek(descriptor, LOCKED_BYTE, os.SEEK_SET)
        msvcrt.locking(descriptor, msvcrt.LK_NBLCK, 1)
else:

    def _lock(descriptor: int) -> None:
        fcntl.flock(descriptor, fcntl.LOCK_EX | fcntl.LOCK_NB)


def _release(path: Path, descriptor: int) -> None:
    """Delete the file while it is locked; Windows deletes no open file, so it is closed before."""
    try:
        path.unlink(missing_ok=True)
    except PermissionError:
        os.close(descriptor)
        with suppress(PermissionError):  # another process has just locked it
            path.unlink(missing_ok=True)
    else:
        os.close(descriptor)


def _own(path: Path, lock: Path) -> int:
    """Create the file `lock`, after removing one that a dead process of this host has left."""
    if _is_dead(holder := _owner(lock)):
        aside = lock.with_name(f"{lock.name}.{os.getpid()}")
        with suppress(FileNotFoundError):
            lock.rename(aside)
            if _owner(aside) != holder:  # another process has just taken over
                aside.rename(lock)
            aside.unlink(missing_ok=True)
    try:
        return os.open(lock, os.O_RDWR | os.O_CREAT | os.O_EXCL, 0o644)
    except FileExistsError:
        raise _refusal(path, _owner(lock), lock) from None


def _owner(path: Path) -> str:
    with suppress(FileNotFoundError), path.open("rb") as file:
        return _holder(file.fileno())
    return ""


def _is_dead(holder: str) -> bool:
    """Whether a holder, "PROCESS on HOST", is a process of this host that no longer runs."""
    from psutil import pid_exists

    process, _, host = holder.partition(" on ")
    with suppress(OverflowError):  # not a process id
        return host == socket.gethostname() and process.isdecimal() and not pid_exists(int(process))
    return False


def _holder(descriptor: int) -> str:
    os.lseek(descriptor, 0, os.SEEK_SET)
    return os.read(descriptor, LONGEST).decode(errors="replace")


def _is_still(path: Path, descriptor: int) -> bool:
    """Whether the opened file still exists; Windows deletes no open file."""
    with suppress(FileNotFoundError):
        return sys.platform == "win32" or os.path.samestat(os.stat(path), os.fstat(descriptor))
    return False
