"""Windows, as far as it can be simulated: names that it lacks, its locks, files that are open.

`pretend` is called in a process of its own, before anything of Crumple is imported.
"""

import fcntl
import multiprocessing.connection
import os
import shutil
import subprocess
import sys
from importlib import import_module
from types import ModuleType, SimpleNamespace

LACKING = (
    "O_DIRECTORY", "O_NOFOLLOW", "O_NONBLOCK", "fork", "geteuid", "getloadavg", "getpgid", "getuid",
    "killpg", "mkfifo", "nice", "pread", "pwrite", "sched_getaffinity", "setsid", "uname",
)  # fmt: skip
OTHERS = (
    "PIL.Image", "distributed", "h5py", "manifold3d", "matplotlib.pyplot", "numba", "pandas",
    "platformdirs", "pydantic", "rich.console", "scipy.sparse", "shapely",
)  # fmt: skip
FORBIDDEN = '<>:"|?*'  # in the names of files


def pretend():
    """Remove from this process the functions that Windows lacks, and refuse operations that it
    refuses.
    """
    for name in OTHERS:  # they take what their own system has
        import_module(name)
    for name in LACKING:
        delattr(os, name)
    os.process_cpu_count = os.cpu_count  # of Python 3.13
    shutil._use_fd_functions = False
    for name in ("fcntl", "resource"):
        sys.modules[name] = None
    for name in ("replace", "rename", "unlink", "remove"):
        setattr(os, name, _refusing(getattr(os, name)))
    sys.modules["msvcrt"] = msvcrt = ModuleType("msvcrt")
    msvcrt.LK_NBLCK, msvcrt.locking = 2, _locking
    multiprocessing.connection.PipeConnection = multiprocessing.connection.Connection
    os.set_handle_inheritable = os.set_inheritable
    subprocess.STARTUPINFO, subprocess.CREATE_NEW_PROCESS_GROUP = SimpleNamespace, 512
    subprocess.Popen = _Popen
    sys.platform = "win32"


def _locking(descriptor, mode, count):
    """A lock of one byte locks the whole file, and belongs to whoever opened the file."""
    assert (mode, count) == (2, 1)
    assert os.lseek(descriptor, 0, os.SEEK_CUR) > 1000, "others could not read who has the lock"
    try:
        fcntl.flock(descriptor, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except BlockingIOError:
        raise PermissionError(13, "Permission denied") from None


def _refusing(call):
    """A function of `os` that fails for files that this process has open."""

    def refuse(*paths, **how):
        held = "/proc/self/fd"
        open_files = {os.path.realpath(f"{held}/{number}") for number in os.listdir(held)}
        for path in paths if how.get("dir_fd") is None else ():
            assert not {*os.path.basename(path)}.intersection(FORBIDDEN)
            if os.path.realpath(path) in open_files:
                raise PermissionError(13, "Permission denied", os.fspath(path))
        return call(*paths, **how)

    return refuse


class _Popen(subprocess.Popen):
    """A process that inherits the handles of a list."""

    def __init__(self, words, startupinfo=None, creationflags=0, **how):
        if startupinfo:
            how["pass_fds"] = startupinfo.lpAttributeList["handle_list"]
        super().__init__(words, **how)
